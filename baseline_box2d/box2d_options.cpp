// Reads the settings of the engine by name.
#include "baseline_box2d/box2d_options.h"

#include <cmath>

#include "gem/base/error.h"
#include "gem/base/number_text.h"

namespace gem::baseline {
namespace {

constexpr int kMostIterations = 1000000;
constexpr int kMostSubsteps = 1000;

Error fault(const std::string& text, const std::string& reason) {
  std::string keys;
  for (const BaselineSetting& setting : box2d_settings()) keys += (keys.empty() ? "" : ", ") + setting.key;
  return Error(ExitCode::usage, "cannot set '" + text + "' of box2d (" + reason + "); give KEY=VALUE with one of " +
                                    keys + "; switches are 0 or 1");
}

/// One setting and the values it may have.
class Setting {
 public:
  explicit Setting(const std::string& text) : text_(text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) throw fault(text, "not a key and a number");
    key_ = text.substr(0, equals);
    const auto value = parse_number(text.substr(equals + 1));
    if (!value || !std::isfinite(*value)) throw fault(text, "not a key and a number");
    value_ = *value;
  }
  const std::string& key() const { return key_; }
  int count(int least, int most) const {
    if (!(value_ >= least && value_ <= most && value_ == std::floor(value_)))
      throw fault(text_, "no whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return static_cast<int>(value_);
  }
  bool on() const {
    if (value_ != 0.0 && value_ != 1.0) throw fault(text_, "neither 0 nor 1");
    return value_ == 1.0;
  }
  double not_negative() const {
    if (!(value_ >= 0.0)) throw fault(text_, "below 0");
    return value_;
  }

 private:
  std::string text_, key_;
  double value_ = 0.0;
};

void set(Box2dOptions& options, const std::string& text) {
  const Setting setting(text);
  const std::string& key = setting.key();
  if (key == "velocity_iterations") {
    options.velocity_iterations = setting.count(1, kMostIterations);
  } else if (key == "position_iterations") {
    options.position_iterations = setting.count(0, kMostIterations);
  } else if (key == "skin_m") {
    options.skin_m = setting.not_negative();
  } else if (key == "measures_quality") {
    options.measures_quality = setting.on();
  } else if (key == "substeps") {
    options.substeps = setting.count(1, kMostSubsteps);
  } else if (key == "warm_starting") {
    options.warm_starting = setting.on();
  } else if (key == "continuous") {
    options.continuous = setting.on();
  } else if (key == "mixes_friction") {
    options.mixes_friction = setting.on();
  } else if (key == "restitution_threshold_m_per_s") {
    options.restitution_threshold_m_per_s = setting.not_negative();
  } else {
    throw fault(text, "an unknown key");
  }
}

}  // namespace

Box2dOptions box2d_options(const std::vector<std::string>& settings) {
  Box2dOptions options;
  for (const std::string& text : settings) set(options, text);
  return options;
}

std::vector<BaselineSetting> box2d_settings() {
  const Box2dOptions preset;
  return {
      {"velocity_iterations", "--velocity-iterations", std::to_string(preset.velocity_iterations), "of box2d's solver"},
      {"position_iterations", "--position-iterations", std::to_string(preset.position_iterations), "of box2d's solver"},
      {"skin_m", "--skin", number_text(preset.skin_m), "radius round box2d's outlines [m]"},
      {"substeps", "", "1", "steps in one time step"},
      {"warm_starting", "", "1", "from the impulses of the last step"},
      {"continuous", "", "0", "floes are stopped at the first touch within a step"},
      {"mixes_friction", "", "0", "the root of the product of the two bodies' coefficients"},
      {"restitution_threshold_m_per_s", "", "0", "slower hits do not rebound"}};
}

}  // namespace gem::baseline
