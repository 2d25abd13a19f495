// A chain of touching bodies solved directly: elimination along the chain, and again without the pairs that would pull.
#include <cmath>
#include <stdexcept>

#include "bench/solver_study/method.h"

namespace gem::bench {
namespace {

struct Link {  // one pair: its points share the impulse evenly
  std::int32_t a, b;
  Vec2 normal;
  std::size_t first;
  std::size_t points;
  double target;
  bool pushes = true;
};

class ChainElimination : public Method {
 public:
  ChainElimination(const Problem& problem, Impulses start) : Method(problem, std::move(start)) {
    std::vector<int> uses(problem.bodies(), 0);
    for (std::size_t k = 0; k < problem.points(); ++k) {
      const ProblemPoint& point = problem.point[k];
      if (point.own.friction != 0.0) throw std::invalid_argument("a chain with friction");
      if (k > 0 && point.a == problem.point[k - 1].a && point.b == problem.point[k - 1].b) {
        ++link_.back().points;
        continue;
      }
      link_.push_back({point.a, point.b, {point.own.normal_x, point.own.normal_y}, k, 1, point.own.target});
      for (const std::int32_t body : {point.a, point.b})
        if (problem.inverse_mass[body] > 0.0 && ++uses[body] > 2) throw std::invalid_argument("no chain");
    }
    put_in_order();
  }

  void pass() override {
    for (Link& link : link_) link.pushes = true;
    std::vector<double> impulse;
    for (bool again = true; again;) {
      impulse = eliminated();
      again = false;
      for (std::size_t i = 0; i < link_.size(); ++i)
        if (link_[i].pushes && impulse[i] < 0.0) {
          link_[i].pushes = false;
          again = true;
        }
    }
    for (std::size_t i = 0; i < link_.size(); ++i)
      for (std::size_t k = 0; k < link_[i].points; ++k)
        impulses_[link_[i].first + k] = {impulse[i] / static_cast<double>(link_[i].points), 0.0, 0.0};
  }
  std::int64_t phases_per_pass() const override { return 2 * static_cast<std::int64_t>(link_.size()); }

 private:
  /// Neighbours along the chain follow each other: a link is followed by one that shares its far body.
  void put_in_order() {
    std::vector<Link> ordered;
    std::vector<Link> rest = link_;
    std::int32_t far = -1;
    while (!rest.empty()) {
      std::size_t next = 0;
      for (std::size_t i = 0; i < rest.size(); ++i) {
        const bool at_end = problem_.inverse_mass[rest[i].a] == 0.0 || problem_.inverse_mass[rest[i].b] == 0.0;
        if (far < 0 ? at_end : rest[i].a == far || rest[i].b == far) next = i;
      }
      const Link link = rest[next];
      far = problem_.inverse_mass[link.a] == 0.0 || link.a == far ? link.b : link.a;
      ordered.push_back(link);
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(next));
    }
    link_ = ordered;
  }

  double response(const Link& at, const Link& from) const {
    if (!at.pushes || !from.pushes) return 0.0;
    double sum = 0.0;
    for (const std::int32_t body : {at.a, at.b})
      for (const std::int32_t other : {from.a, from.b})
        if (body == other)
          sum += (body == at.b ? 1.0 : -1.0) * (other == from.b ? 1.0 : -1.0) * problem_.inverse_mass[body];
    return sum * dot(at.normal, from.normal);
  }

  /// Thomas algorithm over the links.
  std::vector<double> eliminated() const {
    std::vector<double> upper(link_.size(), 0.0), value(link_.size(), 0.0);
    for (std::size_t i = 0; i < link_.size(); ++i) {
      const Link& link = link_[i];
      if (!link.pushes) continue;
      const double before = i > 0 ? response(link, link_[i - 1]) : 0.0;
      const double asked = link.target - dot(problem_.velocity[link.b] - problem_.velocity[link.a], link.normal);
      const double pivot = response(link, link) - (i > 0 ? before * upper[i - 1] : 0.0);
      upper[i] = i + 1 < link_.size() ? response(link, link_[i + 1]) / pivot : 0.0;
      value[i] = (asked - (i > 0 ? before * value[i - 1] : 0.0)) / pivot;
    }
    for (std::size_t i = link_.size(); i-- > 1;) value[i - 1] -= upper[i - 1] * value[i];
    return value;
  }

  std::vector<Link> link_;
};

}  // namespace

Candidate chain_elimination() {
  return {"elimination", [](const Problem& problem, Impulses start) {
            return std::make_unique<ChainElimination>(problem, std::move(start));
          }};
}

}  // namespace gem::bench
