// Compares the hours of a day.
#include "validation/paper/studies/day_study.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "gem/analysis/statistics/bootstrap.h"

namespace gem {
namespace {

constexpr std::string_view kDay = "day_";
constexpr std::size_t kStretches = 6;  // per hour
static_assert(kStretches * kBlockLength == 3600.0);
constexpr std::size_t kFirstHours = 2, kLeastHours = 6;

/// The hours of a run: swing and mean of each.
struct Hours {
  std::vector<double> swing, mean;

  explicit Hours(const RunBlocks& blocks) {
    for (std::size_t first = 0; first + kStretches <= blocks.count(); first += kStretches) {
      double square = 0.0, sum = 0.0;
      for (std::size_t k = first; k < first + kStretches; ++k) {
        square += blocks.deviation_x[k] * blocks.deviation_x[k] / kStretches;
        sum += blocks.mean_x[k] / kStretches;
      }
      swing.push_back(std::sqrt(square));
      mean.push_back(sum);
    }
  }
};

}  // namespace

std::vector<DayRow> day_study(const PaperFolder& folder) {
  std::vector<DayRow> rows;
  for (const auto& [condition, runs] : folder.conditions) {
    if (!condition.starts_with(kDay)) continue;
    const RunBlocks& blocks = runs.front().blocks;
    const Hours hours(blocks);
    const std::size_t count = hours.swing.size();
    if (count < kLeastHours) continue;
    const std::span<const double> swing(hours.swing), later = swing.subspan(kFirstHours);
    const std::size_t half = later.size() / 2;
    DayRow row;
    row.day = condition;
    row.condition = condition.substr(kDay.size());
    row.hours = static_cast<double>(count);
    row.first = mean_of_runs(swing.first(kFirstHours));
    row.middle = mean_of_runs(later.first(half));
    row.last = mean_of_runs(later.last(half));
    row.mean_x = mean_of_runs(std::span<const double>(hours.mean).subspan(kFirstHours));
    row.largest_excursion = *std::max_element(blocks.largest_excursion.begin(), blocks.largest_excursion.end());
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace gem
