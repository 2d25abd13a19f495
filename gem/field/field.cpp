// Makes the field of a scene: platform, sides, obstacles, floes, drag.
#include "gem/field/field.h"

#include <algorithm>
#include <utility>

#include "gem/base/error.h"
#include "gem/base/strict_math.h"
#include "gem/field/channel.h"
#include "gem/field/check_field.h"
#include "gem/field/check_outline.h"
#include "gem/field/drag_coefficients.h"
#include "gem/field/files/floe_file.h"
#include "gem/field/floe_reserve.h"
#include "gem/field/generator/floe_set.h"
#include "gem/field/generator/generator.h"
#include "gem/field/platform_pieces.h"
#include "gem/geometry/polygon.h"
#include "gem/scene/check_scene.h"
#include "gem/scene/platform_shape.h"
#include "gem/scene/scene_drive.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

/// Height of sides and obstacles, above any ice [m].
constexpr double fixed_height = 20.0;

std::uint8_t class_of_thickness(const std::vector<IceClassDef>& classes, double thickness) {
  for (std::size_t c = 0; c < classes.size(); ++c)
    if (classes[c].thickness_m == thickness) return static_cast<std::uint8_t>(c);
  return 0;
}

/// A listed outline as it is given, so that messages name its corners; a ship may have sides that are too short.
void check_platform_outline(const PlatformDef& platform) {
  const OutlineRule rule = {platform_corners_maximum,
                            "give a convex outline, or convex pieces: platform.outline = \"pieces\""};
  if (platform.outline == PlatformOutline::listed) check_outline(platform.outline_m, "platform.outline_m", rule);
  if (platform.outline == PlatformOutline::ship) check_outline(platform_outline(platform), "platform (ship)", rule);
  if (platform.outline == PlatformOutline::pieces) check_platform_pieces(platform);
}

void append_platform(Bodies& bodies, const SceneDef& scene) {
  BodyDef def;
  def.kind = BodyKind::platform;
  def.thickness = scene.platform_drag.draft_m;
  if (scene.platform.present) {
    check_platform_outline(scene.platform);
    def.outline = platform_outline(scene.platform);
    def.origin = scene.platform.anchor_m + scene.platform.start_offset_m;
    def.rotation = strict::rotation_of_angle(scene.platform.start_yaw_rad);
    def.velocity = scene.platform.start_velocity_m_per_s;
    def.spin = scene.platform.start_spin_rad_per_s;
    if (const TransitPath path = transit_path(scene); path.present())
      def.velocity = path.start_velocity(scene.numerics.time_step_s);
    def.mass = scene.platform.mass_kg;
    def.inertia = scene.platform.inertia_kg_m2;
    def.locked_yaw = scene.platform.yaw == Yaw::locked;
    def.immovable = scene.platform.fixed;
  }
  if (scene.platform.present && scene.platform.outline == PlatformOutline::pieces)
    append_pieces(bodies, def, platform_pieces(scene.platform));
  else
    append(bodies, def);
}

void append_fixed(Bodies& bodies, const SceneDef& scene) {
  std::vector<std::vector<Vec2>> outlines = boundary_outlines(scene.boundary);
  for (std::size_t i = 0; i < scene.fixed.size(); ++i)
    outlines.push_back(check_outline(scene.fixed[i].outline_m, "fixed " + std::to_string(i)).outline);
  for (const auto& outline : outlines) {
    BodyDef def;
    def.kind = BodyKind::fixed;
    def.outline = outline;
    def.thickness = fixed_height;
    append(bodies, def);
  }
}

void append_floes(Bodies& bodies, const SceneDef& scene, const std::vector<FloeDef>& floes) {
  std::vector<BodyDef> defs;
  std::vector<double> areas;
  for (std::size_t i = 0; i < floes.size(); ++i) {
    BodyDef def;
    def.outline = check_outline(floes[i].outline_m, "floe " + std::to_string(i)).outline;
    def.origin = floes[i].position_m;
    def.rotation = strict::rotation_of_angle(floes[i].angle_rad);
    def.velocity = floes[i].velocity_m_per_s;
    def.spin = floes[i].spin_rad_per_s;
    def.thickness = floes[i].thickness_m;
    def.density = scene.ice.density_kg_per_m3;
    areas.push_back(polygon_moments(def.outline).area);
    defs.push_back(def);
  }
  const std::vector<IceClassDef>& classes = scene.floes.classes;
  const std::vector<std::uint8_t> mixed = mixed_classes(areas, classes);
  for (std::size_t i = 0; i < defs.size(); ++i) {
    if (defs[i].thickness > 0.0) {
      defs[i].ice_class = class_of_thickness(classes, defs[i].thickness);
    } else if (classes.empty()) {
      throw Error(ExitCode::scene_rejected, "floes: a floe has no thickness (no ice class is given); add an ice class");
    } else {
      defs[i].ice_class = mixed[i];
      defs[i].thickness = classes[mixed[i]].thickness_m;
    }
    append(bodies, defs[i]);
  }
}

std::vector<FloeDef> floes_of(const SceneDef& scene, const std::vector<std::vector<Vec2>>& obstacles) {
  switch (scene.floes.source) {
    case FloeSource::listed:
      return scene.floe;
    case FloeSource::file: {
      std::vector<FloeDef> floes = read_floe_file(scene.floes.path, scene.floes.concave).floes;
      check_same_floes(scene, floes);  // the file may have changed since the case was read
      return with_listed_floes(scene, std::move(floes)).floe;
    }
    case FloeSource::generated:
    case FloeSource::copied:
      break;
  }
  return generate_floes(scene, obstacles);
}

/// Shifts one floe: two runs that differ only by this shift show how fast a disturbance grows. Floes are counted from
/// the platform, so that the shifted floe arrives at about the same time for any seed.
std::vector<FloeDef> with_moved_floe(std::vector<FloeDef> floes, const SceneDef& scene) {
  const FloesDef& def = scene.floes;
  if (def.moved_floe < 0) return floes;
  const auto rank = static_cast<std::size_t>(def.moved_floe);
  if (rank >= floes.size())
    throw Error(ExitCode::scene_rejected, "floes.moved_floe: no such floe (value " + std::to_string(def.moved_floe) +
                                              ", the field has " + std::to_string(floes.size()) +
                                              " floes, counted from 0); choose one of them");
  std::vector<std::pair<double, std::size_t>> nearest;
  for (std::size_t i = 0; i < floes.size(); ++i)
    nearest.emplace_back(length(floes[i].position_m - scene.platform.anchor_m), i);
  std::sort(nearest.begin(), nearest.end());
  Vec2& place = floes[nearest[rank].second].position_m;
  place = place + def.moved_by_m;
  return floes;
}

}  // namespace

Bodies make_field(const SceneDef& scene) {
  Bodies bodies;
  append_platform(bodies, scene);
  append_fixed(bodies, scene);
  std::vector<std::vector<Vec2>> obstacles;
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (bodies.vertex_count(i) > 0) obstacles.push_back(world_outline(bodies, i));
  append_floes(bodies, scene, with_moved_floe(floes_of(scene, obstacles), scene));
  check_field(scene, bodies);
  set_drag(bodies, scene);
  append_reserve(bodies, scene);
  return bodies;
}

}  // namespace gem
