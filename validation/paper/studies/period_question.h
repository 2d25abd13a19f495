// Why about 72 s and not the natural period? The candidate answers, what each predicts for the discriminating runs, and
// whether the runs agree.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/paper/statements/evaluation.h"

namespace gem {

/// The prediction of one candidate for one run.
struct Prediction {
  std::string condition;
  std::string metric;
  double period_s = 0.0;
  double rival_s = 0.0;  // the alternative: an interval that contains both decides nothing
  std::optional<Measured> measured;
  Verdict verdict = Verdict::undecidable;  // see judge_period()
};

/// Holds if every prediction does, is refuted if one is, and is undecidable otherwise.
struct Candidate {
  std::string name;
  std::string says;
  std::vector<Prediction> predictions;
  Verdict verdict = Verdict::undecidable;
};

/// The candidates for the paper's period [s], judged by the runs of cases/period_question.toml. Empty without the run
/// q_run1, which gives mass and mooring.
std::vector<Candidate> period_candidates(const PaperFolder& folder, double paper_period_s);

/// The measured interval is widened for the number of predictions judged together, so that a true candidate survives
/// all of them with 95 %, and by a tenth of the distance between period and rival. The prediction holds if the interval
/// contains the period and not its rival, is undecidable if it contains both, and is refuted otherwise.
Verdict judge_period(const Prediction& prediction, std::size_t together = 1);

/// Combines all predictions of one candidate.
Verdict judge_candidate(const std::vector<Prediction>& predictions);

}  // namespace gem
