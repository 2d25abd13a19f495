// A frame as GeoJSON.
#include <algorithm>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/export/export_output.h"
#include "gem/export/export_run.h"
#include "gem/export/floe_record.h"
#include "gem/export/floe_scale.h"
#include "gem/export/platform_track.h"
#include "gem/field/check_outline.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/stored_case.h"

namespace gem {
namespace {

std::string pair_text(Vec2 p) { return "[" + number_text(p.x) + "," + number_text(p.y) + "]"; }

std::vector<Vec2> scaled(const FrameFloe& floe, double scale) {
  std::vector<Vec2> corners;
  for (const Vec2 corner : floe.outline) corners.push_back(floe.position + scale * corner);
  check_outline(corners, "floe " + std::to_string(floe.index));
  return corners;
}

std::string feature_text(const FloeRecord& record, const FrameFloe& floe, double scale) {
  const std::vector<Vec2> corners = scaled(floe, scale);
  std::string ring;
  for (const Vec2 corner : corners) ring += pair_text(corner) + ",";
  return "{\"type\":\"Feature\",\"properties\":{\"floe\":" + std::to_string(floe.index) +
         ",\"thickness\":" + number_text(record.thickness(floe.index)) +
         ",\"class\":" + std::to_string(record.ice_class(floe.index)) +
         ",\"velocity_m_per_s\":" + pair_text(floe.velocity) + ",\"spin_rad_per_s\":" + number_text(floe.spin) +
         ",\"scale\":" + number_text(scale) + "},\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[[" + ring +
         pair_text(corners.front()) + "]]}}";
}

/// What the next run would meet: the fixed bodies, and the platform where it is, as it is turned and as it would start
/// without a yaw. A ship in transit turns with its course, so it is taken as it is turned alone.
std::vector<std::vector<Vec2>> obstacles_at(const RunFile& file, const PlatformTrack& platform, double time_s,
                                            bool turns_with_course) {
  std::vector<std::vector<Vec2>> obstacles = file.boundary_outlines();
  if (!platform.present()) return obstacles;
  const std::size_t sample = platform.sample_at(time_s);
  const auto add = [&](const std::vector<std::vector<Vec2>>& pieces) {
    obstacles.insert(obstacles.end(), pieces.begin(), pieces.end());
  };
  add(platform.outlines(sample));
  if (!turns_with_course) add(platform.unturned_outlines(sample));
  return obstacles;
}

/// A member beside the features, which readers of GeoJSON pass over: the state to start a platform with.
std::string platform_text(const PlatformTrack& platform, double time_s, Vec2 anchor) {
  if (!platform.present()) return "";
  const std::size_t sample = platform.sample_at(time_s);
  return ",\"platform\":{\"start_offset_m\":" + pair_text(platform.position(sample) - anchor) +
         ",\"start_velocity_m_per_s\":" + pair_text({platform.value("vx", sample), platform.value("vy", sample)}) +
         ",\"yaw_rad\":" + number_text(platform.value("psi", sample)) + "}";
}

std::string report_text(const std::string& output, double time_s, const std::vector<double>& scales) {
  const auto smaller = std::count_if(scales.begin(), scales.end(), [](double scale) { return scale < 1.0; });
  std::string text = shown(output) + ": " + std::to_string(scales.size()) + " floes at " + number_text(time_s) + " s\n";
  if (smaller > 0)
    text += "  " + std::to_string(smaller) + " of them overlap and are drawn smaller, at most by " +
            number_text(100.0 * (1.0 - *std::min_element(scales.begin(), scales.end())), 2) + " %\n";
  return text;
}

}  // namespace

ExportReport export_geojson(const ExportTarget& target, double at_s) {
  check_output_path(target.output, target.overwrite);
  const RunFile file(target.run_file, target.allow_incomplete);
  const FloeRecord record(file);
  const std::size_t index = at_s < 0.0 ? record.times().size() - 1 : record.nearest(at_s);
  const double time = record.times()[index];
  const std::vector<FrameFloe> floes = record.frame(index);
  if (floes.empty())
    throw Error(ExitCode::usage, shown(file.path()) + ": no floe takes part at " + number_text(time) +
                                     " s (all have left the field); choose an earlier --at");
  const PlatformTrack platform(file);
  const SceneDef scene = stored_scene(file);
  const Vec2 anchor = scene.platform.anchor_m;
  const std::vector<std::vector<Vec2>> obstacles = obstacles_at(file, platform, time, in_transit(scene.transit));
  const std::vector<double> scales = parting_scales(floes, obstacles);
  std::vector<std::string> features;
  for (std::size_t i = 0; i < floes.size(); ++i) features.push_back(feature_text(record, floes[i], scales[i]));
  write_export(target.output, [&](std::ostream& out) {
    out << "{\"type\":\"FeatureCollection\",\"time_s\":" << number_text(time) << platform_text(platform, time, anchor)
        << ",\"features\":[\n";
    for (std::size_t i = 0; i < features.size(); ++i) out << features[i] << (i + 1 < features.size() ? ",\n" : "\n");
    out << "]}\n";
  });
  return report_text(target.output, time, scales);
}

}  // namespace gem
