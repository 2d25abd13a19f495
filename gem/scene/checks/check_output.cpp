// Intervals of the output.
#include "gem/scene/checks/checks.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

constexpr double samples_maximum = 1e9;

}  // namespace

void check_output(const SceneDef& s, SceneProblems& out) {
  const auto check = [&](const char* key, double interval) {
    if (interval < s.numerics.time_step_s)
      out.push_back({key, "shorter than one time step (value " + plain_number_text(interval) + ", allowed at least " +
                              plain_number_text(s.numerics.time_step_s) + " s); give a whole number of time steps"});
    else if (s.run.duration_s / interval > samples_maximum)
      out.push_back({key, "too many samples (value " + plain_number_text(interval) + ", allowed at least " +
                              plain_number_text(s.run.duration_s / samples_maximum) + " s)"});
  };
  check("output.platform_interval_s", s.output.platform_interval_s);
  check("output.floes_interval_s", s.output.floes_interval_s);
  check("output.force_window_s", s.output.force_window_s);
}

void warn_of_output(const SceneDef& s, SceneWarnings& warnings) {
  if (s.platform.present && s.output.platform_interval_s >= s.run.duration_s)
    warnings.push_back("output.platform_interval_s: the run has no sample of the platform before its end (value " +
                       plain_number_text(s.output.platform_interval_s) + ", the run lasts " +
                       plain_number_text(s.run.duration_s) + " s); give less");
}

}  // namespace gem
