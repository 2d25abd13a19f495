// The description of a run for its page. Every text of the file passes plain_text().
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/column_pieces.h"
#include "gem/record/run_file/contact_record.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/report/plain_text.h"
#include "gem/report/run/drawn_lines.h"
#include "gem/scene/platform_shape.h"
#include "gem/scene/scene_drive.h"
#include "gem/scene/scene_mooring.h"
#include "gem/view/pack/pack_run.h"

namespace gem::view {

namespace {

using Json = nlohmann::ordered_json;

Json outline_json(const std::vector<Vec2>& outline) {
  Json corners = Json::array();
  for (const Vec2 corner : outline) corners.push_back({corner.x, corner.y});
  return corners;
}

Json verdict_json(const RunFile& file) {
  const RunVerdict verdict = verdict_of(file);
  Json reasons = Json::array();
  for (const Judgement& judgement : verdict.judgements)
    if (judgement.grade == Grade::doubtful || judgement.grade == Grade::bad)
      reasons.push_back(plain_text(judgement.text));
  return {{"grade", grade_name(verdict.grade)}, {"reasons", reasons}};
}

Json origin_json(const RunFile& file) {
  Json origin;
  for (const char* name : {"source", "gem_build", "gem_engine", "gem_device", "gem_solver", "gem_seed",
                           "gem_state_hash", "gem_case_sha256", "history"})
    origin[name] = plain_text(file.attribute(name));
  return origin;
}

/// What each side took in the whole run [N s]; null unless the run recorded it and is over.
Json side_impulse_json(const RunFile& file, std::size_t sides) {
  if (sides == 0 || file.status() == "running" || !file.has("platform/side_impulse")) return nullptr;
  std::vector<double> sums(sides);
  for_each_piece(file, {"platform/side_impulse"}, [&](const ColumnPiece& piece) {
    const std::vector<double>& values = piece.values[0];
    if (values.size() != piece.rows * sides)
      throw Error(ExitCode::file_system,
                  "cannot read " + shown(file.path()) +
                      " (platform/side_impulse does not fit the outline); the file may be damaged");
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::isfinite(values[i])) sums[i % sides] += values[i];
  });
  return sums;
}

Json platform_json(const RunFile& file, const SceneDef& scene) {
  const std::vector<Vec2> outline = scene.platform.present ? file.platform_outline() : std::vector<Vec2>{};
  Json pieces = Json::array();
  if (!outline.empty())
    for (const std::vector<Vec2>& piece : file.platform_pieces()) pieces.push_back(outline_json(piece));
  return {{"present", !outline.empty()},
          {"outline", outline_json(outline)},
          {"pieces", pieces},
          {"side_names", platform_side_names(scene.platform)},
          {"side_impulse", side_impulse_json(file, outline.size())},
          {"holder", holder_of(scene)},
          {"mass_kg", scene.platform.mass_kg},
          {"diameter_m", 2.0 * platform_radius(scene.platform)},
          {"anchor_m", {scene.platform.anchor_m.x, scene.platform.anchor_m.y}},
          {"stiffness_N_per_m", mooring_stiffness_at_rest(scene)},
          {"natural_period_s", natural_period(scene)}};
}

/// Anchors, fairleads and curves of the mooring lines; none for other moorings.
Json mooring_json(const RunFile& file, const SceneDef& scene) {
  constexpr std::int32_t knots_maximum = 100;  // chosen by hand: straight between them, the eye sees no corners
  const DrawnLines drawn(file, scene);
  Json lines = Json::array();
  for (std::size_t k = 0; k < drawn.tables().branch.size(); ++k) {
    const MooringBranch& branch = drawn.tables().branch[k];
    const CurveKnot* knot = drawn.tables().knot.data() + branch.first_knot;
    const std::int32_t last = branch.knots - 1, count = std::min(branch.knots, knots_maximum);
    Json knots = Json::array();
    for (std::int32_t i = 0; i < count; ++i) {
      const CurveKnot& one = knot[count > 1 ? std::int64_t{i} * last / (count - 1) : 0];
      knots.push_back({one.at, one.force[0], one.beside[0]});
    }
    lines.push_back({{"anchor_m", {branch.anchor.x, branch.anchor.y}},
                     {"fairlead_m", {branch.fairlead.x, branch.fairlead.y}},
                     {"break_time_s", drawn.break_times()[k]},
                     {"knots", knots}});
  }
  return {{"usual_tension_N", drawn.usual_tension()}, {"lines", lines}};
}

/// Velocities of water and air in equal distances over the run; one row if they stay as they are. No wind is null.
Json drive_json(const SceneDef& scene) {
  constexpr std::int64_t rows = 240;  // chosen by hand: arrows turn without jumps
  const DriveSchedule schedule = drive_schedule(scene);
  const std::int64_t last_step =
      std::max<std::int64_t>(0, std::llround(scene.run.duration_s / scene.numerics.time_step_s) - 1);
  Json water = Json::array(), air = Json::array();
  for (std::int64_t row = 0; row <= (varies(scene.drive) ? rows : 0); ++row) {
    const Drive drive = schedule.at(last_step * row / rows);
    water.push_back({drive.water.x, drive.water.y});
    air.push_back({drive.air.x, drive.air.y});
  }
  return {{"current_m_per_s", water}, {"wind_m_per_s", has_wind(scene) ? air : Json()}};
}

}  // namespace

nlohmann::ordered_json describe_run(const RunFile& file, const PagePlan& plan) {
  const SceneDef scene = stored_scene(file);
  Json fixed = Json::array();
  for (const auto& outline : file.boundary_outlines()) fixed.push_back(outline_json(outline));
  Json classes = Json::array();
  for (const IceClassDef& ice : scene.floes.classes) classes.push_back(plain_text(ice.name));
  const Rounding& steps = plan.rounding;
  return {{"name", plain_text(scene.run.name)},
          {"status", plain_text(file.status())},
          {"duration_s", scene.run.duration_s},
          {"time_step_s", scene.numerics.time_step_s},
          {"floes", file.floe_count()},
          {"first_floe_body", file.number_attribute("gem_first_floe_body")},
          {"force_window_s", scene.output.force_window_s},
          {"events_recorded", scene.output.platform_events},
          {"contacts_recorded", ContactRecord::is_in(file)},
          {"frame_stride", plan.frame_stride},
          {"platform_bucket", plan.platform_bucket},
          {"drive", drive_json(scene)},
          {"platform", platform_json(file, scene)},
          {"mooring", mooring_json(file, scene)},
          {"fixed", fixed},
          {"classes", classes},
          {"verdict", verdict_json(file)},
          {"origin", origin_json(file)},
          {"rounding",
           {{"place_m", steps.place_m},
            {"angle_rad", steps.angle_rad},
            {"speed_m_per_s", steps.speed_m_per_s},
            {"spin_rad_per_s", steps.spin_rad_per_s}}}};
}

}  // namespace gem::view
