// Reads the datasets of a run file into plain arrays.
#include "gem/report/run/load_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/column_pieces.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/scene/platform_shape.h"
#include "gem/scene/scene_drive.h"
#include "gem/scene/scene_mooring.h"

namespace gem {
namespace {

RunIdentity identity(const RunFile& file, const SceneDef& scene) {
  RunIdentity id;
  id.name = scene.run.name;
  id.status = file.status();
  id.case_hash = file.attribute("gem_case_sha256");
  id.state_hash = file.attribute("gem_state_hash");
  id.seed = file.attribute("gem_seed");
  id.source = file.attribute("source");
  id.history = file.attribute("history");
  id.engine = file.attribute("gem_engine");
  id.solver = file.solver();
  id.build = file.attribute("gem_build");
  id.threads = file.attribute("gem_threads");
  id.time_step_s = scene.numerics.time_step_s;
  return id;
}

[[noreturn]] void refuse_record(const RunFile& file, const std::string& why) {
  throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (" + why +
                                         "); the file may be damaged or made by another program");
}

/// Columns of one record, by name. A column that a run did not record, or that older files lack, is empty.
struct NamedColumn {
  const char* name;
  std::vector<double>* values;
};

/// Checks that the times of a record ascend (those of events need not: an event is written at its end) and that its
/// columns are as long as these. `needed` columns must be there, and hold numbers.
void check_record(const RunFile& file, const std::string& record, const std::vector<double>& time,
                  const std::vector<NamedColumn>& needed, const std::vector<NamedColumn>& others = {}) {
  const bool ascends = record != "events";
  for (std::size_t i = 0; i < time.size(); ++i)
    if (!std::isfinite(time[i]) || (ascends && i > 0 && time[i] < time[i - 1]))
      refuse_record(file, record + "/time does not ascend at row " + std::to_string(i));
  const auto check_length = [&](const NamedColumn& column) {
    if (column.values->size() != time.size())
      refuse_record(file, record + "/" + column.name + " has " + std::to_string(column.values->size()) + " rows, " +
                              record + "/time " + std::to_string(time.size()));
  };
  for (const NamedColumn& column : needed) {
    check_length(column);
    if (!std::all_of(column.values->begin(), column.values->end(), [](double value) { return std::isfinite(value); }))
      refuse_record(file, record + "/" + column.name + " holds a value that is not a number");
  }
  for (const NamedColumn& column : others)
    if (!column.values->empty()) check_length(column);
}

/// Empty if the run has no such record, for example without a platform.
std::vector<double> column(const RunFile& file, const std::string& dataset) {
  return file.has(dataset) ? file.column(dataset) : std::vector<double>{};
}

/// What is recorded as the drag of the platform: wind on it is in the same columns as the water.
std::string drag_text(const SceneDef& scene) {
  if (!scene.platform.present || scene.platform.fixed) return "";
  const bool wind = scene.wind.platform_area_m2 > 0.0 && has_wind(scene);
  if (!scene.platform_drag.present) return wind ? "wind" : "";
  return wind ? "water drag and wind" : "water drag";
}

PlatformRecord platform_record(const RunFile& file) {
  const auto read = [&file](const std::string& name) { return column(file, "platform/" + name); };
  PlatformRecord p{read("time"),
                   read("x"),
                   read("y"),
                   read("ice_force_x"),
                   read("ice_force_y"),
                   read("ice_force_mean_x"),
                   read("ice_force_mean_y"),
                   read("mooring_force_x"),
                   read("mooring_force_y"),
                   read("contacts"),
                   read("psi")};
  check_record(file, "platform", p.time,
               {{"x", &p.x},
                {"y", &p.y},
                {"ice_force_x", &p.ice_force_x},
                {"ice_force_y", &p.ice_force_y},
                {"ice_force_mean_x", &p.ice_force_mean_x},
                {"ice_force_mean_y", &p.ice_force_mean_y},
                {"mooring_force_x", &p.mooring_force_x},
                {"mooring_force_y", &p.mooring_force_y},
                {"contacts", &p.contacts}},
               {{"psi", &p.yaw}});
  return p;
}

/// Older files lack the columns.
void add_drag(const RunFile& file, PlatformRecord& p) {
  if (!file.has("platform/drag_force_x")) return;
  p.drag_force_x = file.column("platform/drag_force_x");
  p.drag_force_y = file.column("platform/drag_force_y");
  check_record(file, "platform", p.time, {{"drag_force_x", &p.drag_force_x}, {"drag_force_y", &p.drag_force_y}});
}

EventColumns event_record(const RunFile& file) {
  const auto read = [&file](const std::string& name) { return column(file, "events/" + name); };
  const bool resolved = file.has("events/largest_force");
  EventColumns events{
      read("time"), {}, read("nx"), read("ny"), read("impulse"), read(resolved ? "largest_force" : "force_peak"),
      resolved};
  std::vector<double> bodies = read("body_b");
  check_record(file, "events", events.time,
               {{"nx", &events.nx},
                {"ny", &events.ny},
                {"impulse", &events.impulse},
                {"force_peak", &events.force_peak},
                {"body_b", &bodies}});
  for (const double body : bodies) {
    if (body < 0.0 || body > std::numeric_limits<std::int32_t>::max())
      refuse_record(file, "events/body_b holds a number that no body has");
    events.body_b.push_back(static_cast<std::int32_t>(body));
  }
  return events;
}

StatsRecord stats_record(const RunFile& file) {
  const auto read = [&file](const std::string& name) { return column(file, "stats/" + name); };
  StatsRecord s{read("time"),
                read("residual_momentum"),
                read("residual_angular_momentum"),
                read("residual_energy"),
                read("maximum_overlap"),
                read("wall_time"),
                read("sim_rate"),
                read("maximum_overlap_share"),
                read("complementarity"),
                read("cone_excess"),
                read("energy_created"),
                overlaps_of(file, "stats/overlap_count"),
                overlaps_of(file, "stats/overlap_share_count")};
  check_record(file, "stats", s.time, {{"residual_momentum", &s.residual_momentum}, {"wall_time", &s.wall_time}},
               {{"residual_angular_momentum", &s.residual_angular_momentum},
                {"residual_energy", &s.residual_energy},
                {"maximum_overlap", &s.maximum_overlap},
                {"sim_rate", &s.sim_rate},
                {"maximum_overlap_share", &s.maximum_overlap_share},
                {"complementarity", &s.complementarity},
                {"cone_excess", &s.cone_excess},
                {"energy_created", &s.energy_created}});
  return s;
}

FloeFrame floe_frame(const RunFile& file, std::size_t index) {
  const FrameView view = file.frame(index);
  FloeFrame frame;
  frame.time = view.time;
  for (std::size_t i = 0; i < view.x.size(); ++i) {
    const bool gone = view.active[i] == 0.0F;
    frame.x.push_back(gone ? std::numeric_limits<double>::quiet_NaN() : view.x[i]);
    frame.y.push_back(view.y[i]);
    frame.theta.push_back(view.theta[i]);
    frame.speed.push_back(std::hypot(view.vx[i], view.vy[i]));
  }
  return frame;
}

/// Index of the frame whose time is nearest to `time_s`.
std::size_t frame_near(const RunFile& file, double time_s) {
  const std::vector<double> times = file.column("floes/time");
  const auto nearer = [time_s](double a, double b) { return std::abs(a - time_s) < std::abs(b - time_s); };
  return static_cast<std::size_t>(std::min_element(times.begin(), times.end(), nearer) - times.begin());
}

std::vector<FloeFrame> up_to_three_frames(const RunFile& file, std::optional<double> at_s) {
  const std::size_t count = file.frame_count();
  if (count >= 3)
    return {floe_frame(file, 0), floe_frame(file, at_s ? frame_near(file, *at_s) : count / 2),
            floe_frame(file, count - 1)};
  std::vector<FloeFrame> frames;
  for (std::size_t i = 0; i < count; ++i) frames.push_back(floe_frame(file, i));
  return frames;
}

}  // namespace

RunData load_run(const std::string& run_file, bool allow_incomplete, std::optional<double> at_s) {
  const RunFile file(run_file, allow_incomplete);
  const SceneDef scene = stored_scene(file);
  RunData run;
  run.identity = identity(file, scene);
  run.verdict = verdict_of(file);
  run.current_speed = drive_speed(scene);
  run.force_window_s = scene.output.force_window_s;
  run.rest = scene.platform.anchor_m;
  run.natural_period_s = natural_period(scene);
  run.natural_period_y_s = natural_period(scene, {0.0, 1.0});
  run.is_held = is_held(scene);
  run.dragged_by = drag_text(scene);
  run.platform = platform_record(file);
  if (!run.dragged_by.empty()) add_drag(file, run.platform);
  run.events = event_record(file);
  run.stats = stats_record(file);
  for (const std::vector<double>* time : {&run.platform.time, &run.stats.time})
    if (!time->empty()) run.duration_s = std::max(run.duration_s, time->back());
  run.platform_outline = file.platform_outline();
  if (auto pieces = file.platform_pieces(); pieces.size() > 1) run.platform_pieces = std::move(pieces);
  run.sides = side_record(file, scene);
  run.lines = line_record(file, scene);
  run.dp = dp_record(file, scene);
  run.transit = transit_record(run.platform, scene);
  run.on_fixed = fixed_record(file, scene);
  if (!run.dp.thruster.empty() && run.natural_period_s == 0.0) run.rest = scene.dp.position_m;
  run.fixed = file.boundary_outlines();
  run.floe_outlines = file.floe_outlines();
  for (const std::vector<Corners>& outlines : {run.fixed, run.floe_outlines})
    for (const Corners& outline : outlines)
      if (!file.is_floe_outline(outline))
        refuse_record(file, "an outline has " + std::to_string(outline.size()) + " corners");
  run.at_s = at_s;
  run.frames = up_to_three_frames(file, at_s);
  return run;
}

}  // namespace gem
