// Projected Gauss-Seidel by colour, and conjugate gradients around it.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "bench/solver_study/method.h"

namespace gem::bench {
namespace {

/// One visit to each point in turn, whose bodies move at once.
void sweep(const Problem& problem, const PointOrder& order, Impulses& impulses, Motions& motions) {
  for (const std::int32_t k : order.point) {
    const ProblemPoint& point = problem.point[k];
    const PointImpulse<double> before = impulses[k];
    PointImpulse<double> carried = before;
    visit_studied<PointFriction::coulomb>(point.own, motions[point.a], motions[point.b], problem.dt, 1.0 / problem.dt,
                                          0.0, impulses[k], carried);
    add_change(problem, point,
               {impulses[k].normal - before.normal, impulses[k].tangential - before.tangential,
                impulses[k].repair - before.repair},
               motions);
  }
}

class GaussSeidel : public Method {
 public:
  GaussSeidel(const Problem& problem, Impulses start)
      : Method(problem, std::move(start)), order_(colour_points(problem)), motions_(motions_of(problem, impulses_)) {}
  void pass() override { sweep(problem_, order_, impulses_, motions_); }
  std::int64_t phases_per_pass() const override { return order_.colours; }

 private:
  PointOrder order_;
  Motions motions_;
};

/// The change of a sweep is taken as minus the gradient; `repair` follows its own plain sweeps.
class ConjugateGradient : public Method {
 public:
  ConjugateGradient(const Problem& problem, Impulses start)
      : Method(problem, std::move(start)),
        order_(colour_points(problem)),
        at_(impulses_),
        direction_(impulses_.size(), PointImpulse<double>{}) {}

  void pass() override {
    impulses_ = at_;
    Motions motions = motions_of(problem_, impulses_);
    sweep(problem_, order_, impulses_, motions);
    double square = 0.0;
    for (std::size_t k = 0; k < at_.size(); ++k) {
      const double n = impulses_[k].normal - at_[k].normal, t = impulses_[k].tangential - at_[k].tangential;
      square += n * n * problem_.point[k].own.nn + t * t * problem_.point[k].own.tt;
    }
    const bool restart = last_square_ == 0.0 || square > last_square_;
    const double along = restart ? 0.0 : square / last_square_;
    last_square_ = square;
    for (std::size_t k = 0; k < at_.size(); ++k) {
      PointImpulse<double>& d = direction_[k];
      const PointImpulse<double> next = impulses_[k], step{along * d.normal, along * d.tangential, 0.0};
      d = {next.normal - at_[k].normal + step.normal, next.tangential - at_[k].tangential + step.tangential, 0.0};
      at_[k] = {next.normal + step.normal, next.tangential + step.tangential, next.repair};
    }
  }
  std::int64_t phases_per_pass() const override { return order_.colours + 2; }  // and a sum over all points

 private:
  PointOrder order_;
  Impulses at_, direction_;
  double last_square_ = 0.0;
};

}  // namespace

PointOrder colour_points(const Problem& problem) {
  PointOrder order;
  std::vector<std::uint64_t> used(problem.bodies(), 0);
  std::vector<int> colour(problem.points());
  for (std::size_t k = 0; k < problem.points(); ++k) {
    const ProblemPoint& point = problem.point[k];
    const auto taken = [&](std::int32_t body) { return body != 0 && problem.inverse_mass[body] > 0.0; };
    const std::uint64_t both = (taken(point.a) ? used[point.a] : 0) | (taken(point.b) ? used[point.b] : 0);
    colour[k] = std::countr_one(both);
    if (taken(point.a)) used[point.a] |= std::uint64_t{1} << colour[k];
    if (taken(point.b)) used[point.b] |= std::uint64_t{1} << colour[k];
    order.colours = std::max<std::int64_t>(order.colours, colour[k] + 1);
  }
  order.point.resize(problem.points());
  std::iota(order.point.begin(), order.point.end(), 0);
  std::stable_sort(order.point.begin(), order.point.end(), [&](int p, int q) { return colour[p] < colour[q]; });
  return order;
}

Candidate gauss_seidel() {
  return {"Gauss-Seidel", [](const Problem& problem, Impulses start) {
            return std::make_unique<GaussSeidel>(problem, std::move(start));
          }};
}

Candidate conjugate_gradient() {
  return {"conjugate gradient", [](const Problem& problem, Impulses start) {
            return std::make_unique<ConjugateGradient>(problem, std::move(start));
          }};
}

}  // namespace gem::bench
