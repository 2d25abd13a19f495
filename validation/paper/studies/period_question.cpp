// Predicts periods from mass, mooring and current of each run.
#include "validation/paper/studies/period_question.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "gem/analysis/statistics/equivalence.h"

namespace gem {
namespace {

// Many seeds give a period to a tenth of a second. A candidate is not refuted by an error below this share of the
// distance to its rival.
constexpr double kMargin = 0.1;
constexpr const char* kBase = "q_run1";
constexpr const char* kSpectrum = "x_period_by_spectrum_s";
constexpr const char* kCrossings = "x_period_by_crossings_s";
constexpr const char* kMaxima = "x_period_by_maxima_s";
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
  Prediction predict(const std::string& condition, const std::string& metric, double period_s, double rival_s) const {
    return {condition,           metric, period_s, rival_s, over_runs(folder_.numbers(condition, metric), Over::mean),
            Verdict::undecidable};
  }

  static Candidate judged(Candidate candidate) {
    for (Prediction& prediction : candidate.predictions)
      prediction.verdict = judge_period(prediction, candidate.predictions.size());
    candidate.verdict = judge_candidate(candidate.predictions);
    return candidate;
  }

  /// The scene of a run if it exists, otherwise that of the base run.
  const SceneDef& scene(const std::string& condition) const {
    const auto& runs = folder_.of(condition);
    return runs.empty() ? base_ : runs.front().scene;
  }

  /// The period that follows from mass and mooring alone, and the rival: shortened by the same factor as the paper's
  /// period.
  Prediction natural_of(const std::string& condition, const std::string& metric) const {
    const double period = natural(scene(condition));
    return predict(condition, metric, period, shortened() * period);
  }

  double shortened() const { return paper_ / natural(base_); }

  Candidate nothing_else() const {
    Candidate candidate{"mass and mooring alone", "every run swings with 2 pi sqrt(M/k)", {}};
    candidate.predictions.push_back(natural_of("free_swing", kFree));
    for (const char* condition : kWithIce) candidate.predictions.push_back(natural_of(condition, kSpectrum));
    candidate.predictions.push_back(natural_of(kBase, kCrossings));
    return judged(candidate);
  }

  Candidate mass_or_time() const {
    Candidate candidate{
        "smaller effective mass, or a scaled time axis", "every period is shortened by the same factor", {}};
    for (const auto& [condition, metric] :
         {std::pair("free_swing", kFree), {kBase, kSpectrum}, {"q_soft", kSpectrum}}) {
      const double period = natural(scene(condition));
      candidate.predictions.push_back(predict(condition, metric, shortened() * period, period));
    }
    return judged(candidate);
  }

  Candidate ice_stiffness() const {
    const double added = base_.mooring.stiffness_N_per_m * (1.0 / (shortened() * shortened()) - 1.0);
    Candidate candidate{"the ice is a spring", "the ice adds one stiffness to any mooring, nothing without ice", {}};
    candidate.predictions.push_back(natural_of("free_swing", kFree));
    for (const char* condition : {kBase, "q_soft"})
      candidate.predictions.push_back(
          predict(condition, kSpectrum, natural(scene(condition), added), natural(scene(condition))));
    return judged(candidate);
  }

  /// Counted in the record at its own sampling: choosing the best sampling interval would be no test.
  Candidate counted_wiggles() const {
    Candidate candidate{"wiggles counted as swings",
                        "spectrum and crossings have the natural period, the count of all local maxima has the paper's",
                        {}};
    for (const char* metric : {kSpectrum, kCrossings}) candidate.predictions.push_back(natural_of(kBase, metric));
    candidate.predictions.push_back(predict(kBase, kMaxima, paper_, natural(base_)));
    return judged(candidate);
  }

  Candidate passing_pattern() const {
    Candidate candidate{
        "a pattern of floes that passes with the current", "the period is a length over the current", {}};
    const double pattern = paper_ * length(base_.current.velocity_m_per_s);
    for (const char* condition : {kBase, "q_current_50", "q_current_100", "q_tiled_100m", "q_tiled_100m_current_50"}) {
      const SceneDef& own = scene(condition);
      if (!folder_.of(condition).empty())
        candidate.predictions.push_back(
            predict(condition, kSpectrum, pattern / length(own.current.velocity_m_per_s), natural(own)));
    }
    return judged(candidate);
  }

  const PaperFolder& folder_;
  const SceneDef& base_;
  double paper_;
};

}  // namespace

Verdict judge_period(const Prediction& prediction, std::size_t together) {
  const std::optional<Measured>& measured = prediction.measured;
  if (!measured || !std::isfinite(measured->low) || !std::isfinite(measured->high)) return Verdict::undecidable;
  const double wider = widening(together);
  const double margin = kMargin * std::abs(prediction.period_s - prediction.rival_s);
  const double low = measured->value - wider * (measured->value - measured->low) - margin;
  const double high = measured->value + wider * (measured->high - measured->value) + margin;
  const auto holds = [low, high](double period) { return low <= period && period <= high; };
  if (!holds(prediction.period_s)) return Verdict::not_reproduced;
  return holds(prediction.rival_s) ? Verdict::undecidable : Verdict::reproduced;
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
