// Algorithm:
//   points that moving bodies join make a group
//   of a group: J has a row for each unknown impulse and three columns (x, y, spin) for each body: what the impulse of
//   size 1 gives to the momenta, and what the velocities make of u; W has the inverse masses
//   K = J W H^T,  b = J v - target      H is J but for fixed_direction, whose impulse has its friction with it
#include "gem/engine/reference/contact_problem.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "gem/engine/reference/bounded_problem.h"

namespace gem {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
using Indices = std::vector<std::size_t>;

bool moves(const ProblemBody& body) { return body.mass.inverse_mass > 0.0 || body.mass.inverse_inertia > 0.0; }

/// Points by group, each ascending.
std::vector<Indices> groups_of(const std::vector<ProblemPoint>& points, const std::vector<ProblemBody>& bodies) {
  std::vector<std::int32_t> parent(bodies.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root_of = [&](std::int32_t i) {
    while (parent[i] != i) i = parent[i];
    return i;
  };
  for (const ProblemPoint& point : points)
    if (moves(bodies[point.a]) && moves(bodies[point.b])) parent[root_of(point.b)] = root_of(point.a);
  std::map<std::int32_t, Indices> group;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::int32_t mover = moves(bodies[points[i].a]) ? points[i].a : points[i].b;
    group[root_of(mover)].push_back(i);
  }
  std::vector<Indices> groups;
  for (const auto& [root, members] : group) groups.push_back(members);
  return groups;
}

/// Velocity of B against A at a point before the impulses [m/s].
Vec2 velocity_before(const ProblemPoint& p, const std::vector<ProblemBody>& bodies) {
  const ProblemBody &a = bodies[p.a], &b = bodies[p.b];
  return b.velocity + cross(b.spin, p.arm_b) - a.velocity - cross(a.spin, p.arm_a);
}

/// P_t / P_n of the law fixed_direction; none where nothing slips or where it would jam the corner (impact.h).
double fixed_ratio(const ProblemPoint& p, const std::vector<ProblemBody>& bodies) {
  const double slip = dot(velocity_before(p, bodies), turned_left(p.normal));
  if (slip == 0.0) return 0.0;
  const double ratio = slip > 0.0 ? -p.friction : p.friction;
  const ContactCompliance k = contact_compliance(bodies[p.a].mass, p.arm_a, bodies[p.b].mass, p.arm_b, p.normal);
  return k.nn + ratio * k.nt > 0.0 ? ratio : 0.0;
}

/// The unknowns of one group and their matrices.
class Group {
 public:
  Group(const Indices& members, const std::vector<ProblemPoint>& points, const std::vector<ProblemBody>& bodies,
        FrictionLaw law)
      : members_(members), points_(points), bodies_(bodies) {
    for (const std::size_t i : members) add_point(points[i], law);
  }

  BoundedProblem problem() const;
  /// Enters the impulses that the unknowns stand for.
  void read(const Eigen::VectorXd& x, std::vector<ContactImpulse>& impulse) const;

 private:
  int unknowns() const { return static_cast<int>(target_.size()); }
  void add_point(const ProblemPoint& p, FrictionLaw law);
  /// One more unknown: u along `measured`, an impulse along `given`.
  void add_unknown(const ProblemPoint& p, Vec2 measured, Vec2 given, double target, double limit, int normal);
  void add_row(Triplets& rows, const ProblemPoint& p, Vec2 direction);
  int column_of(std::int32_t body);

  const Indices& members_;
  const std::vector<ProblemPoint>& points_;
  const std::vector<ProblemBody>& bodies_;
  std::map<std::int32_t, int> column_;  // first of a body's three
  Triplets measured_, given_;           // J, H
  std::vector<double> target_, limit_;
  std::vector<int> normal_;      // see BoundedProblem
  std::vector<int> unknown_of_;  // of each member: the unknown of its normal impulse
  std::vector<double> ratio_;    // of each member: P_t / P_n where the law fixes it
};

int Group::column_of(std::int32_t body) {
  return column_.try_emplace(body, 3 * static_cast<int>(column_.size())).first->second;
}

void Group::add_row(Triplets& rows, const ProblemPoint& p, Vec2 direction) {
  const int row = unknowns(), a = column_of(p.a), b = column_of(p.b);
  rows.emplace_back(row, b, direction.x);
  rows.emplace_back(row, b + 1, direction.y);
  rows.emplace_back(row, b + 2, cross(p.arm_b, direction));
  rows.emplace_back(row, a, -direction.x);
  rows.emplace_back(row, a + 1, -direction.y);
  rows.emplace_back(row, a + 2, -cross(p.arm_a, direction));
}

void Group::add_unknown(const ProblemPoint& p, Vec2 measured, Vec2 given, double target, double limit, int normal) {
  add_row(measured_, p, measured);
  add_row(given_, p, given);
  target_.push_back(target);
  limit_.push_back(limit);
  normal_.push_back(normal);
}

void Group::add_point(const ProblemPoint& p, FrictionLaw law) {
  const Vec2 tangent = turned_left(p.normal);
  const bool rough = p.friction > 0.0;
  const double ratio = rough && law == FrictionLaw::fixed_direction ? fixed_ratio(p, bodies_) : 0.0;
  const int unknown = unknowns();
  unknown_of_.push_back(unknown);
  ratio_.push_back(ratio);
  add_unknown(p, p.normal, p.normal + ratio * tangent, p.target, p.cap, BoundedProblem::none);
  if (rough && law == FrictionLaw::one_step) add_unknown(p, tangent, tangent, 0.0, p.friction, unknown);
}

BoundedProblem Group::problem() const {
  const int columns = 3 * static_cast<int>(column_.size());
  Eigen::SparseMatrix<double, Eigen::RowMajor> j(unknowns(), columns), h(unknowns(), columns);
  j.setFromTriplets(measured_.begin(), measured_.end());
  h.setFromTriplets(given_.begin(), given_.end());
  Eigen::VectorXd inverse_mass(columns), velocity(columns);
  for (const auto& [body, column] : column_) {
    const ProblemBody& b = bodies_[body];
    inverse_mass.segment<3>(column) << b.mass.inverse_mass, b.mass.inverse_mass, b.mass.inverse_inertia;
    velocity.segment<3>(column) << b.velocity.x, b.velocity.y, b.spin;
  }
  const Eigen::Map<const Eigen::VectorXd> target(target_.data(), unknowns()), limit(limit_.data(), unknowns());
  BoundedProblem problem;
  problem.response = j * inverse_mass.asDiagonal() * h.transpose();
  problem.start = j * velocity - target;
  problem.limit = limit;
  problem.normal = normal_;
  return problem;
}

void Group::read(const Eigen::VectorXd& x, std::vector<ContactImpulse>& impulse) const {
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const int unknown = unknown_of_[m];
    const bool has_tangential = unknown + 1 < unknowns() && normal_[unknown + 1] == unknown;
    impulse[members_[m]] = {x[unknown], has_tangential ? x[unknown + 1] : ratio_[m] * x[unknown]};
  }
}

}  // namespace

ContactSolution solve_contacts(const std::vector<ProblemPoint>& points, const std::vector<ProblemBody>& bodies,
                               FrictionLaw law) {
  ContactSolution all;
  all.impulse.resize(points.size());
  for (const Indices& members : groups_of(points, bodies)) {
    const Group group(members, points, bodies, law);
    const BoundedSolution solution = solve(group.problem());
    group.read(solution.x, all.impulse);
    all.residual = std::max(all.residual, solution.residual);
    all.steps = std::max(all.steps, solution.steps);
  }
  return all;
}

}  // namespace gem
