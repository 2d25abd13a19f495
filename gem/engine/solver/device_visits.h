// The points of a round on a device: how they are entered, visited and left, each by the thread that holds it, and
// where each writes what it pushes its bodies by.
#pragma once

#include "gem/engine/solver/device_held.h"
#include "gem/engine/solver/device_settle.h"

namespace gem {

template <class Crew>
class SolverVisits {
 public:
  /// Numbers of records: of those that have none, and of the first of a round with halos.
  static constexpr std::uint32_t plain = 0, first_number = 1;

  /// Where a point finds one of its bodies.
  GEM_DEVICE static HeldPlace place_of(const DeviceScene& s, Crew& crew, const PointSide& side) {
    return {motion_at(s, crew, side), record_at(s, crew, side.place, side.room)};
  }

  /// The numbers of a point at the start of a round; `carried` is what the last one left, less what is in the base now.
  GEM_DEVICE GEM_INLINE static void enter(const DeviceScene& s, std::int32_t i, bool fresh, const HeldCell& cell,
                                          HeldPoint& held) {
    if (fresh)
      held.carried = {0.0F, 0.0F, 0.0F};
    else
      cell.load_additions(held);
    const PointCell& point = s.taken_point[i];
    const PointGeometry<double> geometry = s.points.geometry(i);
    enter_geometry(held.frame, geometry);
    enter_base(held.frame, geometry, s.points.impulse(i), solved_motion(s, point.a.body),
               solved_motion(s, point.b.body));
    held.at = {0.0F, 0.0F, 0.0F};
  }

  /// A point at the start of a round.
  GEM_DEVICE GEM_INLINE static void hold(const DeviceScene& s, Crew& crew, std::int32_t i, bool fresh) {
    const HeldCell cell = HeldTable(s, crew.room(), crew.shared().desk)[i];
    HeldPoint held;
    enter(s, i, fresh, cell, held);
    const PointCell& point = s.taken_point[i];
    held.a = place_of(s, crew, point.a);
    held.b = place_of(s, crew, point.b);
    cell.save_numbers(held);
    cell.set_places(held.a, held.b);
    if constexpr (Crew::has_halos)
      if (crew.shared().desk.has_halo) {
        clear_numbers(s, held.a.record);
        clear_numbers(s, held.b.record);
        if (!fresh) push(s, held, first_number);
        return;
      }
    if (!fresh) push(s, held, plain);
  }

  /// The additions of a round enter the base.
  GEM_DEVICE GEM_INLINE static void let_go(const DeviceScene& s, Crew& crew, std::int32_t i) {
    const HeldCell cell = HeldTable(s, crew.room(), crew.shared().desk)[i];
    HeldPoint held = cell.load();
    const PointGeometry<double> g = s.points.geometry(i);
    write_base(s, i, s.taken_point[i], g,
               with_additions(s.constants.point_friction, g, s.points.impulse(i), held.at, held.frame.least,
                              held.frame.most, held.frame.repair_least));
    held.carried.normal -= held.at.normal;
    held.carried.tangential -= held.at.tangential;
    held.carried.repair -= held.at.repair;
    cell.save_additions(held);
  }

  /// Points of a thread that stay in its registers while a round runs.
  static constexpr int kept = Crew::kept_points;
  struct KeptPoints {
    HeldPoint point[kept > 0 ? kept : 1];
    std::int32_t count = 0;
    bool more = false;  // the block has points that no thread keeps
  };

  /// Visits the points of this thread; returns, where `judged`, the largest speed that one asked for.
  template <PointFriction law, bool judged>
  GEM_DEVICE GEM_INLINE static float visit_all(const DeviceScene& s, Crew& crew, const SolverDesk& desk,
                                               KeptPoints& own, float ahead, std::uint32_t number) {
    float most = 0.0F;
    const MomentPace<float> pace = desk.pace;
    const auto visit_held = [&](HeldPoint& held) {
      most = larger(visit<law, judged>(s, pace, held, ahead, number), most);
    };
    for (int k = 0; k < kept; ++k)
      if (k < own.count) visit_held(own.point[k]);
    if (!own.more) return most;
    const auto visit_cell = [&](const HeldCell& cell) {
      HeldPoint held = cell.load();
      visit_held(held);
      cell.save_additions(held);
    };
    // each kind of memory by itself: the compiler has faster instructions where it knows which it is
    const HeldTable table(s, crew.room(), desk);
    const std::int32_t size = crew.threads(), end = desk.points.end;
    std::int32_t i = desk.points.begin + crew.thread() + kept * size;
    if constexpr (Crew::shares_rooms)
      for (; i < desk.fast.end; i += size) visit_cell(table.fast(i));
    for (; i < end; i += size) visit_cell(table.at_rest(i));
    return most;
  }

  /// A thread's points come to its registers, and what visits have changed goes back.
  GEM_DEVICE GEM_INLINE static void load(const DeviceScene& s, Crew& crew, const SolverDesk& desk, KeptPoints& own) {
    const std::int32_t size = crew.threads(), first = desk.points.begin + crew.thread(), end = desk.points.end;
    own.more = desk.points.count() > kept * size;
    for (int k = 0; k < kept; ++k)
      if (first + k * size < end) {
        own.point[k] = HeldTable(s, crew.room(), desk)[first + k * size].load();
        own.count = k + 1;
      }
  }
  GEM_DEVICE GEM_INLINE static void save(const DeviceScene& s, Crew& crew, const SolverDesk& desk,
                                         const KeptPoints& own) {
    const std::int32_t size = crew.threads(), first = desk.points.begin + crew.thread(), end = desk.points.end;
    for (int k = 0; k < kept; ++k)
      if (first + k * size < end) HeldTable(s, crew.room(), desk)[first + k * size].save_additions(own.point[k]);
  }

 private:
  GEM_DEVICE static PushRecord* record_at(const DeviceScene& s, Crew& crew, std::int32_t place, std::int32_t room) {
    if constexpr (Crew::shares_rooms)
      if (room >= 0) return reinterpret_cast<PushRecord*>(crew.room_of(room >> 16)) + (room & 0xffff);
    if (place < 0) return nullptr;
    if (Crew::has_halos && crew.shared().desk.has_halo)
      return reinterpret_cast<PushRecord*>(reinterpret_cast<NumberedPush*>(s.push_base) + place);
    return s.push + place;
  }
  GEM_DEVICE static const AddedMotion* motion_at(const DeviceScene& s, Crew& crew, const PointSide& side) {
    if constexpr (Crew::shares_rooms)
      if (side.motion >= 0)
        return reinterpret_cast<const AddedMotion*>(crew.room_of(side.motion >> 16)) + (side.motion & 0xffff);
    if (Crew::has_halos && crew.shared().desk.has_halo && side.place >= 0)
      return crew.shared().desk.motion + side.motion;
    return s.added + side.body;
  }
  GEM_DEVICE static Motion<double> solved_motion(const DeviceScene& s, std::int32_t body) {
    const SolvedMotion& m = s.solved[body];
    return {m.part[0], m.part[1], m.part[4], m.part[2], m.part[3], m.part[5]};
  }

  GEM_DEVICE GEM_INLINE static void write(const DeviceScene& s, PushRecord* record, const PointPush<float>& p,
                                          float twist, float turn, std::uint32_t number) {
    if (!record) return;  // a fixed body
    if constexpr (Crew::has_halos)
      if (number != plain) {
        NumberedPush* const to = numbered(s, record, number);
        Crew::write_whole(&to->half[0], {{p.x, p.y, p.shift_x}, number});
        Crew::write_whole(&to->half[1], {{p.shift_y, twist, turn}, number});
        return;
      }
    record->pair[0] = {{p.x, p.y}};
    record->pair[1] = {{p.shift_x, p.shift_y}};
    record->pair[2] = {{twist, turn}};
  }
  /// `number`: of the iteration, where there are halos; or plain.
  GEM_DEVICE GEM_INLINE static void push(const DeviceScene& s, const HeldPoint& held, std::uint32_t number) {
    const PointPush<float> p = push_of(held.frame, held.carried);
    write(s, held.a.record, p, p.twist_a, p.turn_a, number);
    write(s, held.b.record, p, p.twist_b, p.turn_b, number);
  }
  /// Where the records of the round will be stands the base, or what an earlier round left, whose numbers come again:
  /// nothing of it must be taken for a record, once all blocks have met and wait.
  GEM_DEVICE static void clear_numbers(const DeviceScene& s, PushRecord* record) {
    if (!record) return;
    for (std::uint32_t turn = 0; turn < 2; ++turn)
      for (NumberedHalf& half : numbered(s, record, turn)->half) Crew::write_whole(&half, {});
  }
  /// Where an iteration's record stands: by turns, so that those of a row follow each other.
  GEM_DEVICE GEM_INLINE static NumberedPush* numbered(const DeviceScene& s, PushRecord* record, std::uint32_t number) {
    return reinterpret_cast<NumberedPush*>(record) + static_cast<std::int32_t>(number % 2) * s.push_capacity;
  }

  template <PointFriction law, bool judged>
  GEM_DEVICE GEM_INLINE static float visit(const DeviceScene& s, MomentPace<float> pace, HeldPoint& held, float ahead,
                                           std::uint32_t number) {
    const AddedMotion a = *held.a.motion, b = *held.b.motion;
    const FloatPair &turn_a = a.pair[2], &turn_b = b.pair[2];
    const Approach<float> w{b.pair[0].part[0] - a.pair[0].part[0],
                            b.pair[0].part[1] - a.pair[0].part[1],
                            b.pair[1].part[0] - a.pair[1].part[0],
                            b.pair[1].part[1] - a.pair[1].part[1],
                            turn_a.part[0],
                            turn_a.part[1],
                            turn_b.part[0],
                            turn_b.part[1]};
    const PointImpulse<float> step = visit_point<law>(held.frame, w, pace, ahead, held.at, held.carried);
    push(s, held, number);  // first of all: others wait for it
    return judged ? speed_asked<law>(held.frame, step, pace) : 0.0F;
  }
};

}  // namespace gem
