// Takes the columns of the thrusters apart and says their numbers.
#include "gem/report/run/dp_record.h"

#include <algorithm>
#include <cmath>

#include "gem/analysis/statistics/moments.h"
#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/column_pieces.h"
#include "gem/record/thruster_record.h"

namespace gem {
namespace {

const std::vector<std::string> columns = {"platform/time",
                                          "platform/thruster_force_x",
                                          "platform/thruster_force_y",
                                          "platform/thruster_at_limit",
                                          "platform/dp_offset_surge",
                                          "platform/dp_offset_sway",
                                          "platform/dp_offset_yaw",
                                          "platform/dp_demand_surge",
                                          "platform/dp_demand_sway"};
constexpr std::size_t by_thruster_end = 4;  // the columns before this one have a number for each thruster

void check_piece(const RunFile& file, const ColumnPiece& piece, std::size_t thrusters) {
  for (std::size_t column = 1; column < columns.size(); ++column) {
    const std::vector<double>& values = piece.values[column];
    if (values.size() == piece.rows * (column < by_thruster_end ? thrusters : 1) &&
        std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
      continue;
    throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (its column " + columns[column] +
                                           " does not fit the case and the samples, or holds no numbers); the file may "
                                           "be damaged");
  }
}

}  // namespace

DpRecord dp_record(const RunFile& file, const SceneDef& scene) {
  DpRecord dp;
  if (!has_dp(scene) || !file.has("platform/thruster_force_x")) return dp;
  const std::size_t thrusters = scene.dp.thruster.size();
  dp.thruster.resize(thrusters);
  dp.period = scene.dp.surge_period_s;
  for (std::size_t k = 0; k < thrusters; ++k) dp.thruster[k].maximum = scene.dp.thruster[k].maximum_N;
  for_each_piece(file, columns, [&](const ColumnPiece& piece) {
    check_piece(file, piece, thrusters);
    const auto& v = piece.values;
    for (std::size_t i = 0; i < piece.rows; ++i) {
      for (std::size_t k = 0; k < thrusters; ++k) {
        dp.thruster[k].thrust.push_back(std::hypot(v[1][i * thrusters + k], v[2][i * thrusters + k]));
        dp.thruster[k].at_limit.push_back(v[3][i * thrusters + k]);
      }
      dp.offset.push_back(std::hypot(v[4][i], v[5][i]));
      dp.yaw.push_back(v[6][i]);
      dp.demand.push_back(std::hypot(v[7][i], v[8][i]));
    }
  });
  return dp;
}

double thrust_utilisation(const DpRecord& dp, std::size_t sample) {
  double given = 0.0, all = 0.0;
  for (const ThrusterSamples& t : dp.thruster) {
    given += t.thrust[sample];
    all += t.maximum;
  }
  return all > 0.0 ? given / all : 0.0;
}

std::vector<Finding> dp_findings(const DpRecord& dp, std::size_t first) {
  if (dp.thruster.empty() || first >= dp.offset.size()) return {};
  const std::vector<double> offset(dp.offset.begin() + std::ptrdiff_t(first), dp.offset.end());
  double yaw = 0.0, used = 0.0, most_used = 0.0, limited = 0.0, demand = 0.0;
  for (std::size_t i = first; i < dp.offset.size(); ++i) {
    yaw = std::max(yaw, std::abs(dp.yaw[i]));
    used += thrust_utilisation(dp, i);
    most_used = std::max(most_used, thrust_utilisation(dp, i));
    demand = std::max(demand, dp.demand[i]);
    double some = 0.0;
    for (const ThrusterSamples& t : dp.thruster) some = std::max(some, t.at_limit[i]);
    limited += some;
  }
  const double samples = double(offset.size());
  return {{"dp_offset_median_m", percentile(offset, 0.5), {}},
          {"dp_offset_p90_m", percentile(offset, 0.9), {}},
          {"dp_offset_p99_m", percentile(offset, 0.99), {}},
          {"dp_offset_largest_m", *std::max_element(offset.begin(), offset.end()), {}},
          {"dp_yaw_largest_rad", yaw, {}},
          {"dp_demand_largest_N", demand, {}},
          {"dp_thrust_utilisation", used / samples, {}},
          {"dp_thrust_utilisation_largest", most_used, {}},
          {"dp_time_at_limit_share", limited / samples, {}}};
}

}  // namespace gem
