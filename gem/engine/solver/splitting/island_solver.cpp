#include "gem/engine/solver/splitting/island_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gem/base/choose.h"

namespace gem {
namespace {

/// A round begins with a high stiffness (over the compliance of a point), which soon brings the points together. It
/// ends with a low one, which brings the impulses and the velocities of the bodies together: after `fall`, for the last
/// two intervals; points that were made stiffer are not any more then, since the velocities of light bodies are the
/// last to settle. These numbers and those below were chosen in jams (bench/notebook.md, "Operator splitting").
constexpr float first_stiffness = 20.0F, fall = 0.1F;
/// The stiffness may change after so many iterations. Before it falls, points whose difference persists become stiffer.
constexpr std::int64_t change_interval = 16;
/// A round that does not reach the tolerance has so many iterations, fewer at the limit of all. It is not begun if less
/// than the shorter length is left.
constexpr std::int64_t longest_round = 96, shortest_round = 48;
/// After so many iterations the stiffness stays at one value, since rounds that repeat its course may repeat their
/// errors.
constexpr std::int64_t scheduled_iterations = 4 * longest_round;
constexpr float steady_stiffness = 2.0F;
/// Motions within a round are good to `single_precision` of themselves. A round ends when its error has fallen by
/// `round_gain`, which leaves a margin.
constexpr double round_gain = 1e-4, single_precision = 1e-6;
/// The error is estimated after so many iterations of a round, after twice as many, and then every time so many have
/// passed.
constexpr std::int64_t first_estimate = 4, estimate_interval = 8;

/// What is still missing from a sequence that moved by `change` since the last estimate and by `last_change` before
/// that, if it goes on by the same ratio. Without a last change (zero) the slowest ratio is taken.
double still_missing(double change, double last_change) {
  constexpr double slowest = 0.9;
  const double ratio = last_change > 0.0 ? smaller(change / last_change, slowest) : slowest;
  return change * ratio / (1.0 - ratio);
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
  factor_.analyse(tree_, pairs_);
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
    const InverseMass inverse = bodies[k].inverse;
    const BodyScale scale = scale_of(inverse);
    const bool turns = inverse.inertia > 0.0;
    const auto x = static_cast<float>(scale.mass);
    const auto m = static_cast<float>(scale.mass * scale.mass / inverse.mass);
    const auto turn = turns ? static_cast<float>(std::sqrt(inverse.mass / inverse.inertia) * scale.inertia) : 0.0F;
    const auto i = turns ? static_cast<float>(scale.inertia * scale.inertia / inverse.inertia) : 1.0F;
    scale_[place_[k]].lanes = FloatPack{x, x, turn, 0.0F, x, x, turn, 0.0F};
    mass_[place_[k]].lanes = FloatPack{m, m, i, 0.0F, m, m, i, 0.0F};
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

void IslandSolver::stiffen() {
  factor_.reset();
  for (std::size_t k = 0; k < mass_.size(); ++k)
    for (int c = 0; c < 3; ++c) factor_.diagonal(static_cast<std::int32_t>(k))[4 * c] = mass_[k].lanes[c];
  blocks_.stiffen(stiffness_, stiffness_ >= first_stiffness, factor_);
  factor_.factor();
}

/// The right side without the points: minus the momentum of the motions.
GEM_CLONES void IslandSolver::begin() {
  sum_[0] = BodyRow{};
  for (std::size_t k = 1; k < now_.size(); ++k) sum_[k].lanes = -(mass_[k - 1].lanes * now_[k].lanes);
}

/// Moves the bodies by the solution of the equations.
GEM_CLONES void IslandSolver::step() {
  float* const unknowns = reinterpret_cast<float*>(&sum_[1]);
  blocks_.repairs() ? factor_.solve_both(unknowns) : factor_.solve_first(unknowns);
  for (std::size_t k = 1; k < now_.size(); ++k) now_[k].lanes += sum_[k].lanes;
}

GEM_CLONES IslandSolver::Differences IslandSolver::compare(const IslandControl& control) {
  const auto per_step = static_cast<float>(1.0 / control.dt);
  given_.swap(last_given_);
  std::fill(given_.begin(), given_.end(), BodyRow{});
  blocks_.answer(control.friction, now_, given_);
  Differences d;
  d.points = blocks_.mismatch(now_, per_step);
  const FloatPack speed{1.0F, 1.0F, 1.0F, 1.0F, per_step, per_step, per_step, per_step};
  FloatPack bodies{}, change{}, motion{}, total{};
  for (std::size_t k = 1; k < now_.size(); ++k) {
    const FloatPack scale = scale_[k - 1].lanes, mass = mass_[k - 1].lanes;
    // lanes without a mass are not a number in a quotient, and stay out of it
    const FloatPack inverse = mass > FloatPack{} ? (FloatPack{} + 1.0F) / mass : FloatPack{};
    bodies = larger(bodies, magnitude(given_[k].lanes * inverse - now_[k].lanes) * scale);
    change = larger(change, magnitude(given_[k].lanes - last_given_[k].lanes) * inverse * scale);
    motion = larger(motion, magnitude(now_[k].lanes) * scale);
    total += magnitude(now_[k].lanes);
  }
  const auto largest = [&speed](FloatPack lanes) {
    lanes *= speed;
    float all = 0.0F;
    for (int lane = 0; lane < float_lanes; ++lane) all = larger(all, lanes[lane]);
    return all;
  };
  d.bodies = largest(bodies);
  d.change = largest(change);
  d.motion = largest(motion);
  // the larger of two numbers forgets one that is not a number; their sum does not
  float all = 0.0F;
  for (int lane = 0; lane < float_lanes; ++lane) all += total[lane];
  if (!(all < std::numeric_limits<float>::infinity())) d.points = std::numeric_limits<float>::infinity();
  return d;
}

/// Changes the stiffness where `left` iterations of the round are left. Returns whether it changed.
bool IslandSolver::change_stiffness(std::int64_t left) {
  if (left > 2 * change_interval) {
    if (!blocks_.raise()) return false;
  } else {
    stiffness_ *= fall;
  }
  stiffen();
  return true;
}

/// Iterates from the base until the error is below the tolerance, the round has gained enough, or it is long enough.
void IslandSolver::iterate_round(const IslandControl& control, IslandResult& result) {
  for (std::vector<BodyRow>* rows : {&now_, &sum_, &given_, &last_given_}) rows->assign(place_.size() + 1, BodyRow{});
  const std::int64_t last = std::min(longest_round, control.iterations_maximum - result.iterations);
  std::int64_t next_estimate = first_estimate;
  double last_change = 0.0, first_error = 0.0;
  const bool scheduled = result.iterations < scheduled_iterations;
  stiffness_ = scheduled ? first_stiffness : steady_stiffness;
  stiffen();
  blocks_.push(now_, sum_);
  for (std::int64_t iteration = 1;; ++iteration) {
    step();
    const bool judged = iteration == next_estimate || iteration == last;
    if (judged) {
      if (iteration < next_estimate) last_change = 0.0;  // fewer iterations than the last change had
      const Differences d = compare(control);
      result.error = larger(static_cast<double>(larger(d.points, d.bodies)), still_missing(d.change, last_change));
      result.error = larger(result.error, single_precision * static_cast<double>(d.motion));
      if (first_error == 0.0) first_error = result.error;
      last_change = d.change;
      next_estimate += next_estimate < estimate_interval ? next_estimate : estimate_interval;
      if (iteration == last || result.error <= control.tolerance || result.error <= round_gain * first_error) {
        result.iterations += iteration;
        return;
      }
    }
    begin();
    blocks_.visit(control.friction, now_, sum_);
    if (judged) blocks_.watch(now_, static_cast<float>(0.25 * control.tolerance));
    if (!scheduled || (last - iteration) % change_interval != 0 || !change_stiffness(last - iteration)) continue;
    last_change = 0.0;
    begin();
    blocks_.push(now_, sum_);
  }
}

IslandResult IslandSolver::solve(std::span<const IslandBody> bodies, std::span<const IslandPoint> points,
                                 const IslandControl& control) {
  order_bodies(bodies, points);
  set_points(bodies, points);
  move_by_base(bodies, points);
  IslandResult result;
  do {
    set_base(control.friction, points);
    iterate_round(control, result);
    for (std::size_t k = 0; k < points.size(); ++k)
      blocks_.add_to(control.friction, static_cast<std::int32_t>(k), *points[k].geometry, points[k].spare,
                     *points[k].impulse);
    move_by_base(bodies, points);
  } while (control.iterations_maximum - result.iterations >= shortest_round && result.error > control.tolerance);
  if (result.error > control.tolerance) {
    keep_best_share(control.friction, bodies, points);
    result.iterations = control.iterations_maximum;  // too few were left for another round
  }
  return result;
}

}  // namespace gem
