// Chooses rows and steps, and describes the columns.
#include "gem/view/pack/pack_rows.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gem/record/run_file/column_pieces.h"
#include "gem/report/plain_text.h"
#include "gem/view/pack/pack_column.h"
#include "gem/view/pack/packet.h"

namespace gem::view {

namespace {

constexpr double parts = 131072.0;

double step_of(const std::string& name, const std::vector<double>& values) {
  if (name == "time" || name == "window_end") return 1e-6;
  if (name == "contacts" || name == "body_b" || name == "active_floes" || name == "iterations") return 1.0;
  double largest = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest > 0.0 ? largest / parts : 1.0;
}

/// Thrust of all thrusters together along axis x or y of the world [N]. Their columns are in the ship's axes.
std::vector<double> thrust_of(const RunFile& file, bool along_y) {
  if (!file.has("platform/thruster_force_x")) return {};
  const std::vector<std::string> columns = {"platform/psi", "platform/thruster_force_x", "platform/thruster_force_y"};
  std::vector<double> thrust;
  for_each_piece(file, columns, [&](const ColumnPiece& piece) {
    const auto &psi = piece.values[0], &fx = piece.values[1], &fy = piece.values[2];
    const std::size_t thrusters = fx.size() / piece.rows;
    if (psi.size() != piece.rows || fx.size() != fy.size() || fx.size() != thrusters * piece.rows) return;
    for (std::size_t row = 0; row < piece.rows; ++row) {
      const double c = std::cos(psi[row]), s = std::sin(psi[row]);
      double sum = 0.0;
      for (std::size_t i = row * thrusters; i < (row + 1) * thrusters; ++i)
        sum += along_y ? s * fx[i] + c * fy[i] : c * fx[i] - s * fy[i];
      thrust.push_back(sum);
    }
  });
  return thrust;
}

struct PageColumn {
  std::vector<double> values;  // empty if the file has none
  std::string units, long_name;
};

PageColumn column_of(const RunFile& file, const std::string& group, const std::string& name) {
  if (name == "thrust_x" || name == "thrust_y")
    return {thrust_of(file, name == "thrust_y"), "N", "thrust of all thrusters, mean over the sample interval"};
  const std::string path = group + "/" + name;
  if (name.empty() || !file.has(path)) return {};
  return {file.column(path), file.units(path), file.long_name(path)};
}

/// Rows that are kept: of each bucket the one with the largest length of the vector (x, y).
std::vector<std::size_t> kept_rows(std::size_t rows, const RowChoice& choice, const std::vector<double>& x,
                                   const std::vector<double>& y) {
  std::vector<std::size_t> kept;
  for (std::size_t begin = choice.first; begin < rows; begin += choice.bucket) {
    const std::size_t end = std::min(rows, begin + choice.bucket);
    std::size_t best = end - 1;
    if (x.size() == rows && y.size() == rows)
      for (std::size_t i = begin; i < end; ++i)
        if (std::hypot(x[i], y[i]) > std::hypot(x[best], y[best])) best = i;
    kept.push_back(best);
  }
  return kept;
}

}  // namespace

std::string pack_rows(const RunFile& file, const RowChoice& choice) {
  const std::size_t rows = file.has(choice.group + "/time") ? file.rows(choice.group + "/time") : 0;
  const std::vector<std::size_t> kept = kept_rows(rows, choice, column_of(file, choice.group, choice.by_x).values,
                                                  column_of(file, choice.group, choice.by_y).values);
  ByteWriter out;
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  for (const std::string& name : choice.columns) {
    const PageColumn all = column_of(file, choice.group, name);
    if (all.values.size() != rows || rows == 0) continue;
    std::vector<double> values;
    for (const std::size_t row : kept) values.push_back(all.values[row]);
    const double step = step_of(name, values);
    const int order = write_column(out, values, step);
    columns.push_back({{"name", name},
                       {"units", plain_text(all.units)},
                       {"long_name", plain_text(all.long_name)},
                       {"step", step},
                       {"order", order}});
  }
  const nlohmann::ordered_json description = {{"kind", "rows"},        {"group", choice.group},
                                              {"first", choice.first}, {"next", std::max(rows, choice.first)},
                                              {"count", kept.size()},  {"bucket", choice.bucket},
                                              {"columns", columns}};
  return packet(description, out.take());
}

}  // namespace gem::view
