// Reads the datasets of a run file into plain arrays.
#include "gem/report/run/load_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gem/base/error.h"
#include "gem/events/mooring.h"
#include "gem/record/output_path.h"
#include "gem/record/run_file.h"
#include "gem/scene/toml/scene_file.h"

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

/// Empty if the run has no such record, for example without a platform.
std::vector<double> column(const RunFile& file, const std::string& dataset) {
  return file.has(dataset) ? file.column(dataset) : std::vector<double>{};
}

/// A record that is read by index must have columns of one length. In a run that was killed, some may be longer.
void settle(const RunFile& file, const std::string& group, const std::vector<std::vector<double>*>& columns) {
  std::size_t shortest = columns.front()->size();
  for (const std::vector<double>* one : columns) shortest = std::min(shortest, one->size());
  for (std::vector<double>* one : columns) {
    if (one->size() != shortest && file.status() == "complete")
      throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (the columns of " + group +
                                             " differ in length) the file may be damaged");
    one->resize(shortest);
  }
}

void check_finite(const RunFile& file, const std::string& group, const std::vector<std::vector<double>*>& columns) {
  for (const std::vector<double>* one : columns)
    for (const double value : *one)
      if (!std::isfinite(value))
        throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (" + group +
                                               " holds a value that is not a finite number) the file may be damaged");
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
                   read("contacts")};
  const std::vector<std::vector<double>*> columns = {&p.time,
                                                     &p.x,
                                                     &p.y,
                                                     &p.ice_force_x,
                                                     &p.ice_force_y,
                                                     &p.ice_force_mean_x,
                                                     &p.ice_force_mean_y,
                                                     &p.mooring_force_x,
                                                     &p.mooring_force_y,
                                                     &p.contacts};
  settle(file, "platform", columns);
  check_finite(file, "platform", columns);
  return p;
}

EventColumns event_record(const RunFile& file) {
  const auto read = [&file](const std::string& name) { return column(file, "events/" + name); };
  EventColumns events{read("time"), {}, read("nx"), read("ny"), read("impulse"), read("force_peak")};
  std::vector<double> bodies = read("body_b");
  const std::vector<std::vector<double>*> columns = {&events.time, &bodies,         &events.nx,
                                                     &events.ny,   &events.impulse, &events.force_peak};
  settle(file, "events", columns);
  check_finite(file, "events", columns);
  for (const double body : bodies) {
    if (std::abs(body) > std::numeric_limits<std::int32_t>::max())
      throw Error(ExitCode::file_system,
                  "cannot read " + shown(file.path()) + " (events/body_b holds no body) the file may be damaged");
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
  settle(file, "stats",
         {&s.time, &s.residual_momentum, &s.residual_angular_momentum, &s.residual_energy, &s.maximum_overlap,
          &s.wall_time});
  return s;
}

FloeFrame floe_frame(const FrameView& view) {
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

std::vector<FloeFrame> up_to_three_frames(const RunFile& file) {
  const std::size_t count = file.frame_count();
  if (count >= 3)
    return {floe_frame(file.frame(0)), floe_frame(file.frame(count / 2)), floe_frame(file.frame(count - 1))};
  std::vector<FloeFrame> frames;
  for (std::size_t i = 0; i < count; ++i) frames.push_back(floe_frame(file.frame(i)));
  return frames;
}

}  // namespace

RunData load_run(const std::string& run_file, bool allow_incomplete) {
  const RunFile file(run_file, allow_incomplete);
  const SceneDef scene = parse_scene(file.attribute("gem_case_toml"), run_file);
  RunData run;
  run.identity = identity(file, scene);
  run.verdict = verdict_of(file);
  run.current_speed = length(scene.current.velocity_m_per_s);
  run.force_window_s = scene.output.force_window_s;
  run.rest = scene.platform.anchor_m;
  run.natural_period_s = natural_period(scene.mooring.stiffness_N_per_m, scene.platform.mass_kg);
  run.platform = platform_record(file);
  run.events = event_record(file);
  run.stats = stats_record(file);
  for (const std::vector<double>* time : {&run.platform.time, &run.stats.time})
    if (!time->empty()) run.duration_s = std::max(run.duration_s, time->back());
  run.platform_outline = file.platform_outline();
  run.fixed = file.boundary_outlines();
  run.floe_outlines = file.floe_outlines();
  run.frames = up_to_three_frames(file);
  return run;
}

}  // namespace gem
