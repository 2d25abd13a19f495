#include "bench/splitting/island_solver.h"

#include <algorithm>
#include <cmath>

#include "gem/base/choose.h"
#include "gem/engine/solver/coupled_visit.h"

namespace gem::bench {
namespace {

/// Stiffness over the compliance of a point at the start: chosen by hand in jams (bench/notebook.md, "Operator
/// splitting").
constexpr float first_stiffness = 20.0F;
/// The stiffness follows the errors first after so many iterations, then after twice as many, and so on. A stiffness
/// that keeps changing need not converge.
constexpr int first_balance = 20;
/// Smaller changes of the stiffness are not worth a factor; larger ones are made in steps. Chosen by hand.
constexpr float least_change = 1.5F, most_change = 5.0F;
constexpr float relaxation = 1.6F;
/// The error is estimated after so many iterations, and so often afterwards: it costs as much as half an iteration.
constexpr int first_estimate = 5, estimate_interval = 10;

/// The half rows of eight bodies, by component.
template <int half, class Row>
GEM_INLINE void load_motions(const std::vector<Row>& rows, const std::int32_t* place, FloatPack* motion) {
  const auto at = [&](int k) { return reinterpret_cast<const float*>(&rows[place[k]]) + 4 * half; };
  for (int k = 0; k < 4; ++k) motion[k] = side_by_side(at(k), at(k + 4));
  transpose_halves(motion);
}

/// Adds the pushes of eight points, given by component, to the half rows of their bodies, in the order of the points.
template <int half, class Row>
GEM_INLINE void add_pushes(std::vector<Row>& rows, const std::int32_t* place, FloatPack* push) {
  transpose_halves(push);
  for (int k = 0; k < float_lanes; ++k) {
    float* const to = reinterpret_cast<float*>(&rows[place[k]]) + 4 * half;
    FloatHalf part, sum;
    __builtin_memcpy(&part, reinterpret_cast<const float*>(&push[k % 4]) + 4 * (k / 4), sizeof part);
    __builtin_memcpy(&sum, to, sizeof sum);
    sum += part;
    __builtin_memcpy(to, &sum, sizeof sum);
  }
}

/// The Jacobian of eight points times the motions of their bodies.
GEM_INLINE FloatPack along(const FloatPack* of_a, const FloatPack* of_b, const FloatPack* a, const FloatPack* b) {
  return (of_a[0] * a[0] + of_a[1] * a[1] + of_a[2] * a[2]) + (of_b[0] * b[0] + of_b[1] * b[1] + of_b[2] * b[2]);
}

/// Pushes of eight points with normal part `n` and tangential part `t` on both bodies.
template <int half, class Block, class Row>
GEM_INLINE void push_bodies(const Block& q, std::vector<Row>& to, FloatPack n, FloatPack t) {
  FloatPack push[4];
  for (int c = 0; c < 3; ++c) push[c] = q.n_a[c] * n + q.t_a[c] * t;
  push[3] = FloatPack{};
  add_pushes<half>(to, q.a, push);
  for (int c = 0; c < 3; ++c) push[c] = q.n_b[c] * n + q.t_b[c] * t;
  push[3] = FloatPack{};
  add_pushes<half>(to, q.b, push);
}

/// What the points ask of the bodies: their impulses and their copies of the velocities.
template <bool repairs, class Block, class Row>
GEM_INLINE void push_wishes(const Block& q, std::vector<Row>& to) {
  push_bodies<0>(q, to, q.normal + q.stiff_n * (q.gap - q.excess), q.tangential + q.stiff_t * (q.slide - q.slip));
  if constexpr (repairs)
    push_bodies<1>(q, to, q.repair + q.stiff_n * (q.shift - q.repair_excess), q.stiff_t * q.shift_t);
}

}  // namespace

void IslandSolver::order_bodies(std::span<const IslandBody> bodies, std::span<const IslandPoint> points) {
  const auto n = static_cast<std::int32_t>(bodies.size());
  pairs_.clear();
  for (const IslandPoint& p : points)
    if (p.a != fixed && p.b != fixed) pairs_.emplace_back(std::min(p.a, p.b), std::max(p.a, p.b));
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  graph_.first.assign(n + 1, 0);
  for (const auto& [i, j] : pairs_) {
    ++graph_.first[i + 1];
    ++graph_.first[j + 1];
  }
  for (std::int32_t k = 0; k < n; ++k) graph_.first[k + 1] += graph_.first[k];
  graph_.neighbour.resize(graph_.first[n]);
  fill_.assign(graph_.first.begin(), graph_.first.end());
  for (const auto& [i, j] : pairs_) {
    graph_.neighbour[fill_[i]++] = j;
    graph_.neighbour[fill_[j]++] = i;
  }
  position_.resize(n);
  for (std::int32_t k = 0; k < n; ++k) position_[k] = bodies[k].position;
  order_list_.clear();
  order_.order(position_, graph_, order_list_);
  place_.resize(n);
  for (std::int32_t k = 0; k < n; ++k) place_[order_list_[k]] = k;
  for (auto& [i, j] : pairs_) {
    const std::int32_t p = place_[i], q = place_[j];
    i = std::min(p, q);
    j = std::max(p, q);
  }
  factor_.analyse(n, pairs_);
}

void IslandSolver::set_point(std::span<const IslandBody> bodies, const IslandPoint& p, Block& q, int lane) {
  const PointGeometry<double>& g = *p.geometry;
  q.a[lane] = p.a == fixed ? 0 : 1 + place_[p.a];
  q.b[lane] = p.b == fixed ? 0 : 1 + place_[p.b];
  double nn = 0.0, tt = 0.0;
  const auto set_side = [&](std::int32_t i, double sign, double lever_n, double lever_t, FloatPack* n, FloatPack* t) {
    if (i == fixed) return;
    const double mass = bodies[i].inverse_mass, inertia = bodies[i].inverse_inertia;
    const double by_mass = sign * std::sqrt(mass), by_inertia = sign * std::sqrt(inertia);
    n[0][lane] = static_cast<float>(by_mass * g.normal_x);
    n[1][lane] = static_cast<float>(by_mass * g.normal_y);
    n[2][lane] = static_cast<float>(by_inertia * lever_n);
    t[0][lane] = static_cast<float>(-by_mass * g.normal_y);
    t[1][lane] = static_cast<float>(by_mass * g.normal_x);
    t[2][lane] = static_cast<float>(by_inertia * lever_t);
    nn += mass + inertia * lever_n * lever_n;
    tt += mass + inertia * lever_t * lever_t;
  };
  set_side(p.a, -1.0, g.lever_a_n, g.lever_a_t, q.n_a, q.t_a);
  set_side(p.b, 1.0, g.lever_b_n, g.lever_b_t, q.n_b, q.t_b);
  q.inverse_nn[lane] = static_cast<float>(1.0 / nn);
  q.inverse_tt[lane] = static_cast<float>(1.0 / tt);
  q.friction[lane] = static_cast<float>(g.friction);
}

void IslandSolver::set_up(std::span<const IslandBody> bodies, std::span<const IslandPoint> points) {
  order_bodies(bodies, points);
  root_mass_.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k)
    root_mass_[place_[k]] = static_cast<float>(std::sqrt(bodies[k].inverse_mass));
  motion_.resize(bodies.size());
  base_push_.resize(bodies.size());
  for (std::vector<Row>* rows : {&unknown_, &sum_, &wrong_}) rows->assign(bodies.size() + 1, Row{});
  block_.assign((points.size() + float_lanes - 1) / float_lanes, Block{});
  repairs_ = false;
  for (std::size_t k = 0; k < points.size(); ++k) {
    set_point(bodies, points[k], block_[k / float_lanes], static_cast<int>(k % float_lanes));
    repairs_ = repairs_ || points[k].geometry->repair_target > 0.0 || points[k].impulse->repair > 0.0;
  }
}

void IslandSolver::move_by_base(std::span<const IslandBody> bodies, std::span<const IslandPoint> points) {
  std::fill(base_push_.begin(), base_push_.end(), Push<double>{});
  for (const IslandPoint& p : points) {
    const PointGeometry<double>& g = *p.geometry;
    if (p.a != fixed) add(base_push_[place_[p.a]], -1.0, push_of(g, *p.impulse, g.lever_a_n, g.lever_a_t));
    if (p.b != fixed) add(base_push_[place_[p.b]], 1.0, push_of(g, *p.impulse, g.lever_b_n, g.lever_b_t));
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const IslandBody& b = bodies[k];
    motion_[place_[k]] =
        moved_by(base_push_[place_[k]], b.velocity.x, b.velocity.y, b.spin, b.inverse_mass, b.inverse_inertia);
  }
}

/// Sets the bounds of the additions, and copies of the velocities that obey the law with the impulses of the base.
void IslandSolver::set_base(std::span<const IslandPoint> points) {
  const Motion<double> rest{};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const IslandPoint& p = points[k];
    Block& q = block_[k / float_lanes];
    const auto lane = static_cast<int>(k % float_lanes);
    PointFrame<float> frame;
    set_base_values(frame, *p.geometry, p.spare, *p.impulse, p.a == fixed ? rest : motion_[place_[p.a]],
                    p.b == fixed ? rest : motion_[place_[p.b]]);
    q.excess[lane] = frame.excess;
    q.slip[lane] = frame.slip;
    q.least[lane] = frame.least;
    q.most[lane] = frame.most;
    q.slack_left[lane] = frame.slack_left;
    q.slack_right[lane] = frame.slack_right;
    q.repair_excess[lane] = frame.repair_excess;
    q.repair_least[lane] = frame.repair_least;
    const double normal = p.impulse->normal, tangential = p.impulse->tangential;
    q.gap[lane] = normal > 0.0 ? 0.0F : larger(frame.excess, 0.0F);
    // at the bound of friction but for rounding
    const double spare = tangential > 0.0 ? p.spare.left : p.spare.right;
    const bool at_bound = magnitude(tangential) >= (1.0 - 1e-6) * (p.geometry->friction * normal + spare);
    const bool slides = normal > 0.0 ? at_bound && frame.slip * tangential < 0.0 : true;
    q.slide[lane] = slides ? frame.slip : 0.0F;
    q.shift[lane] = p.impulse->repair > 0.0 ? 0.0F : larger(frame.repair_excess, 0.0F);
  }
}

/// Sets R of all points and factors the equations.
void IslandSolver::stiffen(float stiffness) {
  factor_.reset();
  const FloatPack zero{}, one = zero + 1.0F;
  for (Block& q : block_) {
    q.stiff_n = stiffness * q.inverse_nn;
    q.stiff_t = stiffness * q.inverse_tt;
    q.soft_n = q.stiff_n > zero ? one / q.stiff_n : zero;
    q.soft_t = q.stiff_t > zero ? one / q.stiff_t : zero;
    for (int lane = 0; lane < float_lanes; ++lane) {
      const std::int32_t a = q.a[lane], b = q.b[lane];
      const auto add_block = [&](float* to, const FloatPack* n, const FloatPack* t, const FloatPack* m,
                                 const FloatPack* u) {
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c)
            to[3 * r + c] += q.stiff_n[lane] * n[r][lane] * m[c][lane] + q.stiff_t[lane] * t[r][lane] * u[c][lane];
      };
      if (a != 0) add_block(factor_.diagonal(a - 1), q.n_a, q.t_a, q.n_a, q.t_a);
      if (b != 0) add_block(factor_.diagonal(b - 1), q.n_b, q.t_b, q.n_b, q.t_b);
      if (a > b && b != 0) add_block(factor_.below(a - 1, b - 1), q.n_a, q.t_a, q.n_b, q.t_b);
      if (b > a && a != 0) add_block(factor_.below(b - 1, a - 1), q.n_b, q.t_b, q.n_a, q.t_a);
    }
  }
  factor_.factor();
}

template <bool repairs>
GEM_INLINE void IslandSolver::push_blocks() {
  std::fill(sum_.begin(), sum_.end(), Row{});
  for (const Block& q : block_) push_wishes<repairs>(q, sum_);
}

/// Visits all points with the motions that solve the equations, and sums what they ask of the bodies next.
template <PointFriction law, bool repairs>
GEM_INLINE void IslandSolver::visit_blocks() {
  constexpr float kept = 1.0F - relaxation;
  std::fill(sum_.begin(), sum_.end(), Row{});
  for (Block& q : block_) {
    FloatPack a[4], b[4];
    load_motions<0>(unknown_, q.a, a);
    load_motions<0>(unknown_, q.b, b);
    const FloatPack n = relaxation * (q.excess + along(q.n_a, q.n_b, a, b)) + kept * q.gap;
    const FloatPack t = relaxation * (q.slip + along(q.t_a, q.t_b, a, b)) + kept * q.slide;
    const FloatPack wanted_n = q.normal - q.stiff_n * n, wanted_t = q.tangential - q.stiff_t * t;
    q.normal = smaller(larger(wanted_n, q.least), q.most);
    q.gap = (q.normal - wanted_n) * q.soft_n;
    const FloatPack wider = q.friction * q.normal;
    if constexpr (law == PointFriction::coulomb)
      q.tangential = larger(smaller(wanted_t, q.slack_left + wider), -(q.slack_right + wider));
    else if constexpr (law == PointFriction::fixed_direction)
      q.tangential = q.slack_left + wider;
    q.slide = (q.tangential - wanted_t) * q.soft_t;
    if constexpr (repairs) {
      load_motions<1>(unknown_, q.a, a);
      load_motions<1>(unknown_, q.b, b);
      const FloatPack r = relaxation * (q.repair_excess + along(q.n_a, q.n_b, a, b)) + kept * q.shift;
      const FloatPack wanted = q.repair - q.stiff_n * r;
      q.repair = larger(wanted, q.repair_least);
      q.shift = (q.repair - wanted) * q.soft_n;
      q.shift_t = relaxation * along(q.t_a, q.t_b, a, b) + kept * q.shift_t;
    }
    push_wishes<repairs>(q, sum_);
  }
}

/// The largest difference between the velocities of points or bodies in the equations and those that the impulses
/// give. A repair counts as its speed over one time step.
template <bool repairs>
GEM_INLINE double IslandSolver::error_of_blocks(float per_step) {
  std::fill(wrong_.begin(), wrong_.end(), Row{});
  FloatPack of_points{};
  for (const Block& q : block_) {
    FloatPack a[4], b[4];
    load_motions<0>(unknown_, q.a, a);
    load_motions<0>(unknown_, q.b, b);
    const FloatPack n = q.excess + along(q.n_a, q.n_b, a, b) - q.gap, t = q.slip + along(q.t_a, q.t_b, a, b) - q.slide;
    of_points = larger(of_points, larger(magnitude(n), magnitude(t)));
    push_bodies<0>(q, wrong_, q.stiff_n * n, q.stiff_t * t);
    if constexpr (repairs) {
      load_motions<1>(unknown_, q.a, a);
      load_motions<1>(unknown_, q.b, b);
      const FloatPack r = q.repair_excess + along(q.n_a, q.n_b, a, b) - q.shift;
      const FloatPack s = along(q.t_a, q.t_b, a, b) - q.shift_t;
      of_points = larger(of_points, per_step * larger(magnitude(r), magnitude(s)));
      push_bodies<1>(q, wrong_, q.stiff_n * r, q.stiff_t * s);
    }
  }
  float worst = 0.0F, all = 0.0F;
  for (int lane = 0; lane < float_lanes; ++lane) all = larger(all, of_points[lane]);
  for (std::size_t k = 1; k < wrong_.size(); ++k) {
    const FloatPack of_body = magnitude(wrong_[k].lanes) * root_mass_[k - 1];
    worst = larger(worst, larger(of_body[0], of_body[1]));
    worst = larger(worst, per_step * larger(of_body[4], of_body[5]));
  }
  point_error_ = all;
  body_error_ = worst;
  return larger(worst, all);
}

GEM_CLONES void IslandSolver::push_velocities() { push_blocks<false>(); }
GEM_CLONES void IslandSolver::push_velocities_and_repairs() { push_blocks<true>(); }
GEM_CLONES double IslandSolver::error_of_velocities() { return error_of_blocks<false>(0.0F); }
GEM_CLONES double IslandSolver::error_of_velocities_and_repairs(float per_step) {
  return error_of_blocks<true>(per_step);
}
GEM_CLONES void IslandSolver::visit_frictionless() {
  repairs_ ? visit_blocks<PointFriction::none, true>() : visit_blocks<PointFriction::none, false>();
}
GEM_CLONES void IslandSolver::visit_coulomb() {
  repairs_ ? visit_blocks<PointFriction::coulomb, true>() : visit_blocks<PointFriction::coulomb, false>();
}
GEM_CLONES void IslandSolver::visit_fixed_direction() {
  repairs_ ? visit_blocks<PointFriction::fixed_direction, true>()
           : visit_blocks<PointFriction::fixed_direction, false>();
}

void IslandSolver::push_all() { repairs_ ? push_velocities_and_repairs() : push_velocities(); }

void IslandSolver::visit(PointFriction law) {
  if (law == PointFriction::none) visit_frictionless();
  if (law == PointFriction::coulomb) visit_coulomb();
  if (law == PointFriction::fixed_direction) visit_fixed_direction();
}

double IslandSolver::error(float per_step) {
  return repairs_ ? error_of_velocities_and_repairs(per_step) : error_of_velocities();
}

/// The factor of the stiffness that brings the errors of points and bodies closer. A row of bodies needs a high
/// stiffness: its points soon agree with their neighbours, while their errors add up along the row.
float IslandSolver::balance() const {
  constexpr float tiny = 1e-30F;
  const float change = std::sqrt(larger(point_error_, tiny) / larger(body_error_, tiny));
  return smaller(larger(change, 1.0F / most_change), most_change);
}

void IslandSolver::add_to_base(std::span<const IslandPoint> points, PointFriction law) const {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Block& q = block_[k / float_lanes];
    const auto lane = static_cast<int>(k % float_lanes);
    PointImpulse<double>& p = *points[k].impulse;
    p = with_additions(law, *points[k].geometry, points[k].spare, p,
                       {q.normal[lane], q.tangential[lane], q.repair[lane]}, q.least[lane], q.most[lane],
                       q.repair_least[lane]);
  }
}

IslandResult IslandSolver::solve(std::span<const IslandBody> bodies, std::span<const IslandPoint> points,
                                 const IslandControl& control) {
  set_up(bodies, points);
  move_by_base(bodies, points);
  set_base(points);
  const auto per_step = static_cast<float>(1.0 / control.dt);
  IslandResult result;
  float stiffness = first_stiffness;
  int next_estimate = first_estimate, next_balance = first_balance;
  stiffen(stiffness);
  push_all();
  for (;; ++result.iterations) {
    unknown_.swap(sum_);
    float* const unknowns = reinterpret_cast<float*>(&unknown_[1]);
    repairs_ ? factor_.solve_both(unknowns) : factor_.solve_first(unknowns);
    unknown_[0] = Row{};
    const bool at_limit = result.iterations >= control.iterations_maximum;
    if (at_limit || result.iterations == next_estimate) {
      result.error = error(per_step);
      if (at_limit || result.error <= control.tolerance) break;
      next_estimate = result.iterations - result.iterations % estimate_interval + estimate_interval;
      if (result.iterations >= next_balance) {
        next_balance *= 2;
        const float change = balance();
        if (change > least_change || change * least_change < 1.0F) stiffen(stiffness *= change);
      }
    }
    visit(control.friction);
  }
  add_to_base(points, control.friction);
  return result;
}

}  // namespace gem::bench
