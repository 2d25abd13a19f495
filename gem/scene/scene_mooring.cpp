// Bounds from the tables of a mooring. Energies of tables and lines are looked at along rays from the anchor.
#include "gem/scene/scene_mooring.h"

#include <algorithm>
#include <cmath>

#include "gem/base/strict_math.h"

namespace gem {
namespace {

constexpr int rays = 16;
/// The rays are looked at from this distance on [m], at distances that grow by this factor. Chosen by hand: what lies
/// between them is covered by a share of the bound.
constexpr double first_look = 0.01, farthest_look = 1e5, growth = 1.1;

/// A mooring by itself.
class Mooring {
 public:
  explicit Mooring(const SceneDef& scene) : tables_(mooring_tables(scene)), rotation_(start_rotation(scene)) {
    const PlatformDef& p = scene.platform;
    const PlatformInEvents platform{p.anchor_m, p.mass_kg, p.diameter_m, 0.0, 1.0, false, tables_.view()};
    laws_ = make_events(scene, &platform, scene.numerics.time_step_s, false).moored;
    laws_.yaw_stiffness = 0.0;
  }

  /// Pull at an offset from the anchor [m].
  MooringPull pull(Vec2 offset) const { return mooring_pull(laws_, laws_.anchor + offset, rotation_, 0); }

  /// Calls `look` with the distance and the energy there [m], [J] along a ray, as long as it returns true.
  template <class Look>
  void along(int ray, Look look) const {
    const Rotation q = strict::rotation_of_turns(static_cast<double>(ray) / rays);
    for (double r = first_look; r < farthest_look; r *= growth)
      if (!look(r, pull({r * q.cosine, r * q.sine}).energy)) return;
  }

 private:
  static Rotation start_rotation(const SceneDef& scene) {
    return strict::rotation_of_angle(scene.platform.start_yaw_rad);
  }

  MooringTables tables_;
  Rotation rotation_;
  MooringLaws laws_;
};

bool is_linear(const SceneDef& scene) { return scene.mooring.law == MooringLaw::linear; }

double largest_slope(const MooringView& view, const MooringBranch& branch) {
  double largest = 0.0;
  for (std::int32_t k = 0; k < branch.knots; ++k) {
    const double at = view.knot[branch.first_knot + k].at;
    largest = std::max(largest, branch_at(view, branch, at).slope);
  }
  return largest;
}

}  // namespace

MooringTables mooring_tables(const SceneDef& scene) { return mooring_tables(scene.mooring.law, scene.mooring_design); }

const char* holder_of(const SceneDef& scene) {
  if (in_transit(scene.transit)) return runs_free(scene.transit) ? "thrust" : "tow";
  if (scene.platform.fixed) return "ground";
  return scene.dp.thruster.empty() ? "mooring" : "thrusters";
}

bool is_held(const SceneDef& scene) {
  if (!scene.platform.present || scene.platform.fixed) return false;
  return in_transit(scene.transit) || !scene.dp.thruster.empty() || !is_linear(scene) ||
         scene.mooring.stiffness_N_per_m > 0.0 || scene.mooring.damping_N_s_per_m > 0.0;
}

double largest_mooring_stiffness(const SceneDef& scene) {
  if (is_linear(scene)) return scene.mooring.stiffness_N_per_m;
  const MooringTables tables = mooring_tables(scene);
  double largest = 0.0, sum = 0.0;
  for (const MooringBranch& branch : tables.branch) {
    const double slope = largest_slope(tables.view(), branch);
    largest = std::max(largest, slope);
    sum += slope;
  }
  return scene.mooring.law == MooringLaw::catenary ? sum : largest;
}

double mooring_stiffness_at_rest(const SceneDef& scene, Vec2 along) {
  if (!scene.platform.present || scene.platform.fixed) return 0.0;
  if (is_linear(scene)) return scene.mooring.stiffness_N_per_m;
  const Mooring mooring(scene);
  constexpr double step = 1e-3;  // [m]; small against any mooring's offsets, large against rounding
  const Vec2 change = mooring.pull(-step * along).force - mooring.pull(step * along).force;
  return std::max(0.0, dot(change, along) / (2.0 * step));
}

double natural_period(const SceneDef& scene, Vec2 along) {
  const double stiffness = mooring_stiffness_at_rest(scene, along), mass = scene.platform.mass_kg;
  const AddedMass a = added_mass(scene.added_mass, mass, 1.0, false);
  if (!a.present) return natural_period(stiffness, mass);
  const Rotation q = strict::rotation_of_angle(scene.platform.start_yaw_rad);
  const double surge = dot({q.cosine, q.sine}, along), sway = dot({-q.sine, q.cosine}, along);
  // of a push, as much as the platform gives way along it
  const double left = surge * surge * a.surge_left + sway * sway * a.sway_left;
  return natural_period(stiffness, mass / left);
}

std::vector<double> line_tensions_at_start(const SceneDef& scene) {
  const MooringTables tables = mooring_tables(scene);
  const Rotation q = strict::rotation_of_angle(scene.platform.start_yaw_rad);
  const Vec2 place = scene.platform.anchor_m + scene.platform.start_offset_m;
  std::vector<double> tensions;
  for (std::int32_t k = 0; k < tables.view().branches; ++k)
    tensions.push_back(line_tension(tables.view(), k, place, q));
  return tensions;
}

double mooring_swing_speed(const SceneDef& scene) {
  const PlatformDef& p = scene.platform;
  if (is_linear(scene)) return std::sqrt(scene.mooring.stiffness_N_per_m / p.mass_kg) * length(p.start_offset_m);
  const Mooring mooring(scene);
  const double start = mooring.pull(p.start_offset_m).energy;
  double lowest = std::min(start, mooring.pull({}).energy);
  for (int ray = 0; ray < rays; ++ray)
    mooring.along(ray, [&](double, double energy) {
      lowest = std::min(lowest, energy);
      return energy <= start;
    });
  return growth * std::sqrt(2.0 * (start - lowest) / p.mass_kg);
}

double mooring_pushed_speed(const SceneDef& scene, double force) {
  const double mass = scene.platform.mass_kg;
  const Mooring mooring(scene);
  const double rest = mooring.pull({}).energy;
  double won = 0.0;
  for (int ray = 0; ray < rays; ++ray)
    mooring.along(ray, [&](double r, double energy) {
      const double work = force * r - (energy - rest);
      won = std::max(won, work);
      return work > 0.0;
    });
  return growth * std::sqrt(2.0 * won / mass);
}

}  // namespace gem
