// Predictions from mass, mooring and current of each run.
#include "gem/report/paper/period_question.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "gem/analysis/equivalence.h"

namespace gem {
namespace {

constexpr const char* kBase = "q_run1";
constexpr const char* kSpectrum = "x_period_by_spectrum_s";
constexpr const char* kCrossings = "x_period_by_crossings_s";
constexpr const char* kFree = "free_period_s";
constexpr const char* kWithIce[] = {kBase,          "q_soft",      "q_current_50",     "q_current_100",
                                    "q_tiled_100m", "q_tiled_50m", "q_independent",    "q_independent_1e5",
                                    "q_open",       "q_narrow",    "q_independent_1e7"};

double natural(const SceneDef& scene, double added_stiffness = 0.0) {
  return 2.0 * std::numbers::pi *
         std::sqrt(scene.platform.mass_kg / (scene.mooring.stiffness_N_per_m + added_stiffness));
}

class Candidates {
 public:
  Candidates(const PaperFolder& folder, double paper_period_s)
      : folder_(folder), base_(folder.of(kBase).front().scene), paper_(paper_period_s) {}

  std::vector<Candidate> all() const {
    return {nothing_else(), mass_or_time(), ice_stiffness(), counted_wiggles(), passing_pattern()};
  }

 private:
  Prediction predict(const std::string& condition, const std::string& metric, double period_s) const {
    Prediction prediction{condition, metric, period_s, over_runs(folder_.numbers(condition, metric), Over::mean)};
    return prediction;
  }

  static Candidate judged(Candidate candidate) {
    for (Prediction& prediction : candidate.predictions)
      prediction.verdict = judge_period(prediction.period_s, prediction.measured, candidate.predictions.size());
    candidate.verdict = judge_candidate(candidate.predictions);
    return candidate;
  }

  /// Mass and mooring of each run that is there; of the base for one that is not.
  const SceneDef& scene(const std::string& condition) const {
    const auto& runs = folder_.of(condition);
    return runs.empty() ? base_ : runs.front().scene;
  }

  Candidate nothing_else() const {
    Candidate candidate{"mass and mooring alone", "every run swings with 2 pi sqrt(M/k)", {}};
    candidate.predictions.push_back(predict("free_swing", kFree, natural(scene("free_swing"))));
    for (const std::string condition : kWithIce)
      candidate.predictions.push_back(predict(condition, kSpectrum, natural(scene(condition))));
    candidate.predictions.push_back(predict(kBase, kCrossings, natural(base_)));
    return judged(candidate);
  }

  Candidate mass_or_time() const {
    const double share = paper_ / natural(base_);
    Candidate candidate{
        "smaller effective mass, or a scaled time axis", "every period is shortened by the same factor", {}};
    candidate.predictions.push_back(predict("free_swing", kFree, share * natural(scene("free_swing"))));
    for (const char* condition : {kBase, "q_soft"})
      candidate.predictions.push_back(predict(condition, kSpectrum, share * natural(scene(condition))));
    return judged(candidate);
  }

  Candidate ice_stiffness() const {
    const double share = natural(base_) / paper_;
    const double added = base_.mooring.stiffness_N_per_m * (share * share - 1.0);
    Candidate candidate{"the ice is a spring", "the ice adds one stiffness to any mooring, nothing without ice", {}};
    candidate.predictions.push_back(predict("free_swing", kFree, natural(scene("free_swing"))));
    for (const char* condition : {kBase, "q_soft"})
      candidate.predictions.push_back(predict(condition, kSpectrum, natural(scene(condition), added)));
    return judged(candidate);
  }

  /// Which sampling interval the paper's record had is not known: the nearest of several speaks for the candidate.
  Candidate counted_wiggles() const {
    Candidate candidate{"wiggles counted as swings",
                        "spectrum and crossings have the natural period, the count of all local maxima has the paper's",
                        {}};
    for (const char* metric : {kSpectrum, kCrossings})
      candidate.predictions.push_back(predict(kBase, metric, natural(base_)));
    std::optional<Prediction> nearest;
    for (const char* interval : {"", "_1s", "_2s", "_5s", "_10s", "_20s"}) {
      const Prediction prediction = predict(kBase, std::string("x_period_by_maxima") + interval + "_s", paper_);
      const auto distance = [this](const Prediction& p) {
        return p.measured ? std::abs(p.measured->value - paper_) : std::numeric_limits<double>::infinity();
      };
      if (!nearest || distance(prediction) < distance(*nearest)) nearest = prediction;
    }
    candidate.predictions.push_back(*nearest);
    return judged(candidate);
  }

  Candidate passing_pattern() const {
    Candidate candidate{
        "a pattern of floes that passes with the current", "the period is a length over the current", {}};
    const double pattern = paper_ * length(base_.current.velocity_m_per_s);
    for (const char* condition : {kBase, "q_current_50", "q_current_100", "q_tiled_100m", "q_tiled_100m_current_50"}) {
      const auto& runs = folder_.of(condition);
      if (!runs.empty())
        candidate.predictions.push_back(
            predict(condition, kSpectrum, pattern / length(runs.front().scene.current.velocity_m_per_s)));
    }
    return judged(candidate);
  }

  const PaperFolder& folder_;
  const SceneDef& base_;
  double paper_;
};

}  // namespace

Verdict judge_period(double period_s, const std::optional<Measured>& measured, std::size_t together) {
  if (!measured || !std::isfinite(measured->low) || !std::isfinite(measured->high)) return Verdict::undecidable;
  const double wider = widening(together);
  // A free swing is known to more digits than the numbers that it is predicted from.
  const double rounding = 1e-6 * period_s;
  const double low = measured->value - wider * (measured->value - measured->low) - rounding;
  const double high = measured->value + wider * (measured->high - measured->value) + rounding;
  const bool holds = low <= period_s && period_s <= high;
  return holds ? Verdict::reproduced : Verdict::not_reproduced;
}

Verdict judge_candidate(const std::vector<Prediction>& predictions) {
  bool all = !predictions.empty();
  for (const Prediction& prediction : predictions) {
    if (prediction.verdict == Verdict::not_reproduced) return Verdict::not_reproduced;
    all = all && prediction.verdict == Verdict::reproduced;
  }
  return all ? Verdict::reproduced : Verdict::undecidable;
}

std::vector<Candidate> period_candidates(const PaperFolder& folder, double paper_period_s) {
  if (folder.of(kBase).empty()) return {};
  return Candidates(folder, paper_period_s).all();
}

}  // namespace gem
