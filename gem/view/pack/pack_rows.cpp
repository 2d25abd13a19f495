// Chooses rows and steps, and describes the columns.
#include "gem/view/pack/pack_rows.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

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
  const auto column = [&](const std::string& name) {
    const std::string path = choice.group + "/" + name;
    return !name.empty() && file.has(path) ? file.column(path) : std::vector<double>{};
  };
  const std::size_t rows = file.has(choice.group + "/time") ? file.rows(choice.group + "/time") : 0;
  const std::vector<std::size_t> kept = kept_rows(rows, choice, column(choice.by_x), column(choice.by_y));
  ByteWriter out;
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  for (const std::string& name : choice.columns) {
    const std::vector<double> all = column(name);
    if (all.size() != rows || rows == 0) continue;
    std::vector<double> values;
    for (const std::size_t row : kept) values.push_back(all[row]);
    const double step = step_of(name, values);
    const int order = write_column(out, values, step);
    const std::string path = choice.group + "/" + name;
    columns.push_back({{"name", name},
                       {"units", plain_text(file.units(path))},
                       {"long_name", plain_text(file.long_name(path))},
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
