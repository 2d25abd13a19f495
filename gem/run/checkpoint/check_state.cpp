#include "gem/run/checkpoint/check_state.h"

#include <algorithm>
#include <functional>

#include "gem/engine/contact_key.h"
#include "gem/record/schema.h"

namespace gem {
namespace {

bool all_of_length(const Bodies& b, std::size_t n) {
  const auto fits = [n](const auto&... arrays) { return ((arrays.size() == n) && ...); };
  return fits(b.kind, b.ice_class, b.radius, b.area, b.thickness, b.mass, b.inertia, b.inverse_mass, b.inverse_inertia,
              b.drag, b.spin_drag, b.position, b.rotation, b.velocity, b.spin, b.active);
}

/// Every outline lies in the list of corners.
bool outlines_fit(const Bodies& b) {
  return b.vertex_begin.size() == b.count() + 1 && b.vertex_begin.front() == 0 &&
         b.vertex_begin.back() == static_cast<std::int64_t>(b.vertex.size()) &&
         std::is_sorted(b.vertex_begin.begin(), b.vertex_begin.end());
}

/// The platform or its pieces, then fixed bodies, then floes. Only the first piece has mass.
bool kinds_fit(const Bodies& b) {
  for (std::size_t i = 1; i < b.count() && b.kind[i] == BodyKind::platform; ++i)
    if (b.mass[i] != 0.0 || b.inertia[i] != 0.0) return false;
  return b.kind.front() == BodyKind::platform && std::is_sorted(b.kind.begin(), b.kind.end()) &&
         b.kind.back() <= BodyKind::floe;
}

bool impulses_fit(const EngineState& e) {
  const auto bodies = static_cast<std::int64_t>(e.bodies.count());
  return e.impulse_key.size() == e.impulse_value.size() &&
         std::all_of(e.impulse_key.begin(), e.impulse_key.end(), [bodies](std::uint64_t key) {
           return body_a_of(key) >= 0 && body_a_of(key) < body_b_of(key) && body_b_of(key) < bodies;
         });
}

/// Ascending keys of corners that their bodies have, of which the second follows the pieces of the platform.
bool corners_fit(const EngineState& e) {
  const Bodies& b = e.bodies;
  const auto bodies = static_cast<std::int64_t>(b.count()), fixed = static_cast<std::int64_t>(first_fixed(b));
  const auto fits = [&](std::uint64_t key) {
    const std::int64_t first = body_a_of(key), second = body_b_of(key);
    if (first < 0 || first >= second || second < fixed || second >= bodies) return false;
    const auto owner = static_cast<std::size_t>(is_of_second(key) ? second : first);
    const std::size_t end = owner == 0 ? first_fixed(b) : owner + 1;
    return corner_of(key) < b.vertex_begin[end] - b.vertex_begin[owner];
  };
  return e.corner_key.size() == e.corner_value.size() && e.substeps >= 0 &&
         std::is_sorted(e.corner_key.begin(), e.corner_key.end(), std::less_equal<>()) &&
         std::all_of(e.corner_key.begin(), e.corner_key.end(), fits);
}

bool loads_fit(const EngineState& e) {
  const auto bodies = static_cast<std::int64_t>(e.bodies.count());
  const auto fits = [bodies](const std::vector<ContactLoad>& loads) {
    return std::all_of(loads.begin(), loads.end(),
                       [bodies](const ContactLoad& load) { return load.a >= 0 && load.a < load.b && load.b < bodies; });
  };
  return fits(e.loads.before) && fits(e.loads.now);
}

/// A side for each corner of the platform, or none.
bool sides_fit(const Checkpoint& c) {
  const SideSums& sums = c.recorder.sides;
  const auto corners = static_cast<std::size_t>(c.engine.bodies.vertex_begin[first_fixed(c.engine.bodies)]);
  const Slab& rows = c.position.waiting;
  if (sums.normal.empty()) return sums.friction.empty() && rows.side_normal.empty() && rows.side_friction.empty();
  const std::size_t values = rows.platform.size() * corners;
  return sums.normal.size() == corners && sums.friction.size() == corners && rows.side_normal.size() == values &&
         rows.side_friction.size() == values;
}

/// Tensions of all lines or none, times of all.
bool lines_fit(const Checkpoint& c) {
  const LineSums& sums = c.recorder.lines;
  const Slab& rows = c.position.waiting;
  const std::size_t samples = rows.platform.size();
  return (sums.tension.empty() || sums.tension.size() == sums.break_time.size()) &&
         rows.line_tension.size() == samples * sums.tension.size() &&
         rows.line_break_time.size() == samples * sums.break_time.size();
}

/// A row of thrusters for each sample, or none.
bool thrusters_fit(const Checkpoint& c) {
  const Slab& rows = c.position.waiting;
  const std::size_t sums = c.recorder.thrusters.size();
  if (sums > 0 && (sums < 10 || (sums - 7) % 3 != 0)) return false;
  const std::size_t samples = sums > 0 ? rows.platform.size() : 0, values = sums > 0 ? samples * ((sums - 7) / 3) : 0;
  const auto fits = [](std::size_t count, const auto&... columns) { return ((columns.size() == count) && ...); };
  return fits(values, rows.thruster_x, rows.thruster_y, rows.thruster_limit) &&
         fits(samples, rows.dp_demand_surge, rows.dp_demand_sway, rows.dp_demand_yaw, rows.dp_offset_surge,
              rows.dp_offset_sway, rows.dp_offset_yaw);
}

bool rows_fit(const Slab& rows, std::size_t floes) {
  const std::size_t values = rows.floes.time.size() * floes;
  const FloeFrames& f = rows.floes;
  const auto fits = [values](const auto&... columns) { return ((columns.size() == values) && ...); };
  return fits(f.x, f.y, f.theta, f.vx, f.vy, f.omega, f.active);
}

}  // namespace

std::string fault_of(const Checkpoint& c) {
  const Bodies& b = c.engine.bodies;
  if (b.count() == 0 || !all_of_length(b, b.count())) return "its bodies are not complete";
  if (!outlines_fit(b)) return "its outlines do not fit";
  if (!kinds_fit(b)) return "its bodies are not in order";
  if (!impulses_fit(c.engine)) return "its contacts do not fit";
  if (!corners_fit(c.engine)) return "its corners do not fit";
  if (!loads_fit(c.engine)) return "its loads do not fit";
  if (!sides_fit(c)) return "its sides do not fit";
  if (!lines_fit(c)) return "its mooring lines do not fit";
  if (!thrusters_fit(c)) return "its thrusters do not fit";
  if (!rows_fit(c.position.waiting, b.count() - first_floe(b))) return "its rows do not fit";
  if (c.engine.step < 0 || c.engine.step != c.recorder.now.step) return "its time steps do not fit";
  return "";
}

}  // namespace gem
