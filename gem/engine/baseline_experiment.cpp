// Settings of a baseline by name, for experiments that turn one at a time.
#include <cmath>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/engine/engine.h"

namespace gem {
namespace {

Error fault(const std::string& text) {
  return Error(ExitCode::usage, "no experiment '" + text + "' (not a key and a number) give one of " +
                                    experiment_keys() + " as KEY=VALUE; switches are 0 or 1");
}

}  // namespace

std::string experiment_keys() {
  return "substeps, warm_starting, continuous, mixes_friction, restitution_threshold_m_per_s";
}

void set_experiment(BaselineOptions& options, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw fault(text);
  const std::string key = text.substr(0, equals);
  const auto value = parse_number(text.substr(equals + 1));
  if (!value || !std::isfinite(*value)) throw fault(text);
  const auto chosen = [&] {
    if (*value != 0.0 && *value != 1.0) throw fault(text);
    return *value == 1.0;
  };
  if (key == "substeps") {
    if (!(*value >= 1.0 && *value <= 1000.0 && *value == std::floor(*value))) throw fault(text);
    options.substeps = static_cast<int>(*value);
  } else if (key == "warm_starting") {
    options.warm_starting = chosen();
  } else if (key == "continuous") {
    options.continuous = chosen();
  } else if (key == "mixes_friction") {
    options.mixes_friction = chosen();
  } else if (key == "restitution_threshold_m_per_s") {
    options.restitution_threshold_m_per_s = *value;
  } else {
    throw fault(text);
  }
}

}  // namespace gem
