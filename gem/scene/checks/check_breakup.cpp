// Splits of floes.
#include "gem/scene/checks/checks.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {

void check_breakup(const SceneDef& s, SceneProblems& out) {
  const double least = 2.0 * s.numerics.time_step_s;
  if (s.breakup.maximum_pieces > 0 && s.breakup.load_time_s < least)
    out.push_back({"breakup.load_time_s", "shorter than two time steps (value " +
                                              plain_number_text(s.breakup.load_time_s) + ", allowed from " +
                                              plain_number_text(least) +
                                              " s on); raise it, or take a smaller numerics.time_step_s"});
}

}  // namespace gem
