// The columns of /platform, /events, /stats and /floes, and the source of each value.
#include "gem/record/schema.h"

#include <algorithm>

#include "gem/record/line_tensions.h"
#include "gem/record/run_file/run_writer.h"
#include "gem/record/thruster_record.h"

namespace gem {

std::size_t first_fixed(const Bodies& bodies) {
  return std::min(static_cast<std::size_t>(platform_bodies(bodies)), bodies.count());
}

std::size_t first_floe(const Bodies& bodies) {
  const auto found = std::find(bodies.kind.begin(), bodies.kind.end(), BodyKind::floe);
  return static_cast<std::size_t>(found - bodies.kind.begin());
}

std::int32_t recorded_body(const Bodies& bodies, std::int32_t body) {
  const std::int32_t more = platform_bodies(bodies) - 1;
  return body < 0 ? body : std::max(0, body - more);
}

const std::vector<RowColumn<PlatformRow>>& platform_columns() {
  const auto row = [](const char* name, const char* units, const char* long_name,
                      std::function<double(const PlatformRow&)> value, Stored stored = Stored::f8) {
    return RowColumn<PlatformRow>{{"platform", name, "time", stored, units, long_name, ""}, std::move(value)};
  };
  using P = PlatformRow;
  static const std::vector<RowColumn<P>> columns = {
      row("time", "s", "time since the start of the run", [](const P& p) { return p.time; }),
      row("x", "m", "platform centre, x", [](const P& p) { return p.position.x; }),
      row("y", "m", "platform centre, y", [](const P& p) { return p.position.y; }),
      row("psi", "rad", "platform yaw, counter-clockwise, counted on over full turns",
          [](const P& p) { return p.yaw; }),
      row("vx", "m s-1", "platform velocity, x", [](const P& p) { return p.velocity.x; }),
      row("vy", "m s-1", "platform velocity, y", [](const P& p) { return p.velocity.y; }),
      row("r", "rad s-1", "platform yaw rate", [](const P& p) { return p.spin; }),
      row("ice_force_x", "N", "ice impulse on the platform since the last sample over the sample interval, x",
          [](const P& p) { return p.ice_force.x; }),
      row("ice_force_y", "N", "ice impulse on the platform since the last sample over the sample interval, y",
          [](const P& p) { return p.ice_force.y; }),
      row("ice_impulse_x", "N s", "ice impulse on the platform since the last sample, x",
          [](const P& p) { return p.ice_impulse.x; }),
      row("ice_impulse_y", "N s", "ice impulse on the platform since the last sample, y",
          [](const P& p) { return p.ice_impulse.y; }),
      row("ice_force_mean_x", "N", "trailing mean of the ice force over the last force_window_s, x",
          [](const P& p) { return p.ice_force_mean.x; }),
      row("ice_force_mean_y", "N", "trailing mean of the ice force over the last force_window_s, y",
          [](const P& p) { return p.ice_force_mean.y; }),
      row("mooring_force_x", "N", "mooring force on the platform, mean over the sample interval, x",
          [](const P& p) { return p.mooring_force.x; }),
      row("mooring_force_y", "N", "mooring force on the platform, mean over the sample interval, y",
          [](const P& p) { return p.mooring_force.y; }),
      row("drag_force_x", "N", "drag of water and wind on the platform, mean over the sample interval, x",
          [](const P& p) { return p.drag_force.x; }),
      row("drag_force_y", "N", "drag of water and wind on the platform, mean over the sample interval, y",
          [](const P& p) { return p.drag_force.y; }),
      row("ice_yaw_moment", "N m", "yaw moment of the ice about the platform's centre, mean over the sample interval",
          [](const P& p) { return p.ice_yaw_moment; }),
      row(
          "contacts", "1", "largest number of loaded contacts in one time step since the last sample",
          [](const P& p) { return p.contacts; }, Stored::i4),
  };
  return columns;
}

const std::vector<RowColumn<Hit>>& event_columns() {
  const auto row = [](const char* name, Stored stored, const char* units, const char* long_name,
                      std::function<double(const Hit&)> value) {
    return RowColumn<Hit>{{"events", name, "event", stored, units, long_name, ""}, std::move(value)};
  };
  using C = Hit;
  static const std::vector<RowColumn<C>> columns = {
      row("time", Stored::f8, "s", "start of the time step of the first touch",
          [](const C& e) { return e.first.time; }),
      row("body_a", Stored::i4, "1", "body number of the platform", [](const C& e) { return double(e.first.body_a); }),
      row("body_b", Stored::i4, "1", "body number of the floe; its floe index is body_b - gem_first_floe_body",
          [](const C& e) { return double(e.first.body_b); }),
      row("x", Stored::f4, "m", "point of the first touch, x", [](const C& e) { return e.first.point.x; }),
      row("y", Stored::f4, "m", "point of the first touch, y", [](const C& e) { return e.first.point.y; }),
      row("nx", Stored::f4, "1", "normal from the platform into the ice, x",
          [](const C& e) { return e.first.normal.x; }),
      row("ny", Stored::f4, "1", "normal from the platform into the ice, y",
          [](const C& e) { return e.first.normal.y; }),
      row("closing_speed", Stored::f4, "m s-1", "closing speed along the normal before the first touch",
          [](const C& e) { return e.first.closing_speed; }),
      row("impulse", Stored::f4, "N s", "normal impulse on the ice until release",
          [](const C& e) { return e.impulse_normal; }),
      row("impulse_t", Stored::f4, "N s", "tangential impulse on the ice until release, along the normal turned left",
          [](const C& e) { return e.impulse_tangential; }),
      row("effective_mass", Stored::f4, "kg", "effective mass of the pair at the first touch",
          [](const C& e) { return e.first.effective_mass; }),
      row("force_peak", Stored::f4, "N", "closed-form peak crushing force (Popov) of the closing speed",
          [](const C& e) { return e.first.peak_force; }),
      row("width", Stored::f4, "m", "width of the first touch, 0 for a corner that only touches",
          [](const C& e) { return e.first.width; }),
      row("depth", Stored::f4, "m", "largest overlap depth until release", [](const C& e) { return e.depth; }),
      row("duration", Stored::f4, "s", "time from the first touch to the last time step in which the floe presses",
          [](const C& e) { return e.duration; }),
      row("window_impulse", Stored::f8, "N s", "largest normal impulse within a time of output.force_window_s",
          [](const C& e) { return e.window_impulse; }),
      row("window_end", Stored::f8, "s", "end of that time", [](const C& e) { return e.window_end; }),
  };
  return columns;
}

const std::vector<RowColumn<Hit>>& compliant_event_columns() {
  static const std::vector<RowColumn<Hit>> columns = {
      {{"events", "largest_force", "event", Stored::f4, "N", "largest normal force in a substep until release", ""},
       [](const Hit& e) { return e.largest_force; }}};
  return columns;
}

const std::vector<SideColumn>& side_columns() {
  static const std::vector<SideColumn> columns = {
      {{"platform", "side_impulse", "time platform_side", Stored::f4, "N s",
        "ice impulse since the last sample that presses on the side of the outline from corner k to corner k + 1", ""},
       &Slab::side_normal},
      {{"platform", "side_friction_impulse", "time platform_side", Stored::f4, "N s",
        "ice impulse since the last sample along the side, from corner k to corner k + 1", ""},
       &Slab::side_friction}};
  return columns;
}

std::vector<PartColumn> line_columns(const SceneDef& scene) {
  if (!has_lines(scene)) return {};
  std::vector<PartColumn> columns = {{{"platform", "line_break_time", "time mooring_line", Stored::f8, "s",
                                       "end of the time step in which the mooring line broke; 0 while it holds", ""},
                                      &Slab::line_break_time}};
  if (scene.output.line_tensions)
    columns.push_back(
        {{"platform", "line_tension", "time mooring_line", Stored::f4, "N",
          "largest tension of the mooring line at its fairlead since the last sample; 0 after it broke", ""},
         &Slab::line_tension});
  return columns;
}

std::vector<PartColumn> thruster_columns(const SceneDef& scene) {
  if (!has_dp(scene)) return {};
  const auto row = [](const char* name, const char* dimensions, const char* units, const char* long_name,
                      std::vector<double> Slab::*values) {
    return PartColumn{{"platform", name, dimensions, Stored::f8, units, long_name, ""}, values};
  };
  const char* each = "time thruster";
  return {
      row("thruster_force_x", each, "N",
          "thrust of the thruster, mean over the sample interval, along the ship's x axis", &Slab::thruster_x),
      row("thruster_force_y", each, "N",
          "thrust of the thruster, mean over the sample interval, along the ship's y axis", &Slab::thruster_y),
      row("thruster_at_limit", each, "1",
          "share of the sample interval in which the thruster was at its largest thrust or its rate limit",
          &Slab::thruster_limit),
      row("dp_demand_surge", "time", "N", "force asked of the thrusters, mean over the sample interval, surge",
          &Slab::dp_demand_surge),
      row("dp_demand_sway", "time", "N", "force asked of the thrusters, mean over the sample interval, sway",
          &Slab::dp_demand_sway),
      row("dp_demand_yaw", "time", "N m", "moment asked of the thrusters, mean over the sample interval",
          &Slab::dp_demand_yaw),
      row("dp_offset_surge", "time", "m", "offset from the set point, along the ship's x axis", &Slab::dp_offset_surge),
      row("dp_offset_sway", "time", "m", "offset from the set point, along the ship's y axis", &Slab::dp_offset_sway),
      row("dp_offset_yaw", "time", "rad", "yaw from its set point, at the start of the last time step",
          &Slab::dp_offset_yaw)};
}

std::vector<PartColumn> part_columns(const SceneDef& scene) {
  std::vector<PartColumn> columns = line_columns(scene);
  for (PartColumn& column : thruster_columns(scene)) columns.push_back(std::move(column));
  return columns;
}

const std::vector<FloeColumn>& floe_columns() {
  const auto row = [](const char* name, const char* units, const char* long_name,
                      std::vector<float> FloeFrames::*values) {
    return FloeColumn{{"floes", name, "time floe", Stored::f4, units, long_name, ""}, values};
  };
  static const std::vector<FloeColumn> columns = {
      row("x", "m", "floe centroid, x", &FloeFrames::x),
      row("y", "m", "floe centroid, y", &FloeFrames::y),
      row("theta", "rad", "floe rotation since its outline in /shape, within one turn", &FloeFrames::theta),
      row("vx", "m s-1", "floe velocity, x", &FloeFrames::vx),
      row("vy", "m s-1", "floe velocity, y", &FloeFrames::vy),
      row("omega", "rad s-1", "floe spin, counter-clockwise", &FloeFrames::omega),
      {{"floes", "active", "time floe", Stored::u1, "1", "whether the floe takes part", "retired active"},
       &FloeFrames::active},
  };
  return columns;
}

namespace {

using StatsColumn = RowColumn<StatsRow>;

StatsColumn stats_column(const std::string& name, const char* units, const std::string& long_name,
                         std::function<double(const StatsRow&)> value) {
  return {{"stats", name, "time", Stored::f8, units, long_name, ""}, std::move(value)};
}

void add_quantity(std::vector<StatsColumn>& columns, const std::string& name, const std::string& what,
                  const std::function<Quantity(const Ledger&)>& of) {
  columns.push_back(stats_column("momentum_x_" + name, "N s", "momentum in x, " + what,
                                 [of](const StatsRow& s) { return of(s.ledger).momentum.x; }));
  columns.push_back(stats_column("momentum_y_" + name, "N s", "momentum in y, " + what,
                                 [of](const StatsRow& s) { return of(s.ledger).momentum.y; }));
  columns.push_back(stats_column("angular_momentum_" + name, "N m s", "angular momentum about the origin, " + what,
                                 [of](const StatsRow& s) { return of(s.ledger).angular_momentum; }));
  columns.push_back(
      stats_column("energy_" + name, "J", "energy, " + what, [of](const StatsRow& s) { return of(s.ledger).energy; }));
}

std::vector<StatsColumn> make_stats_columns() {
  using S = StatsRow;
  std::vector<StatsColumn> columns = {
      stats_column("time", "s", "time since the start of the run", [](const S& s) { return s.time; }),
      stats_column("kinetic_energy", "J", "kinetic energy of the active bodies",
                   [](const S& s) { return s.kinetic_energy; }),
      stats_column("residual_momentum", "1", "momentum that the books leave unexplained, relative",
                   [](const S& s) { return s.residual.momentum; }),
      stats_column("residual_angular_momentum", "1", "angular momentum that the books leave unexplained, relative",
                   [](const S& s) { return s.residual.angular_momentum; }),
      stats_column("residual_energy", "1", "energy that the books leave unexplained, relative",
                   [](const S& s) { return s.residual.energy; }),
      stats_column("contacts", "1", "largest number of contact points in one time step since the last row",
                   [](const S& s) { return s.contacts; }),
      stats_column("iterations", "1", "largest number of iterations in one time step since the last row",
                   [](const S& s) { return s.iterations; }),
      stats_column(
          "residual", "m s-1",
          "largest velocity correction still due at a contact point at the end of a time step since the last row",
          [](const S& s) { return s.closing_residual; }),
      stats_column("maximum_overlap", "m", "deepest overlap since the last row",
                   [](const S& s) { return s.maximum_overlap; }),
      stats_column("maximum_overlap_share", "1",
                   "deepest overlap over the size (root of the area) of the smaller body since the last row",
                   [](const S& s) { return s.maximum_share; }),
      stats_column("complementarity", "m s-1",
                   "largest violation of the normal contact law after the events since the last row, as a speed",
                   [](const S& s) { return s.complementarity; }),
      stats_column("cone_excess", "N s", "largest friction impulse beyond Coulomb's bound since the last row",
                   [](const S& s) { return s.cone_excess; }),
      stats_column(
          "energy_created", "J",
          "largest net energy that all contacts of one time step together gave since the last row, 0 where they "
          "took; no sum of what single contacts gave",
          [](const S& s) { return s.energy_created; }),
      stats_column("active_floes", "1", "floes that take part", [](const S& s) { return s.active_floes; }),
      stats_column("wall_time", "s", "wall time since the start of the run", [](const S& s) { return s.wall_time; }),
      stats_column("sim_rate", "1", "simulated time over wall time since the last row",
                   [](const S& s) { return s.sim_rate; }),
      stats_column("steps", "1", "time steps since the start of the run", [](const S& s) { return s.steps; }),
  };
  add_quantity(columns, "total", "of the active bodies and the mooring spring now",
               [](const Ledger& ledger) { return ledger.now; });
  for (std::size_t c = 0; c < static_cast<std::size_t>(Channel::count); ++c) {
    const auto channel = static_cast<Channel>(c);
    const std::string name = channel_name(channel);
    add_quantity(columns, name, "channel '" + name + "' since t = 0",
                 [channel](const Ledger& ledger) { return ledger[channel]; });
  }
  add_quantity(columns, "mooring_spring", "given by the mooring spring since t = 0",
               [](const Ledger& ledger) { return ledger.mooring_force; });
  return columns;
}

}  // namespace

const std::vector<RowColumn<ContactRow>>& contact_columns() {
  using C = ContactRow;
  const auto row = [](const char* name, Stored stored, const char* units, const char* long_name,
                      std::function<double(const C&)> value) {
    return RowColumn<C>{{"contacts", name, "contact", stored, units, long_name, ""}, std::move(value)};
  };
  static const std::vector<RowColumn<C>> columns = {
      row("time", Stored::f8, "s", "time of the floe frame", [](const C& c) { return c.time; }),
      row("body_a", Stored::i4, "1", "body with the lower id; 0: the platform",
          [](const C& c) { return double(c.contact.a); }),
      row("body_b", Stored::i4, "1", "body with the higher id", [](const C& c) { return double(c.contact.b); }),
      row("x", Stored::f4, "m", "mean contact point, x", [](const C& c) { return c.contact.point.x; }),
      row("y", Stored::f4, "m", "mean contact point, y", [](const C& c) { return c.contact.point.y; }),
      row("force_x", Stored::f4, "N", "force on body_b, mean over the last time step, x",
          [](const C& c) { return c.contact.force.x; }),
      row("force_y", Stored::f4, "N", "force on body_b, mean over the last time step, y",
          [](const C& c) { return c.contact.force.y; }),
  };
  return columns;
}

const std::vector<RowColumn<SplitEvent>>& split_columns() {
  using S = SplitEvent;
  const auto row = [](const char* name, Stored stored, const char* units, const char* long_name,
                      std::function<double(const S&)> value) {
    return RowColumn<S>{{"splits", name, "split", stored, units, long_name, ""}, std::move(value)};
  };
  static const std::vector<RowColumn<S>> columns = {
      row("time", Stored::f8, "s", "end of the time step in which the floe split", [](const S& s) { return s.time; }),
      row("body", Stored::i4, "1", "the floe that split; its floe index is body - gem_first_floe_body",
          [](const S& s) { return double(s.split.floe); }),
      row("piece_left", Stored::i4, "1", "body left of the crack; -1: no room for pieces, the floe stayed whole",
          [](const S& s) { return double(s.split.piece[0]); }),
      row("piece_right", Stored::i4, "1", "body right of the crack; -1: no room for pieces, the floe stayed whole",
          [](const S& s) { return double(s.split.piece[1]); }),
      row("x", Stored::f8, "m", "where the crack begins, x", [](const S& s) { return s.point.x; }),
      row("y", Stored::f8, "m", "where the crack begins, y", [](const S& s) { return s.point.y; }),
      row("direction_x", Stored::f8, "1", "direction of the crack, x", [](const S& s) { return s.along.x; }),
      row("direction_y", Stored::f8, "1", "direction of the crack, y", [](const S& s) { return s.along.y; }),
      row("length", Stored::f8, "m", "length of the crack", [](const S& s) { return s.split.length; }),
      row("force", Stored::f8, "N", "force along the crack, mean over breakup.load_time_s",
          [](const S& s) { return s.force; }),
      row("splitting_force", Stored::f8, "N", "force that the floe bears",
          [](const S& s) { return s.splitting_force; }),
      row("energy", Stored::f8, "J", "energy of the crack, a part of what the contacts took",
          [](const S& s) { return s.energy; }),
  };
  return columns;
}

const std::vector<RowColumn<StatsRow>>& stats_columns() {
  static const std::vector<StatsColumn> columns = make_stats_columns();
  return columns;
}

const std::vector<RowColumn<StatsRow>>& crack_columns() {
  static const std::vector<StatsColumn> columns = {stats_column(
      "energy_cracks", "J", "energy, taken by the cracks of floes that split since t = 0; energy_impact is without it",
      [](const StatsRow& s) { return s.ledger.crack_energy; })};
  return columns;
}

const std::vector<RowColumn<StatsRow>>& compliant_stats_columns() {
  const auto row = [](const char* name, const char* units, const char* long_name, double ContactEnergy::*value) {
    return stats_column(name, units, long_name, [value](const StatsRow& s) { return s.ledger.contact.*value; });
  };
  static const std::vector<StatsColumn> columns = {
      row("energy_contact_stored", "J", "energy in the springs of all contacts now", &ContactEnergy::stored),
      row("energy_contact_crushed", "J", "energy that crushed ice since t = 0", &ContactEnergy::crushed),
      row("energy_contact_damped", "J", "energy that contacts below crushing damped since t = 0",
          &ContactEnergy::damped),
      row("energy_contact_friction", "J", "energy that friction took since t = 0", &ContactEnergy::friction),
      stats_column("energy_contact_left", "J",
                   "energy of the contacts since t = 0 that the four before do not explain; > 0: nobody supplied it",
                   [](const StatsRow& s) { return s.ledger.contact.left(); }),
      stats_column("maximum_depth", "m", "deepest overlap since the last row, with crushed ice",
                   [](const StatsRow& s) { return s.maximum_depth; }),
      row("contact_load", "N s", "normal impulse through all contacts since t = 0", &ContactEnergy::load),
      row("contact_softened", "N s", "part of it through corners with less than half the stiffness of their ice",
          &ContactEnergy::softened)};
  return columns;
}

const std::vector<CountColumn>& count_columns() {
  const auto counts = [](const char* name, const std::string& what, OverlapCount StatsRow::*values) {
    return CountColumn{
        {"stats", name, "time overlap_class", Stored::f8, "1",
         "overlaps at the start of all time steps since the last row, by " + what + " up to class_upper_edges", ""},
        values};
  };
  static const std::vector<CountColumn> columns = {
      counts("overlap_count", "depth [m]", &StatsRow::overlap),
      counts("overlap_share_count", "depth over the size of the smaller body", &StatsRow::overlap_share)};
  return columns;
}

std::vector<Column> schema(const SceneDef& scene) {
  std::vector<Column> all;
  for (const auto& entry : shape_columns(scene)) all.push_back(entry.column);
  all.push_back({"floes", "time", "time", Stored::f8, "s", "time since the start of the run", ""});
  for (const auto& entry : floe_columns()) all.push_back(entry.column);
  for (const auto& entry : platform_columns()) all.push_back(entry.column);
  if (scene.output.side_loads && scene.platform.present)
    for (const auto& entry : side_columns()) all.push_back(entry.column);
  for (const auto& entry : part_columns(scene)) all.push_back(entry.column);
  for (const auto& entry : event_columns()) all.push_back(entry.column);
  for (const auto& entry : stats_columns()) all.push_back(entry.column);
  if (scene.output.contact_forces)
    for (const auto& entry : contact_columns()) all.push_back(entry.column);
  for (const auto& entry : count_columns()) all.push_back(entry.column);
  if (is_compliant(scene)) {
    for (const auto& entry : compliant_event_columns()) all.push_back(entry.column);
    for (const auto& entry : compliant_stats_columns()) all.push_back(entry.column);
  }
  if (!records_splits(scene)) return all;
  for (const auto& entry : crack_columns()) all.push_back(entry.column);
  for (const auto& entry : split_columns()) all.push_back(entry.column);
  return all;
}

}  // namespace gem
