// Sections of the page, one question each.
#include <algorithm>
#include <set>
#include <sstream>

#include "gem/base/number_text.h"
#include "gem/report/display.h"
#include "validation/paper/page/page_parts.h"

namespace gem {
namespace {

std::string candidate_verdict(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced:
      return "holds";
    case Verdict::not_reproduced:
      return "**refuted**";
    case Verdict::undecidable:
      return "undecidable";
  }
  return "";
}

std::string rate_text(const IntervalEstimate& rate) {
  return rounded_text(rate.value, 3) + " (" + end_text(rate.low) + " … " + end_text(rate.high) + ")";
}

/// Growth rates by the shift of the floe.
std::string growth_table(const DivergenceStudy& study) {
  std::ostringstream text;
  text << "| moved by [m] | growth rate [1/s] | early half | late half | from [s] | to [s] |\n"
          "|---|---|---|---|---:|---:|\n";
  std::set<double> sizes;
  for (const DivergingPair& pair : study.pairs) sizes.insert(pair.moved_m);
  for (const double size : sizes) {
    text << "| " << number_text(size) << " | ";
    if (const auto found = study.growth.find(size); found != study.growth.end())
      text << rate_text(found->second.rate) << " | " << rate_text(found->second.early) << " | "
           << rate_text(found->second.late) << " | " << rounded_text(found->second.begin, 4) << " | "
           << rounded_text(found->second.end, 4) << " |\n";
    else
      text << "not resolved | | | | |\n";
  }
  return text.str();
}

/// How the onset shifts with the size of the disturbance; `level` says which distance counts as onset.
std::string shift_text(const DivergenceStudy& study, const std::string& level) {
  if (!study.shift) return "";
  std::string text = " Onset (" + level + ") over ln(moved), each field with an onset of its own: slope " +
                     rate_text(study.shift->slope) + " s";
  if (const auto share = shift_over_growth(study))
    text +=
        ", " + rate_text(*share) +
        " of what growth at the rate of the smallest move would make it: 1 where what was put in grows, 0 where the "
        "size of the move makes no difference";
  return text + ".";
}

/// On which side of a candidate's predictions the measured spectral periods lie. `free` names the run without ice.
std::string side_text(const Candidate& candidate, const std::string& free) {
  std::size_t runs = 0, slower = 0;
  double least = 0.0, most = 0.0;
  for (const Prediction& prediction : candidate.predictions) {
    if (!prediction.measured || prediction.condition == free || prediction.metric != "x_period_by_spectrum_s") continue;
    const double longer = 100.0 * (prediction.measured->value / prediction.period_s - 1.0);
    least = runs == 0 ? longer : std::min(least, longer);
    most = runs == 0 ? longer : std::max(most, longer);
    ++runs;
    slower += longer > 0.0;
  }
  if (runs == 0) return "";
  return "By their spectra, " + std::to_string(slower) + " of " + std::to_string(runs) +
         " of these runs with ice swing more slowly than " + candidate.name + " would have them, " +
         rounded_text(least, 2) + " to " + rounded_text(most, 2) + " % in period.\n\n";
}

}  // namespace

std::string period_text(const Reproduction& result) {
  std::ostringstream text;
  text << "## Why 72 s?\n\n";
  if (result.period.empty()) return text.str() + "Needs the runs of `cases/period_question.toml`.\n\n";
  text << "Each candidate predicts a period for each run of `cases/period_question.toml`. A prediction holds if the "
          "measured interval, widened for the number of the candidate's predictions (Bonferroni) and by a tenth of the "
          "distance between prediction and rival, holds it but not the rival; an interval that holds both decides "
          "nothing. A candidate holds if all of its predictions do, and is "
          "refuted by the first that does not. This judges what explains *these* runs; what the authors' program did "
          "cannot be asked.\n\n"
       << "| candidate | says | run | number | predicted [s] | rival [s] | measured [s] | "
          "|\n|---|---|---|---|---:|---:|---|---|\n";
  for (const Candidate& candidate : result.period) {
    text << "| " << candidate.name << " | " << candidate.says << " | | | | | | " << candidate_verdict(candidate.verdict)
         << " |\n";
    for (const Prediction& prediction : candidate.predictions)
      text << "| | | " << prediction.condition << " | `" << prediction.metric << "` | "
           << rounded_text(prediction.period_s, 5) << " | " << rounded_text(prediction.rival_s, 5) << " | "
           << result_text(prediction.measured, "no run, or too few swings") << " | "
           << candidate_verdict(prediction.verdict) << " |\n";
  }
  return text.str() + "\n" + side_text(result.period.front(), "free_swing");
}

std::string counting_text(const PaperFolder& folder) {
  const std::string run = folder.of("q_run1").empty() ? "004_400_25" : "q_run1";
  if (folder.of(run).empty()) return "";
  std::ostringstream text;
  text << "Period of x of " << run << " by each way of finding it:\n\n| spectrum | crossings of the mean |";
  const char* intervals[] = {"", "_1s", "_2s", "_5s", "_10s", "_20s"};
  for (const std::string interval : intervals)
    text << " maxima, "
         << (interval.empty() ? "every sample" : "every " + interval.substr(1, interval.size() - 2) + " s") << " |";
  text << "\n|---|---|---|---|---|---|---|---|\n| " << mean_text(folder, run, "x_period_by_spectrum_s") << " | "
       << mean_text(folder, run, "x_period_by_crossings_s") << " |";
  for (const std::string interval : intervals)
    text << " " << mean_text(folder, run, "x_period_by_maxima" + interval + "_s") << " |";
  return text.str() + "\n\n";
}

std::string choices_text(const Reproduction& result) {
  std::ostringstream text;
  text << "## Which statements survive which choice\n\n";
  if (result.choices.empty()) return text.str() + "Needs the runs of `cases/sensitivity.toml`.\n\n";
  text << "The paper leaves these choices open. + reproduced, - not reproduced, ? undecidable.\n\n| choice |";
  for (const JudgedRow& row : result.choices.front().statements) text << " " << row.id << " |";
  text << "\n|---|";
  for (std::size_t i = 0; i < result.choices.front().statements.size(); ++i) text << ":---:|";
  text << "\n";
  for (const ChoiceRow& choice : result.choices) {
    text << "| " << choice.choice << " |";
    for (const JudgedRow& row : choice.statements)
      text << (row.verdict == Verdict::reproduced       ? " + |"
               : row.verdict == Verdict::not_reproduced ? " **-** |"
                                                        : " ? |");
    text << "\n";
  }
  return text.str() + "\n";
}

std::string divergence_text(const Reproduction& result) {
  const DivergenceStudy& study = result.divergence;
  std::ostringstream text;
  text << "## How fast runs part\n\n";
  if (study.pairs.empty()) return text.str() + "Needs the runs of `cases/divergence.toml`.\n\n";
  text << study.pairs.size()
       << " pairs of runs that differ by the place of one floe. Distance of the platforms in place and "
       << "in velocity over the natural frequency; the undisturbed motion has a deviation of "
       << rounded_text(1e3 * study.swing_m, 3) << " mm.\n\n"
       << growth_table(study)
       << "\nTimes count from when the disturbance has reached the platform of each pair. Exponential growth has one "
          "rate in both halves."
       << shift_text(study, "a tenth of the deviation") << "\n\n";
  return text.str();
}

std::string ice_text(const IceStudy& study) {
  std::string text = "## How fast the ice parts\n\n";
  if (study.of_contacts.empty()) return text + "Needs the rows of `build/ice_distances`.\n\n";
  text +=
      "The same question asked of the ice: root mean square over all floes of the distance between their places in two "
      "runs that differ by the place of one floe; parted where it is " +
      number_text(1e3 * kIceApart) +
      " mm. With `independent` contacts a difference grows where floes touch, by steps. With `coupled` ones it "
      "stays as small where few floes touch, and comes to a few micrometres over the whole field once many do, however "
      "small it was: the residual at which the iterations of a moment end, whose course any difference changes. Made "
      "by "
      "commit `" +
      study.commit + "`.\n\n";
  for (const auto& [contacts, own] : study.of_contacts)
    text += "`" + contacts + "` contacts, " + std::to_string(own.pairs.size()) + " pairs:\n\n" + growth_table(own) +
            "\n" + shift_text(own, "a tenth of that") + "\n\n";
  return text;
}

std::string chaos_text(const PaperFolder& folder) {
  if (folder.numbers("004_400_25", "x_zero_one_k").empty()) return "";
  std::ostringstream text;
  text << "Run 1 against 99 records of the null model: a linear oscillator with the mooring's period, hit at random as "
          "often "
          "as floes touched, damped as by floes that hit once or as much more as the run's own memory over one period "
          "asks for. Numbers: mean over the runs; p: of all runs together, by Fisher's method.\n\n| number | x | null "
          "| p | y | null | p |\n|---|---|---|---|---|---|---|\n";
  for (const auto& [name, key] :
       {std::pair("0-1 test K", "zero_one_k"), std::pair("prediction error", "prediction_error")}) {
    const std::string base = key;
    const std::string chance = base == "zero_one_k" ? "zero_one_p" : "prediction_p";
    text << "| " << name;
    for (const std::string axis : {"x_", "y_"})
      text << " | " << mean_text(folder, "004_400_25", axis + base) << " | "
           << mean_text(folder, "004_400_25", axis + base + "_null_median") << " | "
           << chance_text(folder, "004_400_25", axis + chance);
    text << " |\n";
  }
  text << "| damping ratio | | " << mean_text(folder, "004_400_25", "x_null_damping_ratio") << " | | | "
       << mean_text(folder, "004_400_25", "y_null_damping_ratio") << " | |\n";
  return text.str() + "\n";
}

}  // namespace gem
