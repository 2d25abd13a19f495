// The runs of a draw table: which variable takes which number.
#include "gem/scene/sweep/draw_table.h"

namespace gem {
namespace {

using Numbers = std::vector<std::vector<double>>;  // of each variable, for each draw

std::vector<double> values_of(const DrawTable& table, const Numbers& numbers, std::size_t draw) {
  std::vector<double> values;
  for (std::size_t k = 0; k < table.variables.size(); ++k)
    values.push_back(table.variables[k].distribution.quantile(numbers[k][draw]));
  return values;
}

/// A and B are independent; the others are A with one variable from B (Saltelli 2002).
std::vector<DrawnSet> saltelli_sets(const DrawTable& table) {
  Numbers first, second;
  for (const DrawVariable& variable : table.variables) {
    first.push_back(draw_numbers(table.design, variable.name));
    second.push_back(second_draw_numbers(table.design, variable.name));
  }
  std::vector<DrawnSet> sets;
  for (std::size_t i = 0; i < table.design.count; ++i) {
    const std::vector<double> a = values_of(table, first, i), b = values_of(table, second, i);
    sets.push_back({i + 1, "A", 1, a});
    sets.push_back({i + 1, "B", 1, b});
    for (std::size_t k = 0; k < table.variables.size(); ++k) {
      sets.push_back({i + 1, table.variables[k].name, 1, a});
      sets.back().values[k] = b[k];
    }
  }
  return sets;
}

/// Repeats differ in the seed of the field alone.
std::vector<DrawnSet> plain_sets(const DrawTable& table) {
  std::vector<Numbers> numbers(table.repeats);
  for (std::size_t repeat = 0; repeat < table.repeats; ++repeat)
    for (const DrawVariable& variable : table.variables)
      numbers[repeat].push_back(
          draw_numbers(table.design, variable.name, variable.target.key == "run.seed" ? repeat : 0));
  std::vector<DrawnSet> sets;
  for (std::size_t i = 0; i < table.design.count; ++i)
    for (std::size_t repeat = 0; repeat < table.repeats; ++repeat)
      sets.push_back({i + 1, "", repeat + 1, values_of(table, numbers[repeat], i)});
  return sets;
}

}  // namespace

std::string DrawnSet::name(std::size_t repeats) const {
  std::string name = "d" + std::to_string(draw);
  if (!part.empty()) name += "_" + part;
  if (repeats > 1) name += "_r" + std::to_string(repeat);
  return name;
}

std::size_t DrawTable::size() const {
  return design.count * (design.sampling == Sampling::saltelli ? variables.size() + 2 : repeats);
}

std::vector<DrawnSet> DrawTable::sets() const {
  return design.sampling == Sampling::saltelli ? saltelli_sets(*this) : plain_sets(*this);
}

}  // namespace gem
