// Jacobi and accelerated iterations with shared masses: the engine's own visit to a point, with its choices as options.
#include <cmath>

#include "bench/solver_study/method.h"

namespace gem::bench {
namespace {

class Gathering : public Method {
 public:
  Gathering(const Problem& problem, Impulses start, const GatherOptions& options)
      : Method(problem, std::move(start)), options_(options), carried_(impulses_), theta_(options.begin) {
    for (const ProblemPoint& point : problem.point) {
      StudiedPoint g = point.own;
      g.nn += options.share * (point.shared.nn - g.nn);
      g.tt += options.share * (point.shared.tt - g.tt);
      g.nt += options.share * (point.shared.nt - g.nt);
      g.inverse_nn = 1.0 / g.nn;
      g.inverse_tt = 1.0 / g.tt;
      geometry_.push_back(g);
    }
  }

  void pass() override {
    const Motions motions = motions_of(problem_, carried_);
    const double ahead = next_ahead();
    climb_ = 0.0;
    for (std::size_t k = 0; k < problem_.points(); ++k) {
      const ProblemPoint& point = problem_.point[k];
      climb_ += visit_studied<PointFriction::coulomb>(geometry_[k], motions[point.a], motions[point.b],
                                                      options_.anticipates ? problem_.dt : 0.0, 1.0 / problem_.dt,
                                                      ahead, impulses_[k], carried_[k])
                    .climb;
    }
  }
  std::int64_t phases_per_pass() const override { return 2; }

 private:
  double next_ahead() {
    if (options_.begin == 0.0) return 0.0;
    if (climb_ > 0.0) {
      theta_ = 1.0;
      return 0.0;
    }
    const double theta = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * theta_ * theta_)), ahead = (theta_ - 1.0) / theta;
    theta_ = theta;
    return ahead;
  }

  const GatherOptions options_;
  std::vector<StudiedPoint> geometry_;
  Impulses carried_;
  double theta_, climb_ = 0.0;
};

}  // namespace

Candidate gathering(const std::string& name, const GatherOptions& options) {
  return {name, [options](const Problem& problem, Impulses start) {
            return std::make_unique<Gathering>(problem, std::move(start), options);
          }};
}

}  // namespace gem::bench
