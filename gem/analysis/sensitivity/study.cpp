// Sorts the runs of a study by condition and draw, and applies the estimators that its design allows.
#include "gem/analysis/sensitivity/study.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "gem/analysis/statistics/moments.h"

namespace gem {
namespace {

/// The runs of one draw by part and repeat.
struct DrawOfStudy {
  std::map<std::pair<std::string, std::int64_t>, const StudyRun*> runs;
};

struct ConditionOfStudy {
  std::string name;
  std::map<std::int64_t, DrawOfStudy> draws;
};

std::vector<ConditionOfStudy> conditions_of(const Study& study) {
  std::vector<ConditionOfStudy> conditions;
  std::map<std::string, std::size_t> place;
  for (const StudyRun& run : study.runs) {
    const auto [found, is_new] = place.insert({run.condition, conditions.size()});
    if (is_new) conditions.push_back({run.condition, {}});
    conditions[found->second].draws[run.draw].runs[{run.part, run.repeat}] = &run;
  }
  return conditions;
}

bool same_runs(const DrawOfStudy& a, const DrawOfStudy& b) {
  return std::equal(a.runs.begin(), a.runs.end(), b.runs.begin(), b.runs.end(),
                    [](const auto& one, const auto& other) { return one.first == other.first; });
}

/// Draws that have the same runs as the fullest one, each with a finite output.
std::vector<const DrawOfStudy*> complete_draws(const ConditionOfStudy& condition, std::size_t output) {
  const auto fullest =
      std::max_element(condition.draws.begin(), condition.draws.end(),
                       [](const auto& a, const auto& b) { return a.second.runs.size() < b.second.runs.size(); });
  std::vector<const DrawOfStudy*> complete;
  for (const auto& [number, draw] : condition.draws) {
    const bool finite = std::all_of(draw.runs.begin(), draw.runs.end(), [output](const auto& entry) {
      return std::isfinite(entry.second->outputs[output]);
    });
    if (finite && same_runs(draw, fullest->second)) complete.push_back(&draw);
  }
  return complete;
}

bool is_saltelli(const std::vector<const DrawOfStudy*>& draws) {
  return !draws.empty() && !draws.front()->runs.begin()->second->part.empty();
}

/// Independent runs: all of a plain design, A and B of a Saltelli design.
DrawnRuns independent_runs(const std::vector<const DrawOfStudy*>& draws, std::size_t output, std::size_t inputs) {
  DrawnRuns runs;
  runs.inputs.resize(inputs);
  const auto add = [&](const StudyRun& first) {
    for (std::size_t k = 0; k < inputs; ++k) runs.inputs[k].push_back(first.inputs[k]);
    runs.outputs.emplace_back();
  };
  for (const DrawOfStudy* draw : draws) {
    if (!is_saltelli(draws)) add(*draw->runs.begin()->second);
    for (const auto& [key, run] : draw->runs) {
      const bool independent = key.first.empty() || key.first == "A" || key.first == "B";
      if (!independent) continue;
      if (!key.first.empty()) add(*run);
      runs.outputs.back().push_back(run->outputs[output]);
    }
  }
  return runs;
}

/// Whether draws have the runs that Sobol indices need.
bool has_all_parts(const DrawOfStudy& draw, const Study& study) {
  const auto has = [&draw](const std::string& part) { return draw.runs.contains({part, 1}); };
  return has("A") && has("B") && std::all_of(study.inputs.begin(), study.inputs.end(), [&has](const StudyInput& input) {
           return has(input.name);
         });
}

SaltelliRuns saltelli_runs(const std::vector<const DrawOfStudy*>& draws, std::size_t output, const Study& study) {
  SaltelliRuns runs;
  runs.a_with_b.resize(study.inputs.size());
  const auto value = [output](const DrawOfStudy& draw, const std::string& part) {
    return draw.runs.at({part, 1})->outputs[output];
  };
  for (const DrawOfStudy* draw : draws) {
    runs.a.push_back(value(*draw, "A"));
    runs.b.push_back(value(*draw, "B"));
    for (std::size_t k = 0; k < study.inputs.size(); ++k)
      runs.a_with_b[k].push_back(value(*draw, study.inputs[k].name));
  }
  return runs;
}

void add_moments(OutputEffects& effects, const DrawnRuns& runs, const Resampling& resampling) {
  std::vector<double> all;
  for (const std::vector<double>& outputs : runs.outputs) all.insert(all.end(), outputs.begin(), outputs.end());
  effects.runs = all.size();
  const Moments about = moments(all);
  effects.smallest = about.minimum;
  effects.largest = about.maximum;
  if (runs.draws() < 2) return;
  const std::size_t repeats = runs.repeats();
  std::vector<double> chosen(all.size());
  const std::vector<IntervalEstimate> estimates = bootstrap_together(
      runs.draws(),
      [&](std::span<const std::size_t> draws) {
        for (std::size_t i = 0; i < draws.size(); ++i)
          std::copy(runs.outputs[draws[i]].begin(), runs.outputs[draws[i]].end(),
                    chosen.begin() + static_cast<std::ptrdiff_t>(i * repeats));
        const Moments m = moments(chosen);
        return std::vector<double>{m.mean, m.deviation, percentile(chosen, 0.9)};
      },
      resampling);
  effects.mean = estimates[0];
  effects.deviation = estimates[1];
  effects.p90 = estimates[2];
}

/// Trends of all inputs but seeds.
void add_trends(OutputEffects& effects, const DrawnRuns& runs, const Study& study, const Resampling& resampling) {
  DrawnRuns ordered;
  std::vector<std::size_t> place;
  for (std::size_t k = 0; k < study.inputs.size(); ++k)
    if (!study.inputs[k].is_seed) {
      ordered.inputs.push_back(runs.inputs[k]);
      place.push_back(k);
    }
  if (place.empty() || runs.draws() < draws_for_trends(place.size())) return;
  ordered.outputs = runs.outputs;
  const TrendShares linear = trend_shares(ordered, resampling);
  const TrendShares monotone = trend_shares(ranked(ordered), resampling);
  effects.linear_explained = linear.explained;
  effects.monotone_explained = monotone.explained;
  for (std::size_t i = 0; i < place.size(); ++i) {
    effects.inputs[place[i]].linear = linear.inputs[i];
    effects.inputs[place[i]].monotone = monotone.inputs[i];
  }
}

void add_plain_indices(OutputEffects& effects, const DrawnRuns& runs, const Study& study,
                       const Resampling& resampling) {
  if (runs.draws() >= kDrawsForFirstOrder) {
    const std::vector<IntervalEstimate> first = first_order_indices(runs, resampling);
    for (std::size_t k = 0; k < study.inputs.size(); ++k)
      if (!study.inputs[k].is_seed) effects.inputs[k].first = first[k];
  }
  if (runs.repeats() < 2 || runs.draws() < 3) return;
  for (std::size_t k = 0; k < study.inputs.size(); ++k)
    if (study.inputs[k].is_seed) effects.inputs[k].total = repeat_share(runs, resampling);
}

OutputEffects output_effects(const Study& study, const ConditionOfStudy& condition, std::size_t output,
                             const Resampling& resampling) {
  OutputEffects effects;
  effects.output = study.outputs[output];
  effects.inputs.resize(study.inputs.size());
  const std::vector<const DrawOfStudy*> draws = complete_draws(condition, output);
  effects.draws = draws.size();
  effects.left_out = condition.draws.size() - draws.size();
  const DrawnRuns runs = independent_runs(draws, output, study.inputs.size());
  add_moments(effects, runs, resampling);
  if (!(effects.largest > effects.smallest)) return effects;
  add_trends(effects, runs, study, resampling);
  if (!is_saltelli(draws)) {
    add_plain_indices(effects, runs, study, resampling);
  } else if (draws.size() >= 3 && has_all_parts(*draws.front(), study)) {
    const std::vector<SobolIndex> indices = sobol_indices(saltelli_runs(draws, output, study), resampling);
    for (std::size_t k = 0; k < indices.size(); ++k) {
      effects.inputs[k].first = indices[k].first;
      effects.inputs[k].total = indices[k].total;
    }
  }
  return effects;
}

}  // namespace

std::vector<ConditionEffects> study_effects(const Study& study, const Resampling& resampling) {
  std::vector<ConditionEffects> all;
  for (const ConditionOfStudy& condition : conditions_of(study)) {
    all.push_back({condition.name, {}});
    for (std::size_t output = 0; output < study.outputs.size(); ++output)
      all.back().outputs.push_back(output_effects(study, condition, output, resampling));
  }
  return all;
}

}  // namespace gem
