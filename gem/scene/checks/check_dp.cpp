// Each rule is one small function that compares a few options and may add a problem.
#include "gem/scene/checks/checks.h"

#include <cmath>

#include "gem/base/number_text.h"
#include "gem/scene/platform_shape.h"
#include "gem/scene/scene_drive.h"
#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

using List = std::vector<SceneProblem>;

std::string dp_digits(double value) { return number_text(value, 4); }

constexpr const char* dp_axes[] = {"surge", "sway", "yaw"};

void check_platform_moves(const SceneDef& s, List& out) {
  const PlatformDef& p = s.platform;
  if (p.present && !p.fixed && p.yaw == Yaw::free) return;
  const char* key = !p.present ? "platform.present" : p.fixed ? "platform.fixed" : "platform.yaw";
  const char* value = !p.present ? "false" : p.fixed ? "true" : "\"locked\"";
  out.push_back({key, std::string("thrusters need a platform that moves and turns (value ") + value +
                          "); set it otherwise, or remove [[dp.thruster]]"});
}

void check_thruster_number(const SceneDef& s, List& out) {
  if (s.dp.thruster.size() > thrusters_maximum)
    out.push_back({"dp.thruster", "too many thrusters (value " + std::to_string(s.dp.thruster.size()) +
                                      ", allowed at most " + std::to_string(thrusters_maximum) +
                                      "); give one of the same force for some that stand together"});
}

void check_gain_rows(const SceneDef& s, List& out) {
  if (!s.dp.gains.empty() && s.dp.gains.size() != 3)
    out.push_back({"dp.gain_table", "wrong number of rows (value " + std::to_string(s.dp.gains.size()) +
                                        ", allowed 3); give a row each for surge, sway and yaw"});
}

/// One heading control is enough.
void check_one_control(const SceneDef& s, List& out) {
  if (s.heading.moment_N_m > 0.0 || s.heading.damping_N_m_s > 0.0)
    out.push_back({"heading.moment_N_m",
                   "the yaw has two controls (heading and dp); remove [heading]; dp.follows_drift = true turns the bow "
                   "against the drift"});
}

/// Which of surge, sway and yaw no thruster can push.
void check_thruster_directions(const SceneDef& s, List& out) {
  const DpLaw law = dp_law(s.dp, dp_inertia(s.platform.mass_kg, 1.0, {}), s.numerics.time_step_s);
  DpMatrix g;
  for (std::int32_t i = 0; i < law.thrusters; ++i) dp_add(g, law.thruster[i], law.arm);
  const ShipForce one[] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  for (int k = 0; k < 3; ++k) {
    const ShipForce x = dp_solve(g, one[k]);
    const ShipForce back{g.xx * x.surge + g.yx * x.sway + g.nx * x.yaw, g.yx * x.surge + g.yy * x.sway + g.ny * x.yaw,
                         g.nx * x.surge + g.ny * x.sway + g.nn * x.yaw};
    constexpr double rounding = 1e-3;
    if (std::abs(back.surge - one[k].surge) + std::abs(back.sway - one[k].sway) + std::abs(back.yaw - one[k].yaw) <
        rounding)
      continue;
    out.push_back(
        {"dp.thruster", std::string("the thrusters cannot push the ") + dp_axes[k] +
                            " by itself (their places and directions leave it out); add one, or move one away "
                            "from the centre"});
    return;
  }
}

/// A gain that makes the control unstable, by the criterion of Routh and Hurwitz for
/// tau m s^4 + m s^3 + K_d s^2 + K_p s + K_i. The thrust is held through a time step, which delays by half of it.
void check_dp_stability(const SceneDef& s, int k, const DpGain& gain, double inertia, List& out) {
  if (gain.proportional == 0.0 && gain.derivative == 0.0 && gain.integral == 0.0) return;
  const bool given = !s.dp.gains.empty();
  const double lag = s.dp.filter_time_s + 0.5 * s.numerics.time_step_s;
  const double damped = gain.derivative - lag * gain.proportional;
  if (!(damped > 0.0) && gain.proportional > 0.0)
    out.push_back({given                      ? "dp.gain_table"
                   : s.dp.filter_time_s > 0.0 ? "dp.filter_time_s"
                                              : "dp.damping_ratio",
                   std::string("the control of the ") + dp_axes[k] + " is unstable (a lag of " + dp_digits(lag) +
                       " s by filter and time step, allowed below " + dp_digits(gain.derivative / gain.proportional) +
                       " s: derivative over proportional gain); give a shorter filter, more damping or a longer "
                       "period"});
  else if (gain.integral > 0.0 && !(gain.proportional * damped > inertia * gain.integral))
    out.push_back({given ? "dp.gain_table" : "dp.integral_time_s",
                   std::string("the control of the ") + dp_axes[k] + " is unstable (the integral time is " +
                       dp_digits(gain.proportional / gain.integral) + " s, allowed above " +
                       dp_digits(inertia / damped) + " s); give a longer one"});
}

void check_dp_step(const SceneDef& s, int k, const DpGain& gain, double inertia, List& out) {
  constexpr double phase_maximum = 0.2;  // as for a mooring
  const double omega = std::sqrt(gain.proportional / inertia);
  if (omega * s.numerics.time_step_s > phase_maximum)
    out.push_back({"numerics.time_step_s", std::string("the time step is too long for the control of the ") +
                                               dp_axes[k] + " (value " + dp_digits(s.numerics.time_step_s) +
                                               ", allowed at most " + dp_digits(phase_maximum / omega) +
                                               " s); give a smaller time step or a longer period"});
}

/// A damping that turns the speed round within a time step.
void check_dp_damping(const SceneDef& s, int k, const DpGain& gain, double inertia, List& out) {
  const double dt = s.numerics.time_step_s;
  if (gain.derivative * dt <= inertia) return;
  out.push_back({"numerics.time_step_s", std::string("the time step is too long for the damping of the ") + dp_axes[k] +
                                             " (value " + dp_digits(dt) + ", allowed at most " +
                                             dp_digits(inertia / gain.derivative) +
                                             " s: derivative gain x time step up to the mass or the moment of inertia) "
                                             "give a smaller time step or less damping"});
}

void check_dp_gains(const SceneDef& s, List& out) {
  if (!s.platform.present || (!s.dp.gains.empty() && s.dp.gains.size() != 3)) return;
  const double inertia = platform_inertia(s.platform);
  if (!(inertia > 0.0)) return;
  const DpInertia moved = dp_inertia(s.platform.mass_kg, inertia, s.added_mass);
  const std::array<DpGain, 3> gains = dp_gains(s.dp, moved);
  for (int k = 0; k < 3; ++k) {
    check_dp_stability(s, k, gains[k], moved[k], out);
    check_dp_step(s, k, gains[k], moved[k], out);
    check_dp_damping(s, k, gains[k], moved[k], out);
  }
}

}  // namespace

void check_dp(const SceneDef& scene, List& problems) {
  if (scene.dp.thruster.empty()) return;
  for (const auto rule : {check_platform_moves, check_thruster_number, check_gain_rows, check_one_control,
                          check_thruster_directions, check_dp_gains})
    rule(scene, problems);
}

void warn_of_dp(const SceneDef& scene, std::vector<std::string>& warnings) {
  const SceneDef usual;
  const bool on = !scene.dp.thruster.empty(), table = !scene.dp.gains.empty();
  for (const auto& option : scene_options()) {
    if (!option.path.starts_with("dp.") || value_text(option.get(scene)) == value_text(option.get(usual))) continue;
    const bool of_gains =
        option.path.ends_with("_period_s") || option.path == "dp.damping_ratio" || option.path == "dp.integral_time_s";
    if (!on) warnings.push_back(option.path + ": has no effect (there is no [[dp.thruster]]); add thrusters");
    if (on && table && of_gains)
      warnings.push_back(option.path + ": has no effect (dp.gain_table gives the gains); remove it");
  }
  if (!on) return;
  if (scene.mooring.law == MooringLaw::linear && scene.mooring.stiffness_N_per_m == usual.mooring.stiffness_N_per_m)
    warnings.push_back(
        "mooring.stiffness_N_per_m: the default mooring holds the platform beside its thrusters; 0 for "
        "thrusters alone");
  if (scene.dp.follows_drift && largest_current(scene) == 0.0)
    warnings.push_back("dp.follows_drift: has no effect (there is no current); remove it");
}

}  // namespace gem
