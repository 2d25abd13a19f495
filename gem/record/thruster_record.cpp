#include "gem/record/thruster_record.h"

#include <algorithm>

#include "gem/base/strict_math.h"
#include "gem/record/run_file/run_writer.h"
#include "gem/scene/scene_drive.h"

namespace gem {
namespace {

/// Places in the sums behind those of the thrusters.
enum { demand_at, steps_at = 3, offset_at, ends = 7 };

}  // namespace

bool has_dp(const SceneDef& scene) {
  return scene.platform.present && !scene.platform.fixed && !scene.dp.thruster.empty();
}

ThrusterRecord::ThrusterRecord(const SceneDef& scene)
    : thrusters_(has_dp(scene) ? scene.dp.thruster.size() : 0), place_(scene.dp.position_m) {
  if (thrusters_ > 0) sums_.assign(3 * thrusters_ + ends, 0.0);
}

void ThrusterRecord::set_offset(const PlatformStep& step, double yaw) {
  double* const offset = sums_.data() + 3 * thrusters_ + offset_at;
  const Vec2 e = to_ship(step.rotation, step.position - place_);
  offset[0] = e.x;
  offset[1] = e.y;
  offset[2] = yaw;
}

void ThrusterRecord::start(const SceneDef& scene, const PlatformStep& start, Slab& slab) {
  if (thrusters_ == 0) return;
  const DpLaw law = dp_law(scene.dp, {1.0, 1.0, 1.0}, scene.numerics.time_step_s);  // only its set point is asked for
  set_offset(start, dp_yaw_error(law, start.rotation, drive_at_start(scene).water));
  take(slab);
}

void ThrusterRecord::add(const PlatformStep& step, const DpState& dp) {
  for (std::size_t k = 0; k < thrusters_; ++k) {
    sums_[3 * k] += dp.thrust[k].x;
    sums_[3 * k + 1] += dp.thrust[k].y;
    sums_[3 * k + 2] += static_cast<double>(dp.at_limit >> k & 1);
  }
  double* const rest = sums_.data() + 3 * thrusters_;
  rest[demand_at] += dp.demand.surge;
  rest[demand_at + 1] += dp.demand.sway;
  rest[demand_at + 2] += dp.demand.yaw;
  rest[steps_at] += 1.0;
  set_offset(step, dp.yaw_offset);
}

void ThrusterRecord::take(Slab& slab) {
  if (thrusters_ == 0) return;
  const double* const rest = sums_.data() + 3 * thrusters_;
  const double share = 1.0 / std::max(rest[steps_at], 1.0);
  for (std::size_t k = 0; k < thrusters_; ++k) {
    slab.thruster_x.push_back(share * sums_[3 * k]);
    slab.thruster_y.push_back(share * sums_[3 * k + 1]);
    slab.thruster_limit.push_back(share * sums_[3 * k + 2]);
  }
  slab.dp_demand_surge.push_back(share * rest[demand_at]);
  slab.dp_demand_sway.push_back(share * rest[demand_at + 1]);
  slab.dp_demand_yaw.push_back(share * rest[demand_at + 2]);
  slab.dp_offset_surge.push_back(rest[offset_at]);
  slab.dp_offset_sway.push_back(rest[offset_at + 1]);
  slab.dp_offset_yaw.push_back(rest[offset_at + 2]);
  std::fill(sums_.begin(), sums_.end() - (ends - offset_at), 0.0);
}

}  // namespace gem
