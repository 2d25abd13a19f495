// The time step against floes, mooring and the length of the run.
#include <algorithm>
#include <cmath>
#include <string>

#include "gem/base/number_text.h"
#include "gem/scene/checks/checks.h"
#include "gem/scene/checks/limit_text.h"
#include "gem/scene/scene_bounds.h"
#include "gem/scene/scene_mooring.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

// Share of the smallest floe that two bodies may close in a time step, in which contacts keep their normals. Windows of
// a plug and a jam were measured with it (40 cm of drift, floes of 2 m), and a floe that turns by 0.25 rad (H8).
constexpr double path_fraction = 0.2;
// The mooring force is split around the contact step. The split is accurate while omega dt is small.
constexpr double mooring_phase_maximum = 0.2;
constexpr double steps_maximum = 1e10;
// Share of a force window by which whole time steps may miss it without a word. Chosen by hand.
constexpr double window_error = 0.1;

/// How far bodies close in a time step, and how far they overlap before their contact is seen.
void check_path(const SceneDef& s, SceneProblems& out) {
  const double dt = s.numerics.time_step_s;
  const double width = smallest_floe_width(s), speed = closing_speed_bound(s);
  if (!std::isfinite(width) || !(speed > 0.0)) return;
  const double by_overlap = longest_unseen_step(s, speed_foreseen(s));
  const double by_path = path_fraction * width / speed;
  if (dt <= std::min(by_overlap, by_path)) return;
  const char* const what = by_overlap < by_path ? "overlap by more than a tenth" : "close by more than a fifth";
  out.push_back({"numerics.time_step_s", "the time step is too long for the smallest floe (value " +
                                             plain_number_text(dt) + ", allowed at most " +
                                             limit_text(std::min(by_overlap, by_path)) + " s: bodies closing at " +
                                             number_text(speed, 4) + " m/s would " + what + " of " +
                                             number_text(width, 4) + " m); give a smaller time step"});
}

void check_step(const SceneDef& s, SceneProblems& out) {
  if (!mooring_is_sound(s)) return;
  const double dt = s.numerics.time_step_s;
  check_path(s, out);
  const double steps = s.run.duration_s / dt;
  if (steps > steps_maximum)
    out.push_back({"run.duration_s", "too many time steps (value " + plain_number_text(s.run.duration_s) +
                                         ", allowed at most " + plain_number_text(steps_maximum * dt) +
                                         " s with this time step)"});
}

void check_swing(const SceneDef& s, SceneProblems& out) {
  if (!s.platform.present || s.platform.fixed || !mooring_is_sound(s)) return;
  const double omega = std::sqrt(largest_mooring_stiffness(s) / s.platform.mass_kg);
  if (omega * s.numerics.time_step_s > mooring_phase_maximum)
    out.push_back({"numerics.time_step_s", "the time step is too long for the mooring (value " +
                                               plain_number_text(s.numerics.time_step_s) + ", allowed at most " +
                                               limit_text(mooring_phase_maximum / omega) +
                                               " s: omega dt <= " + plain_number_text(mooring_phase_maximum) +
                                               "); give a smaller time step or check stiffness and mass"});
}

}  // namespace

void check_time_step(const SceneDef& s, SceneProblems& out) {
  check_step(s, out);
  check_swing(s, out);
}

void warn_of_time_step(const SceneDef& scene, SceneWarnings& warnings) {
  const double step = scene.numerics.time_step_s;
  const auto whole = [step](double time) { return std::abs(std::remainder(time, step)) <= 1e-9 * time; };
  const double ends = step * std::round(scene.run.duration_s / step);
  if (!whole(scene.run.duration_s))
    warnings.push_back("run.duration_s: not a whole number of time steps (value " +
                       plain_number_text(scene.run.duration_s) + "); the run ends at " + number_text(ends, 9) + " s");
  if (scene.platform.present && !whole(scene.output.platform_interval_s))
    warnings.push_back("output.platform_interval_s: not a whole number of time steps (value " +
                       plain_number_text(scene.output.platform_interval_s) +
                       "); samples will be uneven, and gem analyse and gem report need even ones; a time step is " +
                       plain_number_text(step) + " s");
  const double window = step * std::max(1.0, std::round(scene.output.force_window_s / step));
  if (scene.platform.present && std::abs(window / scene.output.force_window_s - 1.0) > window_error)
    warnings.push_back("output.force_window_s: not a whole number of time steps (value " +
                       plain_number_text(scene.output.force_window_s) + "); forces are means over " +
                       number_text(window, 9) + " s");
}

}  // namespace gem
