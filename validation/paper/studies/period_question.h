// Why about 72 s and not the natural period? Candidate answers, what each predicts for the discriminating runs, and
// whether the runs agree.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/paper/statements/evaluation.h"

namespace gem {

/// What one candidate says about one run.
struct Prediction {
  std::string condition;
  std::string metric;
  double period_s = 0.0;
  double rival_s = 0.0;  // what is said otherwise: an interval that holds both tells nothing
  std::optional<Measured> measured;
  Verdict verdict = Verdict::undecidable;  // the see judge_period()
};

/// Holds if every prediction does, refuted by the first that does not, undecidable otherwise.
struct Candidate {
  std::string name;
  std::string says;
  std::vector<Prediction> predictions;
  Verdict verdict = Verdict::undecidable;
};

/// The candidates for the paper's period [s], against the runs of cases/period_question.toml. Empty without the run
/// q_run1, from which mass and mooring are taken.
std::vector<Candidate> period_candidates(const PaperFolder& folder, double paper_period_s);

/// The measured interval, widened for the number of predictions that are judged together so that a true candidate
/// survives all of them with 95 %, and by a tenth of the distance between period and rival, holds the period (and not
/// its rival), holds both (undecidable), or does not hold it.
Verdict judge_period(const Prediction& prediction, std::size_t together = 1);

/// All predictions of one candidate together.
Verdict judge_candidate(const std::vector<Prediction>& predictions);

}  // namespace gem
