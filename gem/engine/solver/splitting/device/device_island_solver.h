// Converged impulses of the points of one island on a device, by the threads of a team: IslandSolver (island_solver.h)
// with the same sums in the same order. One thread visits each point, and one sums what the points of a body ask of it.
#pragma once

#include "gem/engine/solver/splitting/device/device_front_factor.h"
#include "gem/engine/solver/splitting/device/device_front_solve.h"
#include "gem/engine/solver/splitting/device/device_island_gradient.h"
#include "gem/engine/solver/splitting/device/device_island_points.h"
#include "gem/engine/solver/splitting/round_control.h"

namespace gem {

template <class Team>
class DeviceIslandSolver : private DeviceIslandPoints<Team> {
 public:
  GEM_DEVICE DeviceIslandSolver(const DeviceScene& s, const Team& team, const TeamMemory& memory)
      : Base(s, team, memory),
        p_(*memory.part),
        gradient_(s, team, memory),
        factor_(team, memory),
        fronts_(team, memory) {}

  /// Solves the island and notes its iterations and its error. The fronts are set.
  GEM_DEVICE void solve() {
    const StepConstants& c = s_.constants;
    factor_.place_blocks();
    std::int64_t iterations = 0;
    double error = 0.0;
    move_by_base();
    const bool chain = v_.size().is_chain();
    const bool joined = cell_.joins_rounds;
    const RoundKind usual = RoundControl::usual_kind(joined);
    RoundKind kind = RoundControl::first_kind(usual, chain, c.iterations_maximum);
    do {
      begin_round();
      iterate_round(kind, iterations, error);
      const bool failed = kind == RoundKind::attempt && !(error <= tolerance());
      kind = usual;
      if (failed) continue;
      this->template add_to_base<Point>();
      const bool missed = error > tolerance();
      if (joined && missed && gradient_.solve(true, iterations, error)) return;
    } while (RoundControl::goes_on(tolerance(), c.iterations_maximum, iterations, error));
    if (error > tolerance()) {
      keep_best_share();
      iterations = c.iterations_maximum;  // too few were left for another round
    }
    note(iterations, error);
  }

  /// Whether the island needs no iterations; then notes its error. Needs no fronts.
  GEM_DEVICE bool settled() {
    const StepConstants& c = s_.constants;
    const auto per_step = static_cast<float>(1.0 / c.dt);
    move_by_base();
    if (team_.rank() == 0) cell_.asked = 0;
    team_.sync();
    std::uint64_t asked = 0;
    each_of(team_, 0, v_.points, [&](std::int32_t k) {
      const std::int32_t i = v_.m.where[k].taken;
      const PointCell& cell = s_.taken_point[i];
      const PointGeometry<double> g = s_.points.geometry(i);
      const PointInertia inertia = inertia_of(g, inverse_mass_of(s_, cell.a), inverse_mass_of(s_, cell.b));
      const float speed = speed_asked_at_base(c.point_friction, g, inertia, s_.points.spare(i), s_.points.impulse(i),
                                              motion_of(cell.a), motion_of(cell.b), per_step);
      asked += RoundControl::asked(tolerance(), speed);
    });
    if (asked > 0) Atomics::add(&cell_.asked, asked);
    team_.sync();
    const double error = RoundControl::error_of_base(tolerance(), cell_.asked);
    if (!(error <= tolerance())) return false;
    note(0, error);
    return true;
  }

 private:
  using Base = DeviceIslandPoints<Team>;
  using Point = SplitPoint<float>;
  using Base::cell_, Base::part_, Base::s_, Base::team_, Base::v_;
  using Base::entry_of, Base::motion_of, Base::move_by_base, Base::note, Base::raise_to, Base::tolerance;
  using typename Base::Atomics, typename Base::Part;

  /// Sets the points at the base; the additions of the bodies are zero.
  GEM_DEVICE void begin_round() {
    if (team_.rank() == 0) cell_.repairs = 0;
    team_.sync();
    each_of(team_, 0, v_.points, [&](std::int32_t k) {
      const std::int32_t i = v_.m.where[k].taken;
      const PointCell& cell = s_.taken_point[i];
      const PointGeometry<double> g = s_.points.geometry(i);
      const PointImpulse<double> impulse = s_.points.impulse(i);
      Point q = load_point<Point>(v_, k);
      set_base(q, 0, s_.constants.point_friction, g, s_.points.spare(i), impulse, motion_of(cell.a), motion_of(cell.b));
      store_point<point_fields::base>(v_, k, q);
      store_point<point_fields::watch>(v_, k, q);
      if (repairs(g, impulse)) Atomics::add(&cell_.repairs, 1);
    });
    each_of(team_, 0, 2 * v_.bodies, [&](std::int32_t k) { v_.m.now[k] = v_.m.sum[k] = v_.m.given[k] = {}; });
    team_.sync();
    halves_ = repaired_ || cell_.repairs > 0 ? 2 : 1;
    repaired_ = halves_ == 2;
  }

  GEM_DEVICE void iterate_round(RoundKind kind, std::int64_t& iterations, double& error) {
    const StepConstants& c = s_.constants;
    RoundControl round(kind, tolerance(), c.iterations_maximum, iterations);
    stiffen(round);
    push();
    for (;;) {
      round.begin_iteration();
      step();
      const bool judged = round.judged();
      if (judged && round.ends(compare())) break;
      visit(judged, round.watch_tolerance());
      if (!change_stiffness(round)) continue;
      push();
    }
    iterations += round.iteration();
    error = round.error();
  }

  /// Moves the bodies by the solution of the equations.
  GEM_DEVICE void step() {
    fronts_.solve(halves_);
    team_.sync();
  }

  GEM_DEVICE void stiffen(const RoundControl& round) {
    each_of(team_, 0, v_.points, [&](std::int32_t k) {
      Point q = load_point<Point>(v_, k);
      stiffen_point(q, round.stiffness(), round.raised());
      store_point<point_fields::stiffness>(v_, k, q);
    });
    team_.sync();
    factor_.factor();
  }

  GEM_DEVICE bool change_stiffness(RoundControl& round) {
    const RoundControl::Change change = round.change();
    if (change == RoundControl::Change::none) return false;
    if (change == RoundControl::Change::raise && !raise()) return false;
    round.changed(change);
    stiffen(round);
    return true;
  }

  GEM_DEVICE bool raise() {
    if (team_.rank() == 0) cell_.raised = 0;
    team_.sync();
    each_of(team_, 0, v_.points, [&](std::int32_t k) {
      Point q = load_point<Point>(v_, k);
      if (raise_point(q) > 0.0F) Atomics::add(&cell_.raised, 1);
      store_point<point_fields::scale>(v_, k, q);
      store_point<point_fields::watch>(v_, k, q);
    });
    team_.sync();
    return cell_.raised > 0;
  }

  /// Calls of_velocity(point, a, b) and of_repair(point, a, b) for all points, writes what they ask for, and stores the
  /// fields in `changed`.
  template <FieldRange changed, class OfVelocity, class OfRepair>
  GEM_DEVICE GEM_INLINE void each_push(bool watches, OfVelocity&& of_velocity, OfRepair&& of_repair) {
    each_of(team_, 0, v_.points, [&](std::int32_t k) {
      const IslandPointEnds at = v_.m.ends[k];
      Point q = load_point<Point>(v_, k);
      float a[3], b[3];
      this->load(at.a, 0, a);
      this->load(at.b, 0, b);
      this->write_push(at, q, 0, of_velocity(q, a, b));
      if (halves_ == 2) {
        this->load(at.a, 1, a);
        this->load(at.b, 1, b);
        this->write_push(at, q, 1, of_repair(q, a, b));
      }
      store_point<changed>(v_, k, q);
      if (watches) store_point<point_fields::watch>(v_, k, q);
    });
    team_.sync();
  }

  /// Sets the right side: minus the momentum of the motions, and what the points ask for.
  GEM_DEVICE void sum_pushes() {
    each_body_half([&](std::int32_t place, int half, const BodyRecords& records) {
      const ScaledBody& body = v_.m.scaled[place];
      const FloatQuad now = v_.m.now[2 * place + half];
      FloatQuad sum{{-(body.mass * now.part[0]), -(body.mass * now.part[1]), -(body.inertia * now.part[2]), 0.0F}};
      this->add_pushes(records, half, sum);
      v_.m.sum[2 * place + half] = sum;
    });
    part_.sync();
  }
  /// Calls work(place, half, records) for the bodies of the own branch; the first block also for those of the trunk.
  template <class Work>
  GEM_DEVICE GEM_INLINE void each_body_half(Work&& work) {
    const auto take = [&](std::int32_t place, int half) { work(place, half, v_.m.records[place]); };
    each_of(part_, halves_ * p_.branch.begin, halves_ * p_.branch.end,
            [&](std::int32_t k) { take(k / halves_, k % halves_); });
    if (team_.part_index() != 0) return;
    const TreePart& trunk = p_.trunk;
    each_of(part_, halves_ * trunk.first_own, halves_ * (trunk.first_own + trunk.owns),
            [&](std::int32_t k) { take(v_.m.own_place[k / halves_], k % halves_); });
  }
  GEM_DEVICE void push() {
    each_push<FieldRange{0, 0}>(
        false, [](Point& q, const float* a, const float* b) { return push_of(q, a, b); },
        [](Point& q, const float* a, const float* b) { return repair_push_of(q, a, b); });
    sum_pushes();
  }

  /// Visits all points. `watches`: then counts what persists.
  GEM_DEVICE void visit(bool watches, float watch_tolerance) {
    const PointFriction law = s_.constants.point_friction;
    each_push<point_fields::moves>(
        watches,
        [&](Point& q, const float* a, const float* b) {
          const PointShare<float> share = law == PointFriction::none ? visit_point<PointFriction::none>(q, a, b)
                                          : law == PointFriction::coulomb
                                              ? visit_point<PointFriction::coulomb>(q, a, b)
                                              : visit_point<PointFriction::fixed_direction>(q, a, b);
          if (watches) watch_point(q, a, b, watch_tolerance);
          return share;
        },
        [](Point& q, const float* a, const float* b) { return visit_repair(q, a, b); });
    sum_pushes();
  }

  GEM_DEVICE static bool is_finite(float x) { return magnitude(x) <= 3.402823466e38F; }

  /// Sets the answers of the points and measures the differences.
  GEM_DEVICE SplittingDifferences compare() {
    const PointFriction law = s_.constants.point_friction;
    const auto per_step = static_cast<float>(1.0 / s_.constants.dt);
    if (team_.rank() == 0)
      cell_.points_bits = cell_.bodies_bits = cell_.change_bits = cell_.motion_bits = cell_.not_finite = 0;
    team_.sync();
    float points = 0.0F;
    each_push<point_fields::answer>(
        false,
        [&](Point& q, const float* a, const float* b) {
          points = larger(points, mismatch_of(q, a, b));
          return law == PointFriction::none      ? answer_point<PointFriction::none>(q, a, b)
                 : law == PointFriction::coulomb ? answer_point<PointFriction::coulomb>(q, a, b)
                                                 : answer_point<PointFriction::fixed_direction>(q, a, b);
        },
        [&](Point& q, const float* a, const float* b) {
          points = larger(points, per_step * repair_mismatch_of(q, a, b));
          return answer_repair(q, a, b);
        });
    raise_to(&cell_.points_bits, points);
    float bodies = 0.0F, change = 0.0F, motion = 0.0F;
    bool finite = true;
    each_body_half([&](std::int32_t place, int half, const BodyRecords& records) {
      FloatQuad given{};
      this->add_pushes(records, half, given);
      const FloatQuad last = v_.m.given[2 * place + half], now = v_.m.now[2 * place + half];
      v_.m.given[2 * place + half] = given;
      const ScaledBody& body = v_.m.scaled[place];
      const float speed = half == 0 ? 1.0F : per_step;
      for (int c = 0; c < 3; ++c) {
        const float mass = c < 2 ? body.mass : body.inertia, scale = c < 2 ? body.speed : body.spin_speed;
        const float inverse = mass > 0.0F ? 1.0F / mass : 0.0F;
        bodies = larger(bodies, magnitude(given.part[c] * inverse - now.part[c]) * scale * speed);
        change = larger(change, magnitude(given.part[c] - last.part[c]) * inverse * scale * speed);
        motion = larger(motion, magnitude(now.part[c]) * scale * speed);
        finite = finite && is_finite(now.part[c]);
      }
    });
    raise_to(&cell_.bodies_bits, bodies);
    raise_to(&cell_.change_bits, change);
    raise_to(&cell_.motion_bits, motion);
    if (!finite) Atomics::add(&cell_.not_finite, 1);
    team_.sync();
    SplittingDifferences d{from_ordered_bits(cell_.points_bits), from_ordered_bits(cell_.bodies_bits),
                           from_ordered_bits(cell_.change_bits), from_ordered_bits(cell_.motion_bits)};
    if (cell_.not_finite > 0) d.points = from_ordered_bits(0x7f800000U);  // infinity
    return d;
  }

  /// Scales the impulses of unfinished iterations by best_share() if all of them together would create energy.
  GEM_DEVICE void keep_best_share() {
    // by body of the island; the scene's arrays have room for all islands
    double* const linear = s_.linear_energy + cell_.base;
    double* const quadratic = s_.quadratic_energy + cell_.base;
    each_of(team_, 0, v_.bodies, [&](std::int32_t i) {
      const std::int32_t body = entry_of(i).body;
      const BodyCell& b = s_.body[body];
      const SolvedMotion& m = s_.solved[body];
      const EnergyChange change =
          energy_change({m.part[0], m.part[1], m.part[4], 0.0, 0.0, 0.0}, b.velocity.x, b.velocity.y, b.spin,
                        1.0 / b.inverse_mass, b.inverse_inertia > 0.0 ? 1.0 / b.inverse_inertia : 0.0);
      linear[i] = change.linear;
      quadratic[i] = change.quadratic;
    });
    team_.sync();
    if (team_.rank() == 0) {
      EnergyChange sum{0.0, 0.0};
      for (std::int32_t i = 0; i < v_.bodies; ++i) {
        sum.linear += linear[i];
        sum.quadratic += quadratic[i];
      }
      cell_.share = best_share(sum);
    }
    team_.sync();
    const double share = cell_.share;
    if (share >= share_limit(s_.constants.point_friction, false)) return;
    each_of(team_, 0, v_.points, [&](std::int32_t k) {
      const std::int32_t i = v_.m.where[k].taken;
      PointImpulse<double> impulse = s_.points.impulse(i);
      impulse.normal *= share;
      impulse.tangential *= share;
      write_base(s_, i, s_.taken_point[i], s_.points.geometry(i), impulse);
    });
  }

  const PartCell& p_;
  DeviceIslandGradient<Team> gradient_;
  DeviceFactor<Team> factor_;
  FrontSolve<Team> fronts_;
  int halves_ = 1;  // 2: with the repair
  bool repaired_ = false;
};

}  // namespace gem
