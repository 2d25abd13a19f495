// Sums the columns of the sides.
#include "gem/report/run/side_record.h"

#include <algorithm>
#include <cmath>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/scene/platform_shape.h"

namespace gem {
namespace {

std::vector<SideRecord> empty_sides(const std::vector<std::vector<Vec2>>& pieces, const PlatformDef& platform) {
  const std::vector<std::string> names = platform_side_names(platform);
  std::vector<SideRecord> sides;
  for (std::size_t piece = 0; piece < pieces.size(); ++piece)
    for (std::size_t k = 0; k < pieces[piece].size(); ++k) {
      SideRecord& side = sides.emplace_back();
      side.name = k < names.size() ? names[k] : "side " + std::to_string(k + 1);
      if (pieces.size() > 1) side.name = "piece " + std::to_string(piece + 1) + ", " + side.name;
      side.length = length(pieces[piece][(k + 1) % pieces[piece].size()] - pieces[piece][k]);
    }
  return sides;
}

}  // namespace

std::vector<SideRecord> side_record(const RunFile& file, const SceneDef& scene) {
  if (!file.has("platform/side_impulse") || !file.has("platform/side_friction_impulse")) return {};
  const std::vector<std::vector<Vec2>> pieces = file.platform_pieces();
  const std::vector<double> time = file.column("platform/time"), normal = file.column("platform/side_impulse"),
                            friction = file.column("platform/side_friction_impulse");
  std::vector<SideRecord> sides = empty_sides(pieces, scene.platform);
  const auto is_number = [](double value) { return std::isfinite(value); };
  if (normal.size() != time.size() * sides.size() || friction.size() != normal.size() ||
      !std::all_of(normal.begin(), normal.end(), is_number) ||
      !std::all_of(friction.begin(), friction.end(), is_number))
    throw Error(ExitCode::file_system,
                "cannot read " + shown(file.path()) +
                    " (the loads by side do not fit the outline and the samples, or are no numbers) the file "
                    "may be damaged");
  for (std::size_t i = 1; i < time.size(); ++i)
    for (std::size_t k = 0; k < sides.size(); ++k) {
      SideRecord& side = sides[k];
      const double impulse = normal[i * sides.size() + k], force = impulse / (time[i] - time[i - 1]);
      side.impulse += impulse;
      side.friction += friction[i * sides.size() + k];
      if (force > side.largest_force && std::isfinite(force)) side.largest_force = force, side.largest_time = time[i];
    }
  return sides;
}

}  // namespace gem
