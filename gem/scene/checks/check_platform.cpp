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

void check_place(const SceneDef& s, List& out) {
  const PlatformReach reach = platform_reach(s.platform);
  const Vec2 place = s.platform.anchor_m + s.platform.start_offset_m;
  const double half_gap = std::abs(place.y) + reach.sideways;
  if (s.boundary.present && 0.5 * s.boundary.gap_m < half_gap)
    out.push_back({"boundary.gap_m", "the platform does not fit between the boundaries (value " +
                                         plain_number_text(s.boundary.gap_m) + ", allowed at least " +
                                         plain_number_text(2.0 * half_gap) + " m)"});
  const double stern = place.x + reach.downstream;
  if (s.output.retire_x_m < stern)
    out.push_back({"output.retire_x_m", "floes would be retired before they pass the platform (value " +
                                            plain_number_text(s.output.retire_x_m) + ", allowed at least " +
                                            plain_number_text(stern) + " m)"});
}

void check_shape(const SceneDef& s, List& out) {
  const PlatformDef& p = s.platform;
  if (p.outline == PlatformOutline::listed && p.outline_m.empty())
    out.push_back(
        {"platform.outline_m", "missing (platform.outline = \"listed\"); give the corners [[x, y], ...] in m"});
  if (p.outline == PlatformOutline::pieces && p.piece.empty())
    out.push_back(
        {"platform.piece",
         "missing (platform.outline = \"pieces\"); give the pieces as [[platform.piece]] with outline_m = [[x, "
         "y], ...] in m"});
  if (p.piece.size() > platform_pieces_maximum)
    out.push_back({"platform.piece", "too many pieces (value " + std::to_string(p.piece.size()) + ", allowed at most " +
                                         std::to_string(platform_pieces_maximum) + "); make them larger"});
  const double ends = p.bow_length_m + p.stern_length_m;
  if (p.outline == PlatformOutline::ship && ends > p.length_m)
    out.push_back({"platform.length_m", "the ship is shorter than its bow and stern (value " +
                                            plain_number_text(p.length_m) + ", allowed at least " +
                                            plain_number_text(ends) +
                                            " m: platform.bow_length_m + platform.stern_length_m); make it longer, or "
                                            "bow or stern shorter"});
}

// Half the heading control acts before the contacts and half after them. That is accurate while omega dt is small.
constexpr double heading_phase_maximum = 0.2;

void check_heading(const SceneDef& s, List& out) {
  const double inertia = platform_inertia(s.platform);
  if (!(inertia > 0.0) || s.platform.fixed || s.platform.yaw == Yaw::locked) return;
  const double omega = std::sqrt(s.heading.moment_N_m / inertia);
  if (omega * s.numerics.time_step_s > heading_phase_maximum)
    out.push_back({"heading.moment_N_m",
                   "the time step is too long for the heading control (value " +
                       plain_number_text(s.heading.moment_N_m) + ", allowed at most " +
                       number_text(inertia * std::pow(heading_phase_maximum / s.numerics.time_step_s, 2), 4) +
                       " N m: dt sqrt(moment / inertia) <= " + plain_number_text(heading_phase_maximum) +
                       "); give a smaller moment or a smaller time step"});
}

/// Added mass that no water can have, or that another key excludes.
void check_added_mass(const SceneDef& s, List& out) {
  const AddedMassDef& a = s.added_mass;
  if (!added_mass(a, 1.0, 1.0, false).present) return;
  const double limit = std::sqrt(a.sway_kg * a.yaw_kg_m2);
  if (std::abs(a.sway_yaw_kg_m) > limit)
    out.push_back({"added_mass.sway_yaw_kg_m", "the matrix of the added mass is not positive (value " +
                                                   plain_number_text(a.sway_yaw_kg_m) + ", allowed up to " +
                                                   number_text(limit, 4) +
                                                   " kg m: the root of sway_kg x yaw_kg_m2); give less of it"});
  if (s.mooring.law == MooringLaw::linear && s.mooring.damping_ratio > 0.0)
    out.push_back({"mooring.damping_ratio", "has no meaning with a mass that depends on the direction (value " +
                                                plain_number_text(s.mooring.damping_ratio) +
                                                ", allowed 0 with [added_mass]); give mooring.damping_N_s_per_m"});
  if (in_transit(s.transit))
    out.push_back({"added_mass.surge_kg", "the path of a ship in transit gives its motion (value " +
                                              plain_number_text(a.surge_kg) +
                                              ", allowed without [transit]); remove [added_mass]"});
}

/// A fixed platform neither moves at the start nor turns.
void check_fixed(const SceneDef& s, List& out) {
  const PlatformDef& p = s.platform;
  if (!p.fixed) return;
  const auto refuse = [&](const char* key, const std::string& value) {
    out.push_back({key, "a fixed platform does not move (value " + value +
                            ", allowed 0 with platform.fixed = true); set "
                            "it to 0, or platform.fixed to false"});
  };
  if (length(p.start_velocity_m_per_s) > 0.0)
    refuse("platform.start_velocity_m_per_s", pair_text(p.start_velocity_m_per_s));
  if (p.start_spin_rad_per_s != 0.0) refuse("platform.start_spin_rad_per_s", plain_number_text(p.start_spin_rad_per_s));
}

}  // namespace

void check_platform(const SceneDef& scene, List& problems) {
  if (!scene.platform.present) return;
  for (const auto rule : {check_place, check_shape, check_heading, check_added_mass, check_fixed})
    rule(scene, problems);
}

namespace {

/// Keys of outlines other than the one of the case.
void warn_of_shape(const PlatformDef& p, std::vector<std::string>& warnings) {
  const PlatformDef usual;
  const auto unused = [&](const char* key, bool is_given, PlatformOutline outline, const char* name) {
    if (is_given && p.outline != outline)
      warnings.push_back(std::string("platform.") + key + ": has no effect (it counts only with platform.outline = \"" +
                         name + "\"); remove it, or change the outline");
  };
  unused("sides", p.sides != usual.sides, PlatformOutline::regular, "regular");
  unused("diameter_m", p.diameter_m != usual.diameter_m, PlatformOutline::regular, "regular");
  unused("length_m", p.length_m != usual.length_m, PlatformOutline::ship, "ship");
  unused("beam_m", p.beam_m != usual.beam_m, PlatformOutline::ship, "ship");
  unused("bow_length_m", p.bow_length_m != usual.bow_length_m, PlatformOutline::ship, "ship");
  unused("stern_length_m", p.stern_length_m != usual.stern_length_m, PlatformOutline::ship, "ship");
  unused("outline_m", !p.outline_m.empty(), PlatformOutline::listed, "listed");
  unused("piece", !p.piece.empty(), PlatformOutline::pieces, "pieces");
  if (p.inertia_kg_m2 > 0.0 && (p.fixed || p.yaw == Yaw::locked))
    warnings.push_back("platform.inertia_kg_m2: has no effect (the platform cannot turn); remove it");
}

void warn_of_pieces(const SceneDef& scene, std::vector<std::string>& warnings) {
  const PlatformDef& p = scene.platform;
  if (p.outline == PlatformOutline::pieces && p.piece.size() > 1 && scene.contact.solver == ContactSolver::independent)
    warnings.push_back(
        "platform.piece: a floe that touches two pieces at once is struck by each (contact.solver = \"independent\" "
        "answers every pair alone); set contact.solver = \"coupled\" or \"compliant\"");
}

void warn_of_heading(const SceneDef& scene, std::vector<std::string>& warnings) {
  const HeadingDef& heading = scene.heading;
  const bool given = heading.moment_N_m > 0.0 || heading.damping_N_m_s > 0.0;
  if (given && (scene.platform.fixed || scene.platform.yaw == Yaw::locked))
    warnings.push_back("heading.moment_N_m: has no effect (the platform cannot turn); set platform.yaw = \"free\"");
  if (heading.moment_N_m > 0.0 && heading.damping_N_m_s == 0.0)
    warnings.push_back(
        "heading.damping_N_m_s: none, so the platform swings about its heading without end; 2 sqrt(moment x inertia) "
        "is critical damping");
}

/// Keys of a drag that is switched off.
void warn_of_drag_switched_off(const SceneDef& scene, std::vector<std::string>& warnings) {
  for (const auto& option : scene_options())
    if (option.path.starts_with("platform_drag.") &&
        value_text(option.get(scene)) != value_text(option.get(SceneDef{})))
      warnings.push_back(option.path +
                         ": has no effect (platform_drag.present is false); set platform_drag.present = true");
}

void warn_of_drag(const SceneDef& scene, std::vector<std::string>& warnings) {
  const PlatformDragDef &drag = scene.platform_drag, usual;
  if (!drag.present) return warn_of_drag_switched_off(scene, warnings);
  if (scene.platform.fixed) {
    warnings.push_back(
        "platform_drag.present: has no effect (the platform is fixed); set platform_drag.present = false");
    return;
  }
  if (const double current = largest_current(scene); drag.water == DampingWater::still && current > 0.0)
    warnings.push_back("platform_drag.water: still water in a current (of up to " + number_text(current, 4) +
                       " m/s, which drives the ice and not the platform); set platform_drag.water = \"current\" if it "
                       "pushes the platform too");
  if (drag.law == PlatformDragLaw::by_axis && drag.yaw_coefficient != usual.yaw_coefficient &&
      scene.platform.yaw == Yaw::locked)
    warnings.push_back("platform_drag.yaw_coefficient: has no effect (the platform cannot turn); remove it");
}

void warn_of_added_mass(const SceneDef& scene, std::vector<std::string>& warnings) {
  const AddedMassDef& a = scene.added_mass;
  const bool turns = scene.platform.yaw == Yaw::free && platform_inertia(scene.platform) > 0.0;
  if (scene.platform.fixed && added_mass(a, 1.0, 1.0, false).present)
    warnings.push_back("added_mass.surge_kg: has no effect (the platform is fixed); remove [added_mass]");
  else if (!turns && (a.yaw_kg_m2 > 0.0 || a.sway_yaw_kg_m != 0.0))
    warnings.push_back("added_mass.yaw_kg_m2: has no effect (the platform cannot turn); set platform.yaw = \"free\"");
}

void warn_of_mass(const SceneDef& scene, std::vector<std::string>& warnings) {
  const double draught = scene.platform.mass_kg / (platform_area(scene.platform) * scene.water.density_kg_per_m3);
  if (draught >= 0.1 && draught <= 200.0) return;
  const bool regular = scene.platform.outline == PlatformOutline::regular;
  warnings.push_back(std::string("platform.mass_kg: unlikely for this ") + (regular ? "diameter" : "outline") +
                     " (value " + plain_number_text(scene.platform.mass_kg) + ", it would float " +
                     number_text(draught, 4) + " m deep); give it in kg");
}

/// No mass is farther from the centre than the outline, and a hull is not all in its middle.
void warn_of_inertia(const PlatformDef& p, double area, std::vector<std::string>& warnings) {
  if (!(p.inertia_kg_m2 > 0.0)) return;
  const double radius = std::sqrt(p.inertia_kg_m2 / p.mass_kg), farthest = platform_radius(p);
  if (radius <= farthest && radius >= 0.2 * std::sqrt(area)) return;
  warnings.push_back("platform.inertia_kg_m2: unlikely for this outline (value " + plain_number_text(p.inertia_kg_m2) +
                     ", its radius of gyration would be " + number_text(radius, 4) + " m, the outline reaches " +
                     number_text(farthest, 4) + " m); give it in kg m2");
}

}  // namespace

void warn_of_platform(const SceneDef& scene, std::vector<std::string>& warnings) {
  if (!scene.platform.present) return;
  warn_of_shape(scene.platform, warnings);
  warn_of_pieces(scene, warnings);
  warn_of_heading(scene, warnings);
  warn_of_drag(scene, warnings);
  warn_of_added_mass(scene, warnings);
  if (!scene.platform.fixed) warn_of_mass(scene, warnings);
  warn_of_inertia(scene.platform, platform_area(scene.platform), warnings);
}

}  // namespace gem
