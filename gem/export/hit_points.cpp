// Rows of /events that began in an interval.
#include "gem/export/hit_points.h"

#include <cmath>

#include "gem/export/floe_record.h"

namespace gem {

HitPoints::HitPoints(const RunFile& file) {
  if (!file.has("events/time")) return;
  const std::size_t rows = file.rows("events/time");
  const auto read = [&](const std::string& name) { return whole_column(file, "events/" + name, rows); };
  times_ = read("time");
  const double first_floe = file.number_attribute("gem_first_floe_body");
  for (const double body : read("body_b")) floes_.push_back(static_cast<std::int32_t>(body - first_floe));
  const std::vector<double> x = read("x"), y = read("y"), nx = read("nx"), ny = read("ny");
  for (std::size_t i = 0; i < rows; ++i) {
    places_.push_back({x[i], y[i]});
    normals_.push_back({nx[i], ny[i]});
  }
  for (const char* name : {"closing_speed", "impulse", "force_peak"}) values_.push_back({name, read(name)});
}

PolyData HitPoints::between(double from_s, double to_s) const {
  PolyData data;
  data.cells = PolyCells::vertices;
  data.time = to_s;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < times_.size(); ++i)
    if (times_[i] > from_s && times_[i] <= to_s) rows.push_back(i);
  std::vector<double> time;
  std::vector<std::int32_t> floe;
  std::vector<Vec2> normal;
  for (const std::size_t i : rows) {
    data.add_cell({places_[i]});
    time.push_back(times_[i]);
    floe.push_back(floes_[i]);
    normal.push_back(normals_[i]);
  }
  data.point_data = {{"time", 1, time}, {"floe", 1, floe}, vector_array("normal", normal)};
  for (const auto& [name, values] : values_) {
    std::vector<float> chosen;
    for (const std::size_t i : rows) chosen.push_back(static_cast<float>(values[i]));
    data.point_data.push_back({name, 1, std::move(chosen)});
  }
  return data;
}

}  // namespace gem
