// Sums the columns of the sides.
#include "gem/report/run/side_record.h"

#include <algorithm>
#include <cmath>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/column_pieces.h"
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

void check_sides(const RunFile& file, const ColumnPiece& piece, std::size_t sides) {
  for (const std::size_t column : {1, 2}) {
    const std::vector<double>& values = piece.values[column];
    if (values.size() == piece.rows * sides &&
        std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
      continue;
    throw Error(ExitCode::file_system,
                "cannot read " + shown(file.path()) +
                    " (the loads by side do not fit the outline and the samples, or are no numbers); the file "
                    "may be damaged");
  }
}

/// Adds row `i` of times, normal and friction impulses; `before` is the time of the row before it.
void add_sample(std::vector<SideRecord>& sides, const ColumnPiece& piece, std::size_t i, double before) {
  const double time = piece.values[0][i];
  for (std::size_t k = 0; k < sides.size(); ++k) {
    SideRecord& side = sides[k];
    const double impulse = piece.values[1][i * sides.size() + k], force = impulse / (time - before);
    side.impulse += impulse;
    side.friction += piece.values[2][i * sides.size() + k];
    if (force > side.largest_force && std::isfinite(force)) side.largest_force = force, side.largest_time = time;
  }
}

}  // namespace

std::vector<SideRecord> side_record(const RunFile& file, const SceneDef& scene) {
  if (!file.has("platform/side_impulse") || !file.has("platform/side_friction_impulse")) return {};
  const std::vector<std::vector<Vec2>> pieces = file.platform_pieces();
  std::vector<SideRecord> sides = empty_sides(pieces, scene.platform);
  double before = 0.0;  // time of the last sample
  for_each_piece(file, {"platform/time", "platform/side_impulse", "platform/side_friction_impulse"},
                 [&](const ColumnPiece& piece) {
                   check_sides(file, piece, sides.size());
                   for (std::size_t i = 0; i < piece.rows; ++i) {
                     if (piece.first + i > 0) add_sample(sides, piece, i, before);
                     before = piece.values[0][i];
                   }
                 });
  return sides;
}

}  // namespace gem
