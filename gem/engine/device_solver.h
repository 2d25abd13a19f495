// The iterations of a coupled moment on a device: the algorithm of coupled_solver.cpp, by one crew.
//
// A point is held by one thread, in its registers while a round runs; a moving body with points has a group of lanes,
// one for each component of its motion. A point writes what it pushes into the rows of both bodies, in the order in
// which they add it up, so that no thread looks for anything while the iterations run. Where the blocks of a crew reach
// each other's fast memory, the rows stand there.
//
// | step, a barrier after each | by points                                     | by bodies                       |
// | list                       |                                               | entry, rows, places of points   |
// | begin                      | geometry, last impulses, pushes of the base   |                                 |
// | settle                     |                                               | velocities under the base       |
// | round                      | frame at the base, pushes                     |                                 |
// | move                       |                                               | motion by the additions         |
// | visit                      | next additions, pushes, residual              |                                 |
// | end of a round             | additions into the base, pushes of the base   |                                 |
#pragma once

#include <cstring>
#include <type_traits>

#include "gem/engine/contact_quality.h"
#include "gem/engine/coupled_visit.h"
#include "gem/engine/device_points.h"
#include "gem/engine/ordered_sum.h"

namespace gem {

/// A point while a round runs.
struct HeldPoint {
  PointFrame<float> frame;
  PointImpulse<float> at, carried;
  const AddedMotion *motion_a, *motion_b;
  PushRecord *to_a, *to_b;  // null: a fixed body
};

/// What the iterations of a round work with, apart from the points.
struct RoundDesk {
  Stretch own;
  const SolverEntry* entry;
  const PushRecord* room;
  const PushRecord* push;
  AddedMotion* added;   // by body
  AddedMotion* motion;  // by entry, in the block's fast memory; null: they do not stand there
  MomentPace<float> pace;
};

/// How far the iterations of a moment are.
struct Progress {
  IterationCourse course;
  double residual = 0.0;
  int turn = 0;  // of the two places for residuals
};

/// Bits of a number that is not negative: they have its order.
GEM_DEVICE inline std::uint32_t ordered_bits(float x) {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
GEM_DEVICE inline float from_ordered_bits(std::uint32_t bits) {
  float x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

constexpr int solved_work = 7;  // part of a PushBase: work of a contact that stands with this body, at the moment's end
constexpr int solved_acted = 6;  // part of a PushBase and of a SolvedMotion

template <class Crew>
class MomentSolver {
 public:
  /// `room`: bytes of fast memory of each block that the solver may use, from the start.
  GEM_DEVICE MomentSolver(const DeviceScene& s, Crew& crew, std::int32_t moment, std::size_t room)
      : s_(s),
        crew_(crew),
        moment_(moment),
        room_(room),
        pace_{static_cast<float>(s.constants.dt), static_cast<float>(1.0 / s.constants.dt)} {}

  GEM_DEVICE void solve() {
    list_bodies();
    crew_.barrier();
    crew_.lap(stage_rows);
    each_point([&](std::int32_t i) { begin_point(i); });
    clear_marks();
    crew_.barrier();
    settle();
    crew_.barrier();
    keep_best_share(1.0);
    crew_.lap(stage_points);
    iterate();
    crew_.lap(stage_base);
    keep_best_share(0.5);
    each_point([&](std::int32_t i) { hand_back(i); });
    if (s_.wants_samples) add_work_created();
    crew_.lap(stage_shares);
  }

 private:
  /// Calls work(point) for the points of this thread.
  template <class Work>
  GEM_DEVICE GEM_INLINE void each_point(Work&& work) {
    for (std::int32_t i = points_.begin + crew_.thread(); i < points_.end; i += crew_.threads()) work(i);
  }

  GEM_DEVICE GEM_INLINE int group() const { return crew_.thread() / Crew::Lanes::size; }
  GEM_DEVICE GEM_INLINE int groups() const { return crew_.threads() / Crew::Lanes::size; }

  // -- list --

  /// Finds the block's stretch of the bodies with points, gives their points places, and takes its share of the points.
  GEM_DEVICE void list_bodies() {
    const std::int32_t words = bit_words(s_);
    const std::int64_t own_words = static_cast<std::int64_t>(crew_.block()) * (words + 1);
    std::int32_t *const bodies = s_.bodies_before + own_words, *const spots = s_.spots_before + own_words;
    BlockCell& shared = crew_.shared();
    if (crew_.thread() == 0) shared.records = shared.taken = 0;
    if (crew_.thread() < Crew::Warp::size) {
      count_marks(s_.touched_bodies, bodies, words);
      count_marks(s_.touched_spots, spots, words);
    }
    crew_.block_barrier();
    bodies_ = spots[words];
    own_ = stretch_of(crew_, bodies_);
    for (std::int32_t w = crew_.thread(); w < words; w += crew_.threads()) {
      std::int32_t at = spots[w];
      if (at >= own_.end || spots[w + 1] <= own_.begin) continue;
      const std::uint32_t bits = s_.touched_spots[w];
      for (int k = 0; k < 32; ++k) {
        if (!(bits >> k & 1U)) continue;
        if (at >= own_.begin && at < own_.end) s_.solver_entry[at].body = s_.body_at[32 * w + k];
        ++at;
      }
    }
    crew_.block_barrier();
    place_entries();
    // the platform, first of all where it is among them, has a long row
    const bool platform = own_.begin < own_.end && s_.solver_entry[own_.begin].body == 0;
    const std::int32_t first = own_.begin + (platform ? 1 : 0);
    for (std::int32_t e = first + group(); e < own_.end; e += groups()) list_points(crew_.lanes(), e, bodies);
    if (platform && crew_.thread() < Crew::Warp::size) list_points(crew_.warp(), own_.begin, bodies);
    crew_.block_barrier();
    if (crew_.thread() == 0) shared.first_taken = crew_.add(&s_.counters->taken_points, shared.taken);
    crew_.block_barrier();
    points_ = {shared.first_taken, shared.first_taken + shared.taken};
  }

  GEM_DEVICE void count_marks(const std::uint32_t* marks, std::int32_t* before, std::int32_t words) {
    const auto warp = crew_.warp();
    std::int32_t sum = 0;
    for (std::int32_t first = 0; first < words; first += Crew::Warp::size) {
      const std::int32_t w = first + warp.rank();
      const int mine = w < words ? bits_in(marks[w]) : 0;
      const int below = warp.sum_below(mine);
      if (w < words) before[w] = sum + below;
      sum += warp.sum(mine);
    }
    if (warp.rank() == 0) before[words] = sum;
  }

  GEM_DEVICE std::int32_t* taken_list() const {
    return s_.taken_list + static_cast<std::int64_t>(crew_.block()) * s_.points_capacity;
  }

  /// The entries of the block's bodies stand in its fast memory where that holds them.
  GEM_DEVICE void place_entries() {
    static_assert(sizeof(SolverEntry) == sizeof(PushRecord) && sizeof(AddedMotion) == sizeof(PushRecord));
    const std::int32_t count = own_.count();
    entry_ = s_.solver_entry;
    motion_ = nullptr;
    records_begin_ = 0;
    if (!Crew::shares_rooms || 2 * static_cast<std::size_t>(count) * sizeof(PushRecord) > room_) return;
    entry_ = reinterpret_cast<SolverEntry*>(crew_.room()) - own_.begin;
    motion_ = reinterpret_cast<AddedMotion*>(crew_.room()) + count - own_.begin;
    records_begin_ = 2 * count;
  }

  /// Where the records of a body of `count` points stand in the block's fast memory; -1: they do not.
  GEM_DEVICE std::int32_t take_records(std::int32_t count) {
    if (!Crew::shares_rooms) return -1;
    const std::int32_t at = records_begin_ + crew_.add(&crew_.shared().records, count);
    return static_cast<std::size_t>(at + count) * sizeof(PushRecord) <= room_ ? at : -1;
  }

  GEM_DEVICE static std::int32_t room_place(int block, std::int32_t at) { return block << 16 | at; }

  /// Whether the block of a body takes the points at a place of its row: those with a large body, and of two floes the
  /// one that is A. The platform's are shared out among its floes.
  GEM_DEVICE bool takes(std::int32_t body, std::int32_t row, bool as_b) const {
    return is_large(s_, s_.row_other[row]) || (!as_b && body != 0);
  }

  /// Reads the row of a body by a group of lanes and gives its points their places.
  template <class Group>
  GEM_DEVICE void list_points(const Group& lanes, std::int32_t e, const std::int32_t* bodies_before) {
    const std::int32_t body = s_.solver_entry[e].body;
    const BodyMotion& motion = s_.motion[body];
    const std::int32_t begin = motion.row_begin, lower = motion.lower_count, places = motion.row_count;
    std::int32_t count = 0, as_b = 0, taken = 0;
    for (std::int32_t first = 0; first < places; first += Group::size) {
      const std::int32_t at = first + lanes.rank();
      const std::int32_t points = points_at(begin, at, places).count;
      count += lanes.sum(points);
      as_b += lanes.sum(at < lower ? points : 0);
      taken += lanes.sum(points > 0 && takes(body, begin + at, at < lower) ? points : 0);
    }
    std::int32_t room = lanes.rank() == 0 ? take_records(count) : 0;
    room = lanes.from(room, 0);
    std::int32_t take = lanes.rank() == 0 && taken > 0 ? crew_.add(&crew_.shared().taken, taken) : 0;
    take = lanes.from(take, 0);
    const std::int32_t moved_at = motion_ ? room_place(crew_.block(), own_.count() + e - own_.begin) : -1;
    std::int32_t before = 0;
    for (std::int32_t first = 0; first < places; first += Group::size) {
      const std::int32_t at = first + lanes.rank();
      const RowPoints points = points_at(begin, at, places);
      const std::int32_t mine = before + lanes.sum_below(points.count);
      const bool mine_to_take = points.count > 0 && takes(body, begin + at, at < lower);
      const std::int32_t to = take + lanes.sum_below(mine_to_take ? points.count : 0);
      for (std::int32_t k = 0; k < points.count; ++k) {
        PointCell& point = s_.point[points.first + k];
        const std::int32_t in_room = room < 0 ? -1 : room_place(crew_.block(), room + mine + k);
        (at < lower ? point.place_b : point.place_a) = 2 * begin + mine + k;
        (at < lower ? point.room_b : point.room_a) = in_room;
        (at < lower ? point.motion_b : point.motion_a) = moved_at;
        if (mine_to_take) taken_list()[to + k] = points.first + k;
      }
      before += lanes.sum(points.count);
      take += lanes.sum(mine_to_take ? points.count : 0);
    }
    if (lanes.rank() != 0) return;
    const BodyCell& cell = s_.body[body];
    const std::uint32_t below = s_.touched_bodies[body / 32] & ((1U << (body % 32)) - 1U);
    entry_[e] = {body,
                 2 * begin,
                 room,
                 as_b,
                 count,
                 static_cast<float>(cell.inverse_mass),
                 static_cast<float>(cell.inverse_inertia),
                 bodies_before[body / 32] + bits_in(below)};
    s_.body_points[body] = {moment_, count};
    (motion_ ? motion_[e] : s_.added[body]) = {};
  }

  GEM_DEVICE RowPoints points_at(std::int32_t begin, std::int32_t at, std::int32_t places) const {
    if (at >= places || s_.stamp[begin + at].entry != moment_) return {0, 0};
    return s_.row_points[begin + at];
  }

  // -- begin --

  GEM_DEVICE void clear_marks() {
    for (std::int32_t w = rank_of(crew_); w < bit_words(s_); w += size_of(crew_))
      s_.touched_bodies[w] = s_.touched_spots[w] = 0;
    for (std::int32_t i = rank_of(crew_); i < s_.bodies; i += size_of(crew_)) s_.work_created[i] = 0.0;
    if (rank_of(crew_) == 0) s_.counters->asked[0] = s_.counters->asked[1] = 0;
  }

  GEM_DEVICE std::int32_t points_of(std::int32_t body) const {
    const BodyPoints points = s_.body_points[body];
    return points.moment == moment_ ? points.count : 0;
  }

  GEM_DEVICE static PushRecord* record_at(const DeviceScene& s, Crew& crew, std::int32_t place, std::int32_t room) {
    if (room >= 0) return reinterpret_cast<PushRecord*>(crew.room_of(room >> 16)) + (room & 0xffff);
    return place >= 0 ? s.push + place : nullptr;
  }

  GEM_DEVICE static const AddedMotion* motion_at(const DeviceScene& s, Crew& crew, std::int32_t room,
                                                 std::int32_t body) {
    return room >= 0 ? reinterpret_cast<const AddedMotion*>(crew.room_of(room >> 16)) + (room & 0xffff)
                     : s.added + body;
  }

  GEM_DEVICE double cap_of(const Contact& contact, const BodyCell& a, const BodyCell& b, double last) const {
    const MomentConstants& c = s_.constants;
    if (!c.crushing_limit || (a.kind != BodyKind::floe && b.kind != BodyKind::floe)) return no_cap;
    const CrushingIce ice{c.ice.pressure, c.ice.exponent, crushed_thickness(a.kind, a.thickness, b.thickness)};
    return impulse_cap(c, ice, s_.area[contact.a], s_.area[contact.b], contact.count, last);
  }

  GEM_DEVICE void begin_point(std::int32_t i) {
    PointCell point = s_.point[taken_list()[i - points_.begin]];
    Contact& contact = s_.contact[point.pair];
    ContactSlot& slot = contact.slot[point.slot];
    const BodyCell &a = s_.body[contact.a], &b = s_.body[contact.b];
    PointImpulse<double> last = last_impulse(s_.memory[point.pair], slot.feature, moment_);
    const double cap = cap_of(contact, a, b, last.normal);
    const PointGeometry<double> geometry = point_geometry(
        s_.constants, contact, slot, shared_mass({a.inverse_mass, a.inverse_inertia}, points_of(contact.a)),
        shared_mass({b.inverse_mass, b.inverse_inertia}, points_of(contact.b)), cap);
    last.repair = repair_to_go_on(s_.constants, last.repair, geometry.nn);
    slot.cap = cap;
    s_.points.set(i, geometry);
    point.a = contact.a;
    point.b = contact.b;
    s_.taken_point[i] = point;
    write_base(s_, i, geometry, last);
  }

  // -- settle --

  /// Work of the contacts of each body, then of all: positive, where the events gave energy.
  GEM_DEVICE void add_work_created() {
    crew_.barrier();
    for (std::int32_t e = own_.begin + crew_.thread(); e < own_.end; e += crew_.threads()) {
      const SolverEntry& entry = entry_[e];
      double sum = 0.0;
      for (std::int32_t k = 0; k < entry.count; ++k) sum += s_.push_base[entry.place + k].part[solved_work];
      s_.work_created[entry.body] = sum;
    }
    crew_.barrier();
    if (crew_.block() != 0) return;
    const double sum = summed_work(s_.work_created, s_.work_created, s_.bodies).given;
    if (crew_.thread() == 0) crew_.shared().energy_created = larger(sum, 0.0);
  }

  /// Enters the base's impulses of a point, and what they give to both bodies.
  GEM_DEVICE static void write_base(const DeviceScene& s, std::int32_t i, const PointGeometry<double>& g,
                                    const PointImpulse<double>& p) {
    const PointCell point = s.taken_point[i];
    s.points.set(i, p);
    const double acts = p.normal != 0.0 || p.tangential != 0.0 || p.repair != 0.0 ? 1.0 : 0.0;
    const auto write = [&](std::int32_t place, double lever_n, double lever_t) {
      if (place < 0) return;
      const Push<double> push = push_of(g, p, lever_n, lever_t);
      s.push_base[place] = {{push.x, push.y, push.shift_x, push.shift_y, push.twist, push.turn, acts, 0.0}};
    };
    write(point.place_a, g.lever_a_n, g.lever_a_t);
    write(point.place_b, g.lever_b_n, g.lever_b_t);
  }

  /// Velocities that the base's impulses give, and what they do to the energy.
  GEM_DEVICE void settle() {
    const auto lanes = crew_.lanes();
    constexpr int size = Crew::Lanes::size, each = 8 / size;
    for (std::int32_t e = own_.begin + group(); e < own_.end; e += groups()) {
      const SolverEntry& entry = entry_[e];
      const std::int32_t body = entry.body, as_b = entry.as_b, count = entry.count;
      const PushBase* const record = s_.push_base + entry.place;
      double sum[each] = {};
      for (std::int32_t k = 0; k < count; ++k)
        for (int j = 0; j < each; ++j) {
          const int c = lanes.rank() + j * size;
          const double part = record[k].part[c];
          sum[j] += k < as_b || c == solved_acted ? part : -part;
        }
      const BodyCell& cell = s_.body[body];
      for (int j = 0; j < each; ++j) {
        const int c = lanes.rank() + j * size;
        const double answer = c < 4 ? cell.inverse_mass : c < solved_acted ? cell.inverse_inertia : 1.0;
        const double moved = answer * sum[j];
        sum[j] = c == 0   ? cell.velocity.x + moved
                 : c == 1 ? cell.velocity.y + moved
                 : c == 4 ? cell.spin + moved
                          : moved;
        s_.solved[body].part[c] = sum[j];
      }
      const double x = lanes.from(sum[0], 0), y = lanes.from(sum[1 / size], 1 % size),
                   spin = lanes.from(sum[4 / size], 4 % size);
      if (lanes.rank() != 0) continue;
      const BodyMotion& motion = s_.motion[body];
      const ImpulseWork work = work_on_body({x, y, spin, 0.0, 0.0, 0.0}, cell.velocity.x, cell.velocity.y, cell.spin,
                                            motion.mass, motion.inertia);
      s_.given[entry.rank] = work.given;
      s_.answered[entry.rank] = work.answered;
    }
  }

  GEM_DEVICE static double sum_of_group(const double* terms, std::int32_t count) {
    double eight[8];
    for (int k = 0; k < 8; ++k) {
      double four[4];
      for (int j = 0; j < 4; ++j) four[j] = 4 * k + j < count ? terms[4 * k + j] : 0.0;
      eight[k] = sum_of_four(four);
    }
    return sum_of_eight(eight);
  }

  /// ordered_sum() of the energies of all bodies; every block works it out for itself.
  GEM_DEVICE ImpulseWork summed_work(const double* given, const double* answered, std::int32_t count) {
    const std::int32_t most = (s_.bodies + sum_width - 1) / sum_width;
    double* to = s_.partial_sum + static_cast<std::int64_t>(crew_.block()) * 4 * (most + 1);
    if (count == 0) return {0.0, 0.0};
    do {
      const std::int32_t made = (count + sum_width - 1) / sum_width;
      for (std::int32_t k = crew_.thread(); k < 2 * made; k += crew_.threads()) {
        const std::int32_t first = sum_width * (k < made ? k : k - made);
        to[k] = sum_of_group((k < made ? given : answered) + first, count - first);
      }
      crew_.block_barrier();
      given = to;
      answered = to + made;
      to += 2 * made;
      count = made;
    } while (count > 1);
    const ImpulseWork work{given[0], answered[0]};
    crew_.block_barrier();  // before the memory is used again
    return work;
  }

  /// As CoupledSolver::keep_best_share().
  GEM_DEVICE void keep_best_share(double limit) {
    const double share = best_share(summed_work(s_.given, s_.answered, bodies_));
    if (!(share < limit)) return;
    each_point([&](std::int32_t i) {
      PointImpulse<double> impulse = s_.points.impulse(i);
      impulse.normal *= share;
      impulse.tangential *= share;
      write_base(s_, i, s_.points.geometry(i), impulse);
    });
    crew_.barrier();
    settle();
    crew_.barrier();
  }

  // -- rounds --

  GEM_DEVICE static Motion<double> solved_motion(const DeviceScene& s, std::int32_t body) {
    const SolvedMotion& m = s.solved[body];
    return {m.part[0], m.part[1], m.part[4], m.part[2], m.part[3], m.part[5]};
  }

  /// A point at the start of a round; `carried` is what the last one left, less what is in the base now.
  GEM_DEVICE GEM_INLINE static void hold(const DeviceScene& s, Crew& crew, std::int32_t i, HeldPoint& held) {
    const PointCell point = s.taken_point[i];
    held.motion_a = motion_at(s, crew, point.motion_a, point.a);
    held.motion_b = motion_at(s, crew, point.motion_b, point.b);
    held.to_a = record_at(s, crew, point.place_a, point.room_a);
    held.to_b = record_at(s, crew, point.place_b, point.room_b);
    const PointGeometry<double> geometry = s.points.geometry(i);
    enter_geometry(held.frame, geometry);
    enter_base(held.frame, geometry, s.points.impulse(i), solved_motion(s, point.a), solved_motion(s, point.b));
    held.at = {0.0F, 0.0F, 0.0F};
  }

  /// The additions of a round enter the base.
  GEM_DEVICE GEM_INLINE static void let_go(const DeviceScene& s, std::int32_t i, const HeldPoint& held) {
    const PointGeometry<double> g = s.points.geometry(i);
    write_base(s, i, g,
               with_additions(s.constants.point_friction, g, s.points.impulse(i), held.at, held.frame.least,
                              held.frame.most, held.frame.repair_least));
    PointImpulse<float>& carried = s.held[i].carried;
    carried.normal = held.carried.normal - held.at.normal;
    carried.tangential = held.carried.tangential - held.at.tangential;
    carried.repair = held.carried.repair - held.at.repair;
  }

  GEM_DEVICE GEM_INLINE static void push(const HeldPoint& held) {
    const PointPush<float> p = push_of(held.frame, held.carried);
    if (held.to_a) *held.to_a = {{p.x, p.y, p.shift_x, p.shift_y, p.twist_a, p.turn_a, 0.0F, 0.0F}};
    if (held.to_b) *held.to_b = {{p.x, p.y, p.shift_x, p.shift_y, p.twist_b, p.turn_b, 0.0F, 0.0F}};
  }

  /// Motions by the additions of the round: as CoupledRounds::move(), a lane for each component.
  GEM_DEVICE GEM_INLINE static void move(Crew& crew, const RoundDesk& desk) {
    constexpr int size = Crew::Lanes::size;
    const int rank = crew.thread() % size, groups = crew.threads() / size;
    for (std::int32_t e = desk.own.begin + crew.thread() / size; e < desk.own.end; e += groups) {
      const SolverEntry entry = desk.entry[e];
      const PushRecord* const record = entry.room >= 0 ? desk.room + entry.room : desk.push + entry.place;
      for (int c = rank; c < 6; c += size) {
        float to_b = 0.0F, to_a = 0.0F;
        std::int32_t k = 0;
        for (; k < entry.as_b; ++k) to_b += record[k].part[c];
        for (; k < entry.count; ++k) to_a += record[k].part[c];
        (desk.motion ? desk.motion[e] : desk.added[entry.body]).part[c] =
            (c < 4 ? entry.inverse_mass : entry.inverse_inertia) * (to_b - to_a);
      }
    }
  }

  template <PointFriction law, bool judged>
  GEM_DEVICE GEM_INLINE static float visit(const RoundDesk& desk, HeldPoint& held, float ahead) {
    const AddedMotion a = *held.motion_a, b = *held.motion_b;
    const Approach<float> w{b.part[0] - a.part[0],
                            b.part[1] - a.part[1],
                            b.part[2] - a.part[2],
                            b.part[3] - a.part[3],
                            a.part[4],
                            a.part[5],
                            b.part[4],
                            b.part[5]};
    const float asked = visit_point<law, judged>(held.frame, w, desk.pace, ahead, held.at, held.carried);
    push(held);
    return asked;
  }

  GEM_DEVICE static void note_asked(Crew& crew, std::uint32_t* asked, float most) {
    const auto warp = crew.warp();
    const std::uint32_t all = warp.highest(ordered_bits(most));
    if (warp.rank() == 0 && all != 0) crew.highest(asked, all);
  }

  template <PointFriction law, bool judged>
  GEM_DEVICE GEM_NOINLINE static float visit_in_memory(const RoundDesk& desk, HeldPoint* held, float ahead) {
    return visit<law, judged>(desk, *held, ahead);
  }

  /// One round; returns whether it was the last. A function of its own: the points that a thread holds take most of its
  /// registers.
  template <PointFriction law>
  GEM_DEVICE GEM_NOINLINE static bool run_round(const DeviceScene& s, Crew& crew, const RoundDesk desk,
                                                const Stretch points, Progress& kept) {
    Progress progress = kept;
    std::uint32_t* const asked = s.counters->asked;
    const std::int32_t size = crew.threads(), i0 = points.begin + crew.thread(), end = points.end;
    HeldPoint first, second;
    HeldPoint* const others = s.held;
    const auto each = [&](auto&& work) {
      if (i0 < end) work(i0, first);
      if (i0 + size < end) work(i0 + size, second);
      for (std::int32_t i = i0 + 2 * size; i < end; i += size) work(i, others[i]);
    };
    bool fresh = progress.course.iteration() == 0;  // nothing is added yet
    each([&](std::int32_t i, HeldPoint& held) {
      held.carried = fresh ? PointImpulse<float>{0.0F, 0.0F, 0.0F} : others[i].carried;
      hold(s, crew, i, held);
      if (!fresh) push(held);
    });
    if (!fresh) crew.barrier();
    crew.lap(stage_frames);
    auto next = IterationCourse::Next::iteration;
    for (; next == IterationCourse::Next::iteration; fresh = false) {
      if (!fresh) {
        move(crew, desk);
        crew.barrier();
      }
      const float ahead = progress.course.ahead();
      if (progress.course.judged()) {
        float most = 0.0F;
        if (i0 < end) most = larger(visit<law, true>(desk, first, ahead), most);
        if (i0 + size < end) most = larger(visit<law, true>(desk, second, ahead), most);
        for (std::int32_t i = i0 + 2 * size; i < end; i += size)
          most = larger(visit_in_memory<law, true>(desk, others + i, ahead), most);
        note_asked(crew, asked + progress.turn, most);
      } else {
        if (i0 < end) visit<law, false>(desk, first, ahead);
        if (i0 + size < end) visit<law, false>(desk, second, ahead);
        for (std::int32_t i = i0 + 2 * size; i < end; i += size) visit_in_memory<law, false>(desk, others + i, ahead);
      }
      crew.barrier();
      if (progress.course.judged()) {
        progress.residual = static_cast<double>(from_ordered_bits(asked[progress.turn]));
        progress.turn = 1 - progress.turn;
        if (rank_of(crew) == 0) asked[progress.turn] = 0;
      }
      next = progress.course.after(progress.residual);
    }
    crew.lap(stage_iterations);
    each([&](std::int32_t i, HeldPoint& held) { let_go(s, i, held); });
    kept = progress;
    return next == IterationCourse::Next::end;
  }

  GEM_DEVICE bool run_round_by_law(Progress& progress) {
    const RoundDesk desk{own_,    entry_, reinterpret_cast<const PushRecord*>(crew_.room()), s_.push, s_.added,
                         motion_, pace_};
    switch (s_.constants.point_friction) {
      case PointFriction::none:
        return run_round<PointFriction::none>(s_, crew_, desk, points_, progress);
      case PointFriction::coulomb:
        return run_round<PointFriction::coulomb>(s_, crew_, desk, points_, progress);
      default:
        return run_round<PointFriction::fixed_direction>(s_, crew_, desk, points_, progress);
    }
  }

  GEM_DEVICE void iterate() {
    const MomentConstants& c = s_.constants;
    Progress progress{IterationCourse(c.residual_speed, c.iterations_maximum, c.tight_residual)};
    for (bool done = false; !done;) {
      done = run_round_by_law(progress);
      crew_.barrier();
      settle();
      crew_.barrier();
    }
    if (rank_of(crew_) == 0) {
      crew_.shared().iterations = static_cast<std::int32_t>(progress.course.iteration());
      crew_.shared().residual = progress.residual;
    }
  }

  // -- end --

  /// Hands the impulses back to the contact.
  GEM_DEVICE void hand_back(std::int32_t i) {
    const PointCell point = s_.taken_point[i];
    Contact& contact = s_.contact[point.pair];
    ContactSlot& slot = contact.slot[point.slot];
    const PointImpulse<double> p = s_.points.impulse(i);
    slot.impulse.normal = p.normal;
    slot.impulse.tangential = p.tangential;
    slot.repair = p.repair;
    remember(s_.memory[point.pair], contact, point.slot, p, moment_);
    if (s_.wants_samples) judge_point(point, contact, slot);
  }

  GEM_DEVICE void judge_point(const PointCell& point, const Contact& contact, const ContactSlot& slot) {
    BlockCell& shared = crew_.shared();
    const BodyCell &a = s_.body[contact.a], &b = s_.body[contact.b];
    const SolvedMotion &of_a = s_.solved[contact.a], &of_b = s_.solved[contact.b];
    PairBodies after;
    after.velocity_a = {of_a.part[0], of_a.part[1]};
    after.velocity_b = {of_b.part[0], of_b.part[1]};
    after.spin_a = of_a.part[4];
    after.spin_b = of_b.part[4];
    const PointQuality quality = point_quality(contact, slot, {a.inverse_mass, a.inverse_inertia},
                                               {b.inverse_mass, b.inverse_inertia}, relative_velocity(after, slot));
    if (slot.separation <= 0.0 || slot.impulse.normal > 0.0) crew_.add(&shared.contacts, 1);
    if (quality.complementarity > 0.0) crew_.highest(&shared.complementarity, strict::bits_of(quality.complementarity));
    if (quality.cone_excess > 0.0) crew_.highest(&shared.cone_excess, strict::bits_of(quality.cone_excess));
    const bool with_b = b.inverse_mass > 0.0;
    if (point.place_b >= 0) s_.push_base[point.place_b].part[solved_work] = with_b ? quality.work : 0.0;
    if (point.place_a >= 0) s_.push_base[point.place_a].part[solved_work] = with_b ? 0.0 : quality.work;
  }

  const DeviceScene& s_;
  Crew& crew_;
  std::int32_t moment_;
  Stretch points_;  // that the block takes
  std::size_t room_;
  MomentPace<float> pace_;
  std::int32_t bodies_ = 0;
  Stretch own_;                     // the block's stretch of the bodies with points, by spot
  SolverEntry* entry_ = nullptr;    // by place among them
  AddedMotion* motion_ = nullptr;   // the same, in the block's fast memory; null: they stand by body
  std::int32_t records_begin_ = 0;  // in the block's fast memory
};

/// Resolves a coupled moment. The iterations are left to the part of the crew that waits least for each other: few
/// points to one block, others to one cluster of blocks where the crew is made of several.
template <class Crew>
GEM_DEVICE inline void resolve_coupled(const DeviceScene& s, Crew& crew, const Desk& desk, std::int32_t moment) {
  const std::int32_t points = s.counters->points;
  if (points == 0) return;
  if (crew.blocks() > 1 && points <= crew.threads()) {
    OneBlock<Crew> alone(crew);
    if (crew.block() == 0) MomentSolver<OneBlock<Crew>>(s, alone, moment, desk.solver_bytes).solve();
  } else {
    crew.solve([&](auto& team) {
      using Team = std::remove_reference_t<decltype(team)>;
      MomentSolver<Team>(s, team, moment, desk.solver_bytes).solve();
    });
  }
  crew.barrier();
  crew.lap(stage_solver_wait);
}

}  // namespace gem
