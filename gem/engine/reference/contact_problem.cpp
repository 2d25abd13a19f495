// Algorithm:
//   Points that are connected by moving bodies form a group.
//   For each group, unknowns that share a body are coupled:
//     K_ij = sum over shared bodies of  d_i . g_j / m + (arm_i x d_i) (arm_j x g_j) / I
//     b_i  = d_i . u before - target
//   d is the direction along which u is measured and g that of the impulse. They are equal except for fixed_direction,
//   where the impulse includes its friction.
#include "gem/engine/reference/contact_problem.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "gem/engine/reference/bounded_problem.h"

namespace gem::reference {
namespace {

using Indices = std::vector<std::size_t>;

bool moves(const ProblemBody& body) { return body.mass.inverse_mass > 0.0 || body.mass.inverse_inertia > 0.0; }

/// Point indices by group, each ascending.
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

/// Velocity of B relative to A at a point before the impulses [m/s].
Vec2 velocity_before(const ProblemPoint& p, const std::vector<ProblemBody>& bodies) {
  const ProblemBody &a = bodies[p.a], &b = bodies[p.b];
  return b.velocity + cross(b.spin, p.arm_b) - a.velocity - cross(a.spin, p.arm_a);
}

/// P_t / P_n for the law fixed_direction; 0 where nothing slips or where friction would jam the corner (impact.h).
double fixed_ratio(const ProblemPoint& p, const std::vector<ProblemBody>& bodies) {
  const double slip = slip_of_hit(dot(velocity_before(p, bodies), turned_left(p.normal)), p.last, p.rise);
  if (slip == 0.0) return 0.0;
  const double ratio = slip > 0.0 ? -p.friction : p.friction;
  const ContactCompliance k = contact_compliance(bodies[p.a].mass, p.arm_a, bodies[p.b].mass, p.arm_b, p.normal);
  return k.nn + ratio * k.nt > 0.0 ? ratio : 0.0;
}

/// How an unknown acts on one of its bodies.
struct Side {
  int unknown;
  Vec2 measured, given;  // u is measured along `measured`; the impulse acts along `given`; both negated for A
  double measured_lever, given_lever;  // arm x direction [m]
};

/// The unknowns of one group and their problem.
class Group {
 public:
  Group(const Indices& members, const std::vector<ProblemPoint>& points, const std::vector<ProblemBody>& bodies,
        FrictionLaw law)
      : members_(members), bodies_(bodies) {
    for (const std::size_t i : members) add_point(points[i], law);
  }

  BoundedProblem problem() const;
  /// Writes the impulses of the unknowns to the points.
  void read(const Eigen::VectorXd& x, std::vector<ContactImpulse>& impulse) const;

 private:
  int unknowns() const { return static_cast<int>(start_.size()); }
  void add_point(const ProblemPoint& p, FrictionLaw law);
  void add_unknown(const ProblemPoint& p, Vec2 measured, Vec2 given, double target, double limit, int normal,
                   SpareFriction spare = {});

  const Indices& members_;
  const std::vector<ProblemBody>& bodies_;
  std::map<std::int32_t, std::vector<Side>> sides_;  // by body
  std::vector<double> start_, limit_;                // see BoundedProblem
  std::vector<int> normal_;
  std::vector<SpareFriction> spare_;
  std::vector<int> unknown_of_;  // per member: unknown of its normal impulse
  std::vector<double> ratio_;    // per member: P_t / P_n where the law fixes it
};

void Group::add_unknown(const ProblemPoint& p, Vec2 measured, Vec2 given, double target, double limit, int normal,
                        SpareFriction spare) {
  const int unknown = unknowns();
  sides_[p.b].push_back({unknown, measured, given, cross(p.arm_b, measured), cross(p.arm_b, given)});
  sides_[p.a].push_back({unknown, -measured, -given, cross(p.arm_a, -measured), cross(p.arm_a, -given)});
  start_.push_back(dot(velocity_before(p, bodies_), measured) - target);
  limit_.push_back(limit);
  normal_.push_back(normal);
  spare_.push_back(spare);
}

void Group::add_point(const ProblemPoint& p, FrictionLaw law) {
  const Vec2 tangent = turned_left(p.normal);
  const bool rough = p.friction > 0.0;
  const double ratio = rough && law == FrictionLaw::fixed_direction ? fixed_ratio(p, bodies_) : 0.0;
  const int unknown = unknowns();
  unknown_of_.push_back(unknown);
  ratio_.push_back(ratio);
  add_unknown(p, p.normal, p.normal + ratio * tangent, p.target, p.cap, BoundedProblem::none);
  if (rough && law == FrictionLaw::one_step) add_unknown(p, tangent, tangent, 0.0, p.friction, unknown, p.spare);
}

BoundedProblem Group::problem() const {
  std::vector<Eigen::Triplet<double>> entries;  // a pair of points shares both bodies and gives two terms
  for (const auto& [body, sides] : sides_) {
    const CollisionMass mass = bodies_[body].mass;
    for (const Side& at : sides)
      for (const Side& from : sides)
        entries.emplace_back(at.unknown, from.unknown,
                             mass.inverse_mass * dot(at.measured, from.given) +
                                 mass.inverse_inertia * (at.measured_lever * from.given_lever));
  }
  BoundedProblem problem;
  problem.response.resize(unknowns(), unknowns());
  problem.response.setFromTriplets(entries.begin(), entries.end());
  problem.response.prune([](int, int, double value) { return value != 0.0; });
  problem.start = Eigen::Map<const Eigen::VectorXd>(start_.data(), unknowns());
  problem.limit = Eigen::Map<const Eigen::VectorXd>(limit_.data(), unknowns());
  problem.normal = normal_;
  problem.spare = spare_;
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
                               FrictionLaw law, Infeasible infeasible) {
  ContactSolution all;
  all.impulse.resize(points.size());
  for (const Indices& members : groups_of(points, bodies)) {
    const Group group(members, points, bodies, law);
    const BoundedProblem problem = group.problem();
    const BoundedSolution solution = infeasible == Infeasible::throws ? solve(problem) : solve_regularised(problem);
    group.read(solution.x, all.impulse);
    all.residual = std::max(all.residual, solution.residual);
    all.steps = std::max(all.steps, solution.steps);
  }
  return all;
}

}  // namespace gem::reference
