// Each rule is one small function that compares a few options and may add a problem.
#include "gem/scene/checks/checks.h"

#include <cmath>

#include "gem/base/number_text.h"
#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

using List = std::vector<SceneProblem>;

void check_ship_moves(const SceneDef& s, List& out) {
  const PlatformDef& p = s.platform;
  if (!p.present || p.fixed)
    out.push_back({p.present ? "platform.fixed" : "platform.present",
                   std::string("a transit needs a platform that moves (value ") + (p.present ? "true" : "false") +
                       "); set it otherwise, or remove [transit]"});
  else if (s.transit.way_point_m.size() > 1 && p.yaw == Yaw::locked && !runs_free(s.transit))
    out.push_back({"platform.yaw",
                   "the ship turns at its way points (value \"locked\", allowed \"free\"); set it "
                   "otherwise, or give one way point"});
}

/// The path gives the velocity at the start.
void check_ship_start(const SceneDef& s, List& out) {
  const PlatformDef& p = s.platform;
  const auto refuse = [&](const char* key, const std::string& value) {
    out.push_back({key, "the path gives the motion at the start (value " + value +
                            ", allowed 0 with [transit]); remove it, and give transit.speed_m_per_s"});
  };
  if (length(p.start_velocity_m_per_s) > 0.0)
    refuse("platform.start_velocity_m_per_s", pair_text(p.start_velocity_m_per_s));
  if (p.start_spin_rad_per_s != 0.0) refuse("platform.start_spin_rad_per_s", plain_number_text(p.start_spin_rad_per_s));
}

/// A ship with thrust runs free on a straight path; its net thrust is what the water leaves.
void check_thrust(const SceneDef& s, List& out) {
  const TransitDef& transit = s.transit;
  if (!runs_free(transit)) return;
  if (!(transit.open_water_speed_m_per_s > 0.0))
    out.push_back({"transit.open_water_speed_m_per_s",
                   "a ship with thrust needs its speed in open water (value 0, allowed above 0); give it, or remove "
                   "transit.bollard_thrust_N and give transit.speed_m_per_s"});
  if (transit.way_point_m.size() > 1)
    out.push_back({"transit.way_point_table",
                   "a ship with thrust keeps to a straight path (value " + std::to_string(transit.way_point_m.size()) +
                       " way points, allowed 1); give one, or remove transit.bollard_thrust_N"});
  if (s.platform_drag.present)
    out.push_back({"platform_drag.present",
                   "the thrust of a ship in transit is what the resistance of the water leaves (value true, allowed "
                   "false with transit.bollard_thrust_N); set it to false"});
}

/// A ship on its way has neither mooring nor thrusters nor heading control.
void check_free_of_holds(const SceneDef& s, List& out) {
  const auto refuse = [&](const char* key, const std::string& value, const char* advice) {
    out.push_back({key, "a ship in transit is held by its tow alone (value " + value + ") " + advice});
  };
  if (s.mooring.law != MooringLaw::linear) refuse("mooring.law", "not \"linear\"", "remove the mooring");
  if (s.mooring.law == MooringLaw::linear && s.mooring.stiffness_N_per_m > 0.0)
    refuse("mooring.stiffness_N_per_m", plain_number_text(s.mooring.stiffness_N_per_m), "set it to 0");
  if (s.mooring.yaw_stiffness_N_m_per_rad > 0.0)
    refuse("mooring.yaw_stiffness_N_m_per_rad", plain_number_text(s.mooring.yaw_stiffness_N_m_per_rad), "set it to 0");
  if (!s.dp.thruster.empty()) refuse("dp.thruster", std::to_string(s.dp.thruster.size()) + " thrusters", "remove [dp]");
  if (s.heading.moment_N_m > 0.0 || s.heading.damping_N_m_s > 0.0)
    refuse("heading.moment_N_m", plain_number_text(s.heading.moment_N_m), "remove [heading]");
}

void check_legs(const SceneDef& s, List& out) {
  const std::vector<double> rests = straight_rests(s.transit, s.platform.anchor_m + s.platform.start_offset_m);
  for (std::size_t k = 0; k < rests.size(); ++k) {
    if (rests[k] >= 0.0) continue;
    out.push_back({"transit.way_point_table",
                   "the arcs do not fit on the way to way point " + std::to_string(k) + " (" +
                       (std::isfinite(rests[k]) ? "they need " + number_text(-rests[k], 4) + " m more"
                                                : "it lies on the place before it, or the ship turns back there") +
                       "); move it, or give a smaller transit.turn_radius_m"});
    return;
  }
}

}  // namespace

void check_transit(const SceneDef& scene, List& problems) {
  if (!in_transit(scene.transit)) return;
  for (const auto rule : {check_ship_moves, check_ship_start, check_thrust, check_free_of_holds, check_legs})
    rule(scene, problems);
}

void warn_of_transit(const SceneDef& scene, std::vector<std::string>& warnings) {
  const TransitDef& transit = scene.transit;
  const SceneDef usual;
  const bool on = in_transit(transit);
  for (const auto& option : scene_options())
    if (!on && option.path.starts_with("transit.") && value_text(option.get(scene)) != value_text(option.get(usual)))
      warnings.push_back(option.path +
                         ": has no effect (there is no transit); give transit.speed_m_per_s or "
                         "transit.bollard_thrust_N");
  if (!on) return;
  if (!runs_free(transit) && transit.open_water_speed_m_per_s > 0.0)
    warnings.push_back(
        "transit.open_water_speed_m_per_s: has no effect (the ship is towed); give transit.bollard_thrust_N");
  if (!transit.way_point_m.empty() && transit.course_rad != usual.transit.course_rad)
    warnings.push_back("transit.course_rad: has no effect (the way points give the course); remove it");
  if (transit.way_point_m.size() < 2 && transit.turn_radius_m != usual.transit.turn_radius_m)
    warnings.push_back("transit.turn_radius_m: has no effect (the path is straight); remove it");
}

}  // namespace gem
