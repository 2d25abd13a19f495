#include "gem/engine/solver/splitting/island_solver.h"

#include <algorithm>
#include <cmath>

#include "gem/base/choose.h"

namespace gem {
namespace {

/// Stiffness over the compliance of a point at the start. It falls later: a high stiffness soon brings the points
/// together, a low one brings the impulses and the velocities of the bodies together. Chosen in jams
/// (bench/notebook.md, "Operator splitting").
constexpr float first_stiffness = 20.0F, fall = 0.1F;
/// Points whose difference persists become stiffer every so many iterations, as long as the stiffness is high. It falls
/// in the rounds after that; later still it follows the errors, after twice as many iterations every time. A stiffness
/// that keeps changing need not converge.
constexpr std::int64_t change_interval = 16, raises = 2, falls = 2;
/// Smaller changes of the stiffness are not worth a factor; larger ones are made in steps. Chosen by hand.
constexpr float least_change = 1.5F, most_change = 5.0F;
/// The error is estimated after so many iterations, after twice as many, and then every time so many have passed.
constexpr std::int64_t first_estimate = 4, estimate_interval = 8;

/// The factor of the stiffness that brings both errors closer. A row of bodies needs a high stiffness: its points soon
/// agree with their neighbours, while their errors add up along the row.
float balance(float of_points, float of_bodies) {
  constexpr float tiny = 1e-30F;
  const float change = std::sqrt(larger(of_points, tiny) / larger(of_bodies, tiny));
  return smaller(larger(change, 1.0F / most_change), most_change);
}

/// What is still missing from a sequence that moved by `change` since the last estimate and by `last_change` before
/// that, if it goes on by the same ratio.
double still_missing(double change, double last_change) {
  constexpr double slowest = 0.95;
  const double ratio = last_change > 0.0 ? smaller(change / last_change, slowest) : 0.0;
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
  root_mass_.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k)
    root_mass_[place_[k]] = static_cast<float>(std::sqrt(bodies[k].inverse.mass));
}

void IslandSolver::set_base(std::span<const IslandBody> bodies, std::span<const IslandPoint> points) {
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
  const Motion<double> rest{};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const IslandPoint& p = points[k];
    blocks_.set_base(static_cast<std::int32_t>(k), *p.geometry, *p.impulse, p.a == fixed ? rest : motion_[p.a],
                     p.b == fixed ? rest : motion_[p.b]);
  }
}

void IslandSolver::stiffen() {
  factor_.reset();
  blocks_.stiffen(stiffness_, factor_);
  factor_.factor();
}

/// The right side without the points: minus the motions.
GEM_CLONES void IslandSolver::begin() {
  sum_[0] = BodyRow{};
  for (std::size_t k = 1; k < now_.size(); ++k) sum_[k].lanes = -now_[k].lanes;
}

/// Moves the bodies by the solution of the equations.
GEM_CLONES void IslandSolver::step() {
  float* const unknowns = reinterpret_cast<float*>(&sum_[1]);
  blocks_.repairs() ? factor_.solve_both(unknowns) : factor_.solve_first(unknowns);
  for (std::size_t k = 1; k < now_.size(); ++k) now_[k].lanes += sum_[k].lanes;
}

GEM_CLONES IslandSolver::Differences IslandSolver::compare(PointFriction law, float per_step) {
  given_.swap(last_given_);
  std::fill(given_.begin(), given_.end(), BodyRow{});
  blocks_.answer(law, now_, given_);
  Differences d;
  d.points = blocks_.mismatch(now_, per_step);
  const FloatPack one{1.0F, 1.0F, 1.0F, 1.0F, per_step, per_step, per_step, per_step};
  FloatPack bodies{}, change{};
  for (std::size_t k = 1; k < now_.size(); ++k) {
    bodies = larger(bodies, magnitude(given_[k].lanes - now_[k].lanes) * root_mass_[k - 1]);
    change = larger(change, magnitude(given_[k].lanes - last_given_[k].lanes) * root_mass_[k - 1]);
  }
  bodies *= one;
  change *= one;
  for (int lane = 0; lane < float_lanes; ++lane) {
    d.bodies = larger(d.bodies, bodies[lane]);
    d.change = larger(d.change, change[lane]);
  }
  return d;
}

/// Changes the stiffness at the end of an interval of iterations. Returns whether it changed.
bool IslandSolver::change_stiffness(std::int64_t interval, const Differences& d) {
  float change = 1.0F;
  if (interval <= raises) {
    blocks_.raise();
  } else {
    change = interval <= raises + falls ? fall : balance(d.points, d.bodies);
    if (change <= least_change && change * least_change >= 1.0F) return false;
  }
  stiffness_ *= change;
  return true;
}

IslandResult IslandSolver::solve(std::span<const IslandBody> bodies, std::span<const IslandPoint> points,
                                 const IslandControl& control) {
  order_bodies(bodies, points);
  set_points(bodies, points);
  set_base(bodies, points);
  for (std::vector<BodyRow>* rows : {&now_, &sum_, &given_, &last_given_}) rows->assign(bodies.size() + 1, BodyRow{});
  const auto per_step = static_cast<float>(1.0 / control.dt);
  const auto watched = static_cast<float>(0.25 * control.tolerance);
  stiffness_ = first_stiffness;
  double last_change = 0.0;
  std::int64_t next_estimate = first_estimate, interval = 1;
  IslandResult result;
  stiffen();
  blocks_.push(now_, sum_);
  for (;;) {
    step();
    const bool at_limit = ++result.iterations >= control.iterations_maximum;
    const bool judged = at_limit || result.iterations >= next_estimate;
    Differences d;
    if (judged) {
      d = compare(control.friction, per_step);
      result.error = larger(static_cast<double>(larger(d.points, d.bodies)), still_missing(d.change, last_change));
      if (at_limit || result.error <= control.tolerance) break;
    }
    begin();
    blocks_.visit(control.friction, now_, sum_);
    if (!judged) continue;
    last_change = d.change;
    next_estimate += next_estimate < estimate_interval ? next_estimate : estimate_interval;
    if (interval <= raises) blocks_.watch(now_, watched);
    if (result.iterations < interval * change_interval) continue;
    const bool changed = change_stiffness(interval, d);
    interval = interval <= raises + falls ? interval + 1 : 2 * interval;
    if (!changed) continue;
    stiffen();
    begin();
    blocks_.push(now_, sum_);
  }
  for (std::size_t k = 0; k < points.size(); ++k)
    blocks_.add_to(control.friction, static_cast<std::int32_t>(k), *points[k].geometry, *points[k].impulse);
  return result;
}

}  // namespace gem
