// Chooses what a page holds of a run.
#include "gem/view/pack/pack_run.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/view/pack/byte_writer.h"
#include "gem/view/pack/pack_contacts.h"
#include "gem/view/pack/packet.h"

namespace gem::view {

namespace {

const std::vector<std::string> platform_columns = {"time",
                                                   "x",
                                                   "y",
                                                   "psi",
                                                   "vx",
                                                   "vy",
                                                   "r",
                                                   "ice_force_x",
                                                   "ice_force_y",
                                                   "ice_force_mean_x",
                                                   "ice_force_mean_y",
                                                   "mooring_force_x",
                                                   "mooring_force_y",
                                                   "thrust_x",
                                                   "thrust_y",
                                                   "drag_force_x",
                                                   "drag_force_y",
                                                   "ice_yaw_moment",
                                                   "contacts"};
const std::vector<std::string> event_columns = {"time",
                                                "body_b",
                                                "x",
                                                "y",
                                                "nx",
                                                "ny",
                                                "closing_speed",
                                                "impulse",
                                                "impulse_t",
                                                "effective_mass",
                                                "force_peak",
                                                "largest_force",
                                                "width",
                                                "depth",
                                                "duration",
                                                "window_impulse",
                                                "window_end"};
const std::vector<std::string> stats_columns = {"time",         "kinetic_energy", "contacts",
                                                "iterations",   "residual",       "maximum_overlap",
                                                "active_floes", "wall_time",      "sim_rate"};

std::size_t parts_of(std::size_t whole, std::size_t part) {
  return std::max<std::size_t>(1, (whole + part - 1) / part);
}

[[noreturn]] void refuse_shape(const RunFile& file, const std::string& why) {
  throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (" + why +
                                         "); the file may be damaged or made by another program");
}

}  // namespace

PagePlan plan_for(const RunFile& file) {
  const SceneDef scene = stored_scene(file);
  const auto rows = [&](double interval) {
    const double count = scene.run.duration_s / interval + 2.0;
    return count >= 1.0 && count < 1e12 ? static_cast<std::size_t>(count) : 1;
  };
  const std::size_t frames = std::max(file.frame_count(), rows(scene.output.floes_interval_s));
  const std::size_t samples = rows(scene.output.platform_interval_s);
  PagePlan plan;
  plan.rounding = rounding_for(file.floe_outlines(), scene.output.floes_interval_s);
  plan.frame_stride = parts_of(frames * file.floe_count(), places_maximum);
  plan.contacts_of_frame = std::max<std::size_t>(1, contacts_maximum * plan.frame_stride / frames);
  plan.platform_bucket = parts_of(samples, platform_rows_maximum);
  return plan;
}

std::string pack_shapes(const RunFile& file, const PagePlan& plan) {
  const double step = plan.rounding.place_m / 10.0;
  const auto outlines = file.floe_outlines();
  ByteWriter out;
  for (const auto& outline : outlines) {
    if (!file.is_floe_outline(outline) || outline.size() > 1000)
      refuse_shape(file, "an outline has " + std::to_string(outline.size()) + " corners");
    out.whole(outline.size());
  }
  for (const auto& outline : outlines)
    for (const Vec2 corner : outline)
      for (const double place : {corner.x, corner.y}) {
        if (!(std::abs(place) < 1e6)) refuse_shape(file, "a corner of an outline is no place");
        out.signed_whole(static_cast<std::int64_t>(std::floor(place / step + 0.5)));
      }
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  for (const char* name : {"thickness", "area", "mass", "class"}) {
    const std::vector<double> values = file.column(std::string("shape/") + name);
    if (values.size() != outlines.size()) refuse_shape(file, std::string("shape/") + name + " has another length");
    double largest = 0.0;
    for (const double value : values) largest = std::max(largest, std::isfinite(value) ? std::abs(value) : 0.0);
    const double column_step = std::string(name) == "class" || largest == 0.0 ? 1.0 : largest / 1e6;
    for (const double value : values)
      out.signed_whole(std::isfinite(value) ? static_cast<std::int64_t>(std::floor(value / column_step + 0.5)) : 0);
    columns.push_back({{"name", name}, {"step", column_step}});
  }
  return packet({{"kind", "shapes"}, {"floes", outlines.size()}, {"place_m", step}, {"columns", columns}}, out.take());
}

std::vector<FrameRange> frame_ranges(const RunFile& file, const PagePlan& plan, std::size_t first) {
  constexpr std::size_t first_picture = 2;  // frames of the first packet: the page shows them while it reads the others
  const std::size_t stride = plan.frame_stride;
  const std::size_t kept = (file.frame_count() + stride - 1) / stride;
  const std::size_t most =
      std::clamp<std::size_t>(500'000 / std::max<std::size_t>(1, file.floe_count() * stride), 1, 128);
  std::vector<FrameRange> ranges;
  for (std::size_t n = first; n < kept; n += ranges.back().count) {
    const std::size_t limit = n == 0 ? std::min(first_picture, most) : most;
    ranges.push_back({n * stride, std::min(limit, kept - n), stride});
  }
  return ranges;
}

RowChoice rows_for_page(const std::string& group, const PagePlan& plan, std::size_t first) {
  if (group == "events") return {group, event_columns, first, 1, "", ""};
  if (group == "stats") return {group, stats_columns, first, 1, "", ""};
  return {group, platform_columns, first, plan.platform_bucket, "ice_force_mean_x", "ice_force_mean_y"};
}

std::vector<std::string> pack_run(const RunFile& file, const PagePlan& plan) {
  std::vector<std::string> packets = {pack_shapes(file, plan)};
  const std::vector<FrameRange> ranges = frame_ranges(file, plan);
  const auto add_rows = [&] {
    for (const char* group : {"platform", "events", "stats"})
      packets.push_back(pack_rows(file, rows_for_page(group, plan)));
  };
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    packets.push_back(pack_frames(file, ranges[i], plan.rounding));
    if (i == 0) add_rows();
  }
  if (ranges.empty()) add_rows();
  if (ContactRecord::is_in(file))
    for (const FrameRange& range : ranges) packets.push_back(pack_contacts(file, range, plan.contacts_of_frame));
  return packets;
}

}  // namespace gem::view
