// Takes the columns of the thrusters apart and says their numbers.
#include "gem/report/run/dp_record.h"

#include <algorithm>
#include <cmath>

#include "gem/analysis/statistics/moments.h"
#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/record/thruster_record.h"

namespace gem {
namespace {

/// A column with `width` numbers for each sample.
std::vector<double> dp_column(const RunFile& file, const char* name, std::size_t width) {
  const std::string path = std::string("platform/") + name;
  std::vector<double> values = file.has(path) ? file.column(path) : std::vector<double>{};
  const auto is_number = [](double value) { return std::isfinite(value); };
  if (values.size() != file.rows("platform/time") * width || !std::all_of(values.begin(), values.end(), is_number))
    throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (its column " + path +
                                           " does not fit the case and the samples, or holds no numbers) the file may "
                                           "be damaged");
  return values;
}

std::vector<double> lengths(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> all(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) all[i] = std::hypot(x[i], y[i]);
  return all;
}

}  // namespace

DpRecord dp_record(const RunFile& file, const SceneDef& scene) {
  DpRecord dp;
  if (!has_dp(scene) || !file.has("platform/thruster_force_x")) return dp;
  const std::size_t thrusters = scene.dp.thruster.size(), samples = file.rows("platform/time");
  const std::vector<double> x = dp_column(file, "thruster_force_x", thrusters),
                            y = dp_column(file, "thruster_force_y", thrusters),
                            limit = dp_column(file, "thruster_at_limit", thrusters);
  dp.thruster.resize(thrusters);
  for (std::size_t k = 0; k < thrusters; ++k) {
    dp.thruster[k].maximum = scene.dp.thruster[k].maximum_N;
    for (std::size_t i = 0; i < samples; ++i) {
      dp.thruster[k].thrust.push_back(std::hypot(x[i * thrusters + k], y[i * thrusters + k]));
      dp.thruster[k].at_limit.push_back(limit[i * thrusters + k]);
    }
  }
  dp.offset = lengths(dp_column(file, "dp_offset_surge", 1), dp_column(file, "dp_offset_sway", 1));
  dp.yaw = dp_column(file, "dp_offset_yaw", 1);
  dp.demand = lengths(dp_column(file, "dp_demand_surge", 1), dp_column(file, "dp_demand_sway", 1));
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
