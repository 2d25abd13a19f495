#include "gem/engine/solver/splitting/island_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gem/base/choose.h"

namespace gem {
namespace {

IslandSize size_of(std::span<const IslandBody> bodies, std::span<const IslandPoint> points) {
  const auto contacts =
      std::count_if(points.begin(), points.end(), [](const IslandPoint& p) { return p.first_of_contact; });
  return {static_cast<std::int32_t>(bodies.size()), static_cast<std::int32_t>(points.size()),
          static_cast<std::int32_t>(contacts)};
}

}  // namespace

void IslandSolver::find_pairs(std::span<const IslandPoint> points, std::int32_t bodies) {
  pairs_.clear();
  for (const IslandPoint& p : points)
    if (p.a != fixed && p.b != fixed) pairs_.emplace_back(std::min(p.a, p.b), std::max(p.a, p.b));
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  graph_.first.assign(bodies + 1, 0);
  for (const auto& [i, j] : pairs_) {
    ++graph_.first[i + 1];
    ++graph_.first[j + 1];
  }
  for (std::int32_t k = 0; k < bodies; ++k) graph_.first[k + 1] += graph_.first[k];
  graph_.neighbour.resize(graph_.first[bodies]);
  fill_.assign(graph_.first.begin(), graph_.first.end());
  for (const auto& [i, j] : pairs_) {
    graph_.neighbour[fill_[i]++] = j;
    graph_.neighbour[fill_[j]++] = i;
  }
}

void IslandSolver::order_bodies(std::span<const IslandBody> bodies, std::span<const IslandPoint> points) {
  const auto n = static_cast<std::int32_t>(bodies.size());
  find_pairs(points, n);
  position_.resize(n);
  for (std::int32_t k = 0; k < n; ++k) position_[k] = bodies[k].position;
  dissection_.order(position_, graph_, tree_);
  place_.resize(n);
  for (std::int32_t k = 0; k < n; ++k) place_[tree_.order[k]] = k;
  for (auto& [i, j] : pairs_) {
    const std::int32_t p = place_[i], q = place_[j];
    i = std::min(p, q);
    j = std::max(p, q);
  }
  std::sort(pairs_.begin(), pairs_.end());
  factor_.analyse(tree_, pairs_, crew_->parts());
}

void IslandSolver::set_points(std::span<const IslandBody> bodies, std::span<const IslandPoint> points) {
  blocks_.resize(static_cast<std::int32_t>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const IslandPoint& p = points[k];
    std::int32_t pair = 0;
    if (p.a != fixed && p.b != fixed) {
      const std::pair<std::int32_t, std::int32_t> wanted = std::minmax(place_[p.a], place_[p.b]);
      pair = static_cast<std::int32_t>(std::lower_bound(pairs_.begin(), pairs_.end(), wanted) - pairs_.begin());
    }
    blocks_.set_point(static_cast<std::int32_t>(k), *p.geometry, p.a == fixed ? 0 : 1 + place_[p.a],
                      p.b == fixed ? 0 : 1 + place_[p.b], p.a == fixed ? InverseMass{} : bodies[p.a].inverse,
                      p.b == fixed ? InverseMass{} : bodies[p.b].inverse, pair);
  }
  scale_.resize(bodies.size());
  mass_.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const ScaledBody b = scaled_body(bodies[k].inverse);
    scale_[place_[k]].lanes = FloatPack{b.speed, b.speed, b.spin_speed, 0.0F, b.speed, b.speed, b.spin_speed, 0.0F};
    mass_[place_[k]].lanes = FloatPack{b.mass, b.mass, b.inertia, 0.0F, b.mass, b.mass, b.inertia, 0.0F};
  }
}

/// Sets the motions of the bodies after the impulses of the base.
void IslandSolver::move_by_base(std::span<const IslandBody> bodies, std::span<const IslandPoint> points) {
  push_.assign(bodies.size(), Push<double>{});
  for (const IslandPoint& p : points) {
    const PointGeometry<double>& g = *p.geometry;
    if (p.b != fixed) add(push_[p.b], 1.0, push_of(g, *p.impulse, g.lever_b_n, g.lever_b_t));
    if (p.a != fixed) add(push_[p.a], -1.0, push_of(g, *p.impulse, g.lever_a_n, g.lever_a_t));
  }
  motion_.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const IslandBody& b = bodies[k];
    motion_[k] = moved_by(push_[k], b.velocity.x, b.velocity.y, b.spin, b.inverse.mass, b.inverse.inertia);
  }
}

/// Estimate of the error of the impulses of the base [m/s].
double IslandSolver::error_of_base(const IslandControl& control, std::span<const IslandBody> bodies,
                                   std::span<const IslandPoint> points) const {
  const auto per_step = static_cast<float>(1.0 / control.dt);
  std::uint64_t asked = 0;
  for (const IslandPoint& p : points) {
    const InverseMass of_a = p.a == fixed ? InverseMass{} : bodies[p.a].inverse;
    const InverseMass of_b = p.b == fixed ? InverseMass{} : bodies[p.b].inverse;
    const float speed = speed_asked_at_base(control.friction, *p.geometry, inertia_of(*p.geometry, of_a, of_b), p.spare,
                                            *p.impulse, p.a == fixed ? Motion<double>{} : motion_[p.a],
                                            p.b == fixed ? Motion<double>{} : motion_[p.b], per_step);
    asked += RoundControl::asked(control.tolerance, speed);
    if (asked > RoundControl::asked_units) break;
  }
  return RoundControl::error_of_base(control.tolerance, asked);
}

/// Begins a round from the impulses of the base.
void IslandSolver::set_base(PointFriction law, std::span<const IslandPoint> points) {
  const Motion<double> rest{};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const IslandPoint& p = points[k];
    blocks_.set_base(law, static_cast<std::int32_t>(k), *p.geometry, p.spare, *p.impulse,
                     p.a == fixed ? rest : motion_[p.a], p.b == fixed ? rest : motion_[p.b]);
  }
}

/// Scales the impulses of unfinished iterations by best_share() if all of them together would create energy.
void IslandSolver::keep_best_share(PointFriction law, std::span<const IslandBody> bodies,
                                   std::span<const IslandPoint> points) const {
  EnergyChange sum{0.0, 0.0};
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const IslandBody& b = bodies[k];
    const EnergyChange change = energy_change(motion_[k], b.velocity.x, b.velocity.y, b.spin, 1.0 / b.inverse.mass,
                                              b.inverse.inertia > 0.0 ? 1.0 / b.inverse.inertia : 0.0);
    sum.linear += change.linear;
    sum.quadratic += change.quadratic;
  }
  const double share = best_share(sum);
  if (share >= share_limit(law, false)) return;
  for (const IslandPoint& p : points) {
    p.impulse->normal *= share;
    p.impulse->tangential *= share;
  }
}

void IslandSolver::stiffen(const RoundControl& round) {
  factor_.reset();
  for (std::size_t k = 0; k < mass_.size(); ++k)
    for (int c = 0; c < 3; ++c) factor_.diagonal(static_cast<std::int32_t>(k))[4 * c] = mass_[k].lanes[c];
  blocks_.stiffen(round.stiffness(), round.raised(), factor_);
  factor_.factor(*crew_);
}

/// The right side without the points: minus the momentum of the motions.
GEM_CLONES void IslandSolver::begin() {
  sum_[0] = BodyRow{};
  for (std::size_t k = 1; k < now_.size(); ++k) sum_[k].lanes = -(mass_[k - 1].lanes * now_[k].lanes);
}

/// Moves the bodies by the solution of the equations.
GEM_CLONES void IslandSolver::step() {
  float* const unknowns = reinterpret_cast<float*>(&sum_[1]);
  blocks_.repairs() ? factor_.solve_both(unknowns, *crew_) : factor_.solve_first(unknowns, *crew_);
  for (std::size_t k = 1; k < now_.size(); ++k) now_[k].lanes += sum_[k].lanes;
}

GEM_CLONES SplittingDifferences IslandSolver::compare(const IslandControl& control) {
  const auto per_step = static_cast<float>(1.0 / control.dt);
  given_.swap(last_given_);
  std::fill(given_.begin(), given_.end(), BodyRow{});
  blocks_.answer(control.friction, now_, given_);
  SplittingDifferences d;
  d.points = blocks_.mismatch(now_, per_step);
  const FloatPack speed{1.0F, 1.0F, 1.0F, 1.0F, per_step, per_step, per_step, per_step};
  FloatPack bodies{}, change{}, motion{};
  FloatMask infinite{};
  for (std::size_t k = 1; k < now_.size(); ++k) {
    const FloatPack scale = scale_[k - 1].lanes, mass = mass_[k - 1].lanes;
    // lanes without a mass are not a number in a quotient, and stay out of it
    const FloatPack inverse = mass > FloatPack{} ? (FloatPack{} + 1.0F) / mass : FloatPack{};
    bodies = larger(bodies, magnitude(given_[k].lanes * inverse - now_[k].lanes) * scale);
    change = larger(change, magnitude(given_[k].lanes - last_given_[k].lanes) * inverse * scale);
    motion = larger(motion, magnitude(now_[k].lanes) * scale);
    infinite |= ~(magnitude(now_[k].lanes) <= FloatPack{} + std::numeric_limits<float>::max());
  }
  // by reference: a pack passed by value reads as another in a build that does not inline, since the clones for AVX2
  // hand it over in another register
  const auto largest = [&speed](const FloatPack& lanes) {
    float all = 0.0F;
    for (int lane = 0; lane < float_lanes; ++lane) all = larger(all, lanes[lane] * speed[lane]);
    return all;
  };
  d.bodies = largest(bodies);
  d.change = largest(change);
  d.motion = largest(motion);
  // the larger of two numbers forgets one that is not a number
  for (int lane = 0; lane < float_lanes; ++lane)
    if (infinite[lane] != 0) d.points = std::numeric_limits<float>::infinity();
  return d;
}

/// Changes the stiffness after an iteration. Returns whether it changed.
bool IslandSolver::change_stiffness(RoundControl& round) {
  const RoundControl::Change change = round.change();
  if (change == RoundControl::Change::none) return false;
  if (change == RoundControl::Change::raise && !blocks_.raise()) return false;
  round.changed(change);
  stiffen(round);
  return true;
}

/// Iterates from the base until the round ends.
void IslandSolver::iterate_round(RoundKind kind, const IslandControl& control, IslandResult& result) {
  for (std::vector<BodyRow>* rows : {&now_, &sum_, &given_, &last_given_}) rows->assign(place_.size() + 1, BodyRow{});
  RoundControl round(kind, control.tolerance, control.iterations_maximum, result.iterations);
  stiffen(round);
  blocks_.push(now_, sum_);
  for (;;) {
    round.begin_iteration();
    step();
    const bool judged = round.judged();
    if (judged && round.ends(compare(control))) break;
    begin();
    blocks_.visit(control.friction, now_, sum_, *crew_);
    if (judged) blocks_.watch(now_, round.watch_tolerance());
    if (!change_stiffness(round)) continue;
    begin();
    blocks_.push(now_, sum_);
  }
  result.error = round.error();
  result.iterations += round.iteration();
}

/// Iterates by the gradient from the base. `keeps`: whether what was reached is the next base if that did not meet the
/// tolerance. Returns whether it did; then the result is set.
bool IslandSolver::ends_by_gradient(std::span<const IslandBody> bodies, std::span<const IslandPoint> points,
                                    const IslandControl& control, bool keeps, IslandResult& result) {
  if (gradient_.solve(bodies, points, motion_, control, keeps, result)) return true;
  if (keeps) move_by_base(bodies, points);
  return false;
}

GradientPlan IslandSolver::plan_of(std::span<const IslandBody> bodies, std::int64_t iterations_maximum) const {
  float mass = 0.0F, inverse_mass = 0.0F;
  for (const IslandBody& b : bodies) {
    mass = larger(mass, static_cast<float>(1.0 / b.inverse.mass));
    inverse_mass = larger(inverse_mass, static_cast<float>(b.inverse.mass));
  }
  return gradient_plan(size_, mass, inverse_mass, iterations_maximum);
}

IslandResult IslandSolver::solve(std::span<const IslandBody> bodies, std::span<const IslandPoint> points,
                                 const IslandControl& of_case, IslandCrew& crew) {
  crew_ = &crew;
  size_ = size_of(bodies, points);
  IslandControl control = of_case;
  control.tolerance = size_.tolerance(of_case.tolerance);
  control.jam = size_.is_jam();
  IslandResult result;
  move_by_base(bodies, points);
  result.error = error_of_base(control, bodies, points);
  if (result.error <= control.tolerance) return result;
  const GradientPlan plan = control.gradient_first ? plan_of(bodies, control.iterations_maximum) : GradientPlan{};
  if (plan.first && ends_by_gradient(bodies, points, control, plan.joins_rounds, result)) return result;
  order_bodies(bodies, points);
  set_points(bodies, points);
  const RoundKind usual = RoundControl::usual_kind(plan.joins_rounds);
  RoundKind kind = RoundControl::first_kind(usual, size_.is_chain(), control.iterations_maximum);
  do {
    set_base(control.friction, points);
    iterate_round(kind, control, result);
    const bool failed = kind == RoundKind::attempt && !(result.error <= control.tolerance);
    kind = usual;
    if (failed) continue;
    for (std::size_t k = 0; k < points.size(); ++k)
      blocks_.add_to(control.friction, static_cast<std::int32_t>(k), *points[k].geometry, points[k].spare,
                     *points[k].impulse);
    move_by_base(bodies, points);
    const bool missed = result.error > control.tolerance;
    if (plan.joins_rounds && missed && ends_by_gradient(bodies, points, control, true, result)) return result;
  } while (RoundControl::goes_on(control.tolerance, control.iterations_maximum, result.iterations, result.error));
  if (result.error > control.tolerance) {
    keep_best_share(control.friction, bodies, points);
    result.iterations = control.iterations_maximum;  // too few were left for another round
  }
  return result;
}

}  // namespace gem
