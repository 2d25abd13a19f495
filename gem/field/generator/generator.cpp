// Generates the pack-ice fields.
#include "gem/field/generator/generator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/field/channel.h"
#include "gem/field/generator/field_region.h"
#include "gem/field/generator/floe_count.h"
#include "gem/field/generator/floe_set.h"
#include "gem/field/generator/mosaic.h"
#include "gem/field/generator/placement.h"

namespace gem {
namespace {

/// Up to this share of the free water packing reaches every usual size law with floes of given shapes.
constexpr double packing_concentration = 0.75;

[[noreturn]] void refuse(const std::string& text) { throw Error(ExitCode::scene_rejected, "floes: " + text); }

void check(const SceneDef& scene) {
  const FloesDef& f = scene.floes;
  if (f.count < 0) refuse("count " + std::to_string(f.count) + " is negative (nothing to place); give 0 or more");
  if (!(f.gap_m > 0.0))
    refuse("gap_m " + number_text(f.gap_m) + " is not positive (no contact is allowed at the start); give e.g. 0.05");
  if (!(f.length_m > 0.0 && f.width_m > 0.0)) refuse("length_m and width_m must be positive (the field is empty)");
  if (f.source == FloeSource::copied && f.shape_count < 1) refuse("shape_count must be at least 1 (nothing to copy)");
  if (!scene.boundary.present) return;
  if (f.start_x_m < scene.boundary.inlet_x_m)
    refuse("start_x_m " + number_text(f.start_x_m) + " lies upstream of boundary.inlet_x_m " +
           number_text(scene.boundary.inlet_x_m) + " (floes would start outside the channel); move one of them");
}

std::int64_t floe_count(const SceneDef& scene, const std::vector<std::vector<Vec2>>& obstacles) {
  if (!(scene.floes.concentration > 0.0)) return scene.floes.count;
  return count_of_concentration(scene.floes, free_area(field_region(scene), obstacles));
}

PlacementTask task_for(const SceneDef& scene, std::int64_t count, const std::vector<std::vector<Vec2>>& obstacles) {
  PlacementTask task;
  task.outlines = make_floe_set(scene, count);
  task.region = field_region(scene);
  task.obstacles = obstacles;
  task.gap = scene.floes.gap_m;
  task.seed = scene.run.seed;
  return task;
}

FloeDef floe_at(const std::vector<Vec2>& outline, const Pose& pose, Vec2 shift) {
  FloeDef floe;
  for (const Vec2 p : outline) floe.outline_m.push_back(rotate(pose.rotation, p));
  floe.position_m = pose.position + shift;
  floe.thickness_m = 0.0;
  return floe;
}

std::vector<FloeDef> tiled_floes(const SceneDef& scene, const std::vector<std::vector<Vec2>>& obstacles) {
  const FloesDef& f = scene.floes;
  const double end_x = f.start_x_m + f.length_m;
  if (scene.boundary.present &&
      channel_half_width(scene.boundary, f.start_x_m) != channel_half_width(scene.boundary, end_x))
    refuse("a tiled field needs a straight channel (the repeated block would not fit further down) " +
           std::string("set boundary.taper_start_x_m to the field's end or use placement = \"random\""));
  if (!(f.tile_length_m > 0.0)) refuse("tile_length_m must be positive (the block would be empty)");
  const auto blocks = std::max<std::int64_t>(1, std::llround(f.length_m / f.tile_length_m));
  const double block_length = f.length_m / static_cast<double>(blocks);
  const std::int64_t count = floe_count(scene, obstacles);
  const std::int64_t per_block = (count + blocks - 1) / blocks;
  PlacementTask task = task_for(scene, per_block, obstacles);
  // Half a gap at both ends keeps the gap to the next block.
  task.region.low.x += 0.5 * f.gap_m;
  task.region.high.x = f.start_x_m + block_length - 0.5 * f.gap_m;
  const std::vector<Pose> poses = place(task);
  std::vector<FloeDef> floes;
  for (std::int64_t block = 0; block < blocks; ++block) {
    // If the blocks do not divide count, each of the last ones leaves out one floe.
    const bool short_block = block >= blocks - (per_block * blocks - count);
    const auto floes_here = static_cast<std::size_t>(per_block - (short_block ? 1 : 0));
    const Vec2 shift = {block_length * static_cast<double>(block), 0.0};
    for (std::size_t i = 0; i < floes_here; ++i) floes.push_back(floe_at(task.outlines[i], poses[i], shift));
  }
  return floes;
}

[[noreturn]] void refuse_mosaic(const SceneDef& scene, const Mosaic& mosaic) {
  const FloesDef& f = scene.floes;
  const std::string reached = number_text(f.concentration * mosaic.reached_share, 3);
  throw Error(ExitCode::scene_rejected, "floes.concentration: " + number_text(f.concentration) + " was not reached (" +
                                            reached + " of the free water, with gap_m = " + number_text(f.gap_m) +
                                            " m around every floe); lower it, make gap_m smaller or the field larger");
}

std::vector<FloeDef> mosaic_floes(const SceneDef& scene, const PlacementTask& task) {
  const Mosaic mosaic = make_mosaic(task);
  if (mosaic.floes.empty()) refuse_mosaic(scene, mosaic);
  std::vector<FloeDef> floes;
  for (const MosaicFloe& floe : mosaic.floes) floes.push_back(floe_at(floe.outline, {floe.position, {}}, {}));
  return floes;
}

std::vector<FloeDef> scattered_floes(const SceneDef& scene, const std::vector<std::vector<Vec2>>& obstacles) {
  const PlacementTask task = task_for(scene, floe_count(scene, obstacles), obstacles);
  if (scene.floes.source == FloeSource::generated && scene.floes.concentration > packing_concentration)
    return mosaic_floes(scene, task);
  const std::vector<Pose> poses = place(task);
  std::vector<FloeDef> floes;
  for (std::size_t i = 0; i < poses.size(); ++i) floes.push_back(floe_at(task.outlines[i], poses[i], {}));
  return floes;
}

}  // namespace

std::vector<FloeDef> generate_floes(const SceneDef& scene, const std::vector<std::vector<Vec2>>& obstacles) {
  if (scene.floes.count == 0 && scene.floes.concentration == 0.0) return {};
  check(scene);
  const bool tiled = scene.floes.source == FloeSource::copied && scene.floes.placement == Placement::tiled;
  std::vector<FloeDef> floes = tiled ? tiled_floes(scene, obstacles) : scattered_floes(scene, obstacles);
  // Neighbours with near numbers keep the engine's accesses in the cache.
  std::stable_sort(floes.begin(), floes.end(),
                   [](const FloeDef& a, const FloeDef& b) { return a.position_m.x < b.position_m.x; });
  return floes;
}

}  // namespace gem
