// Reads [sweep.draw]. Every mistake is reported with its place.
#include "gem/scene/sweep/draw_table.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "gem/base/number_text.h"
#include "gem/scene/problems.h"
#include "gem/scene/sweep/reject_key.h"
#include "gem/scene/sweep/sweep_table.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

constexpr std::int64_t count_maximum = 100000;  // as many as a sweep may have runs
constexpr std::int64_t repeats_maximum = 1000;
constexpr std::int64_t seed_maximum = std::int64_t{1} << 53;
constexpr std::size_t variables_maximum = 100;
constexpr std::size_t name_maximum = 40;
constexpr double share_minimum = 1e-3;  // of a law between its bounds; less is a mistake
const std::string seed_key = "run.seed";

void read_bounds(const SweepTable& table, Distribution& law) {
  law.low = table.number("low").value_or(-Distribution::infinity);
  law.high = table.number("high").value_or(Distribution::infinity);
  if (!(law.low < law.high))
    reject_key(table.place(), table.path("low"),
               "not below high (low " + number_text(law.low) + ", high " + number_text(law.high) + ")");
}

void read_moments(const SweepTable& table, Distribution& law) {
  table.only({"key", "as", "law", "mean", "deviation", "low", "high"});
  law.mean = law.law == Distribution::Law::lognormal ? table.positive_number("mean") : table.needed_number("mean");
  law.deviation = table.positive_number("deviation");
  read_bounds(table, law);
}

void read_quantiles(const SweepTable& table, Distribution& law) {
  const std::string hint = "give [[0, lowest], [probability, value], ..., [1, highest]], both ascending";
  table.only({"key", "as", "law", "quantiles"});
  for (const TomlNode& row : table.list("quantiles", hint)) {
    if (row.kind != TomlKind::list || row.items.size() != 2)
      SweepTable::wrong_type(row, table.path("quantiles"), "a pair");
    law.quantiles.emplace_back(table.number(row.items[0], "quantiles"), table.number(row.items[1], "quantiles"));
    const auto& q = law.quantiles;
    if (q.size() > 1 && !(q.back().first > q[q.size() - 2].first && q.back().second >= q[q.size() - 2].second))
      reject_key(row.place, table.path("quantiles"), "not ascending (value " + describe(row) + ") " + hint);
  }
  if (law.quantiles.size() < 2 || law.quantiles.front().first != 0.0 || law.quantiles.back().first != 1.0)
    reject_key(table.find("quantiles")->place, table.path("quantiles"),
               "the probabilities do not go from 0 to 1; " + hint);
}

void read_values(const SweepTable& table, Distribution& law) {
  table.only({"key", "as", "law", "values", "weights"});
  for (const TomlNode& item : table.list("values", "give a list of numbers"))
    law.values.push_back(table.number(item, "values"));
  law.weights.assign(law.values.size(), 1.0);
  if (table.find("weights") == nullptr) return;
  const auto& weights = table.list("weights", "give one number for each value");
  if (weights.size() != law.values.size())
    reject_key(table.find("weights")->place, table.path("weights"),
               "not one for each value (" + std::to_string(weights.size()) + " weights, " +
                   std::to_string(law.values.size()) + " values)");
  for (std::size_t i = 0; i < weights.size(); ++i) {
    law.weights[i] = table.number(weights[i], "weights");
    if (!(law.weights[i] > 0.0))
      reject_key(weights[i].place, table.path("weights"),
                 "out of range (value " + describe(weights[i]) + ", allowed above 0); leave out what never occurs");
  }
}

Distribution read_law(const SweepTable& table) {
  static const std::vector<std::string> names = {"uniform", "normal", "lognormal", "quantiles", "values"};
  const std::string hint = "give one of uniform, normal, lognormal, quantiles, values";
  Distribution law;
  law.law = static_cast<Distribution::Law>(table.choice(table.need("law", hint), "law", names));
  switch (law.law) {
    case Distribution::Law::uniform:
      table.only({"key", "as", "law", "low", "high"});
      table.needed_number("low");
      table.needed_number("high");
      read_bounds(table, law);
      break;
    case Distribution::Law::normal:
    case Distribution::Law::lognormal:
      read_moments(table, law);
      break;
    case Distribution::Law::quantiles:
      read_quantiles(table, law);
      break;
    case Distribution::Law::values:
      read_values(table, law);
      break;
  }
  return law;
}

bool is_whole(double value) { return !std::isfinite(value) || std::floor(value) == value; }

void check_whole(const SweepTable& table, const DrawVariable& variable) {
  const Distribution& law = variable.distribution;
  if (!law.whole) return;
  const bool whole =
      is_whole(law.lowest()) && is_whole(law.highest()) && std::all_of(law.values.begin(), law.values.end(), is_whole);
  if (!whole)
    reject_key(table.place(), table.path("law"),
               variable.target.key + " is an integer; give whole numbers as its bounds and values");
}

/// A value that the case refuses would only show up in some of the runs.
void check_range(const SweepTable& table, const DrawVariable& variable) {
  const Distribution& law = variable.distribution;
  const Range& range = variable.target.range;
  if (variable.is_factor) {
    if (!(law.lowest() >= 0.0))
      reject_key(table.place(), table.path("law"), "factors below 0 may be drawn; set low = 0.0");
    return;
  }
  const bool open = law.law == Distribution::Law::lognormal && law.lowest() == 0.0;  // 0 itself never occurs
  if ((range.contains(law.lowest()) || (open && range.low <= 0.0)) && range.contains(law.highest())) return;
  reject_key(table.place(), table.path("law"),
             "values outside the range of " + variable.target.key + " may be drawn (" + law.text() + ", allowed " +
                 range_text(range, variable.target.unit) + "); set low and high");
}

DrawVariable read_variable(const std::string& name, const TomlNode& node) {
  const SweepTable table(node, "sweep.draw.variable." + name);
  if (!is_variable_name(name))
    reject_key(node.key_place, "sweep.draw.variable",
               "not a name (value " + quoted_text(name) + "); use at most " + std::to_string(name_maximum) +
                   " letters, digits, _ and -");
  DrawVariable variable;
  variable.name = name;
  variable.place = node.key_place;
  const TomlNode& key = table.need("key", "give the key of a number, such as \"ice.friction_ice\"");
  if (key.kind != TomlKind::text) SweepTable::wrong_type(key, table.path("key"), "text in quotes");
  variable.target = draw_target(key, table.path("key"));
  if (const TomlNode* as = table.find("as")) variable.is_factor = table.choice(*as, "as", {"value", "factor"}) == 1;
  variable.distribution = read_law(table);
  variable.distribution.whole = variable.target.whole && !variable.is_factor;
  check_whole(table, variable);
  check_range(table, variable);
  const double share = variable.distribution.prepare();
  if (!(share >= share_minimum))
    reject_key(table.place(), table.path("law"),
               "hardly a value lies between the bounds (" + variable.distribution.text() + "; share " +
                   number_text(share, 2) + "); correct mean, deviation or bounds");
  return variable;
}

void check_repeats(const SweepTable& table, const DrawTable& draw) {
  if (draw.repeats == 1) return;
  if (draw.design.sampling == Sampling::saltelli)
    reject_key(table.find("repeats")->place, table.path("repeats"),
               "not with sampling = \"saltelli\", whose indices hold the seeds as a variable; leave it out");
  const bool seeded = std::any_of(draw.variables.begin(), draw.variables.end(),
                                  [](const DrawVariable& variable) { return variable.target.key == seed_key; });
  if (!seeded)
    reject_key(table.find("repeats")->place, table.path("repeats"),
               "the repeats would be the same run (only run.seed differs between them); add a variable with key = "
               "\"run.seed\"");
}

void check_keys(const DrawTable& draw) {
  std::set<std::string> keys;
  for (const DrawVariable& variable : draw.variables)
    if (!keys.insert(variable.target.key).second)
      reject_key(variable.place, "sweep.draw.variable." + variable.name,
                 "another variable draws " + variable.target.key + " already; draw it once");
}

/// The runs of a Saltelli design are named A, B and by the variables.
void check_names(const DrawTable& draw) {
  if (draw.design.sampling != Sampling::saltelli) return;
  for (const DrawVariable& variable : draw.variables)
    if (variable.name == "A" || variable.name == "B")
      reject_key(variable.place, "sweep.draw.variable",
                 "the name of a set of the saltelli design (value \"" + variable.name + "\"); choose another name");
}

}  // namespace

bool is_variable_name(const std::string& text) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !text.empty() && text.size() <= name_maximum && std::all_of(text.begin(), text.end(), is_plain);
}

DrawTable read_draw_table(const TomlNode& node) {
  const SweepTable table(node, "sweep.draw");
  table.only({"count", "seed", "sampling", "repeats", "variable"});
  DrawTable draw;
  table.need("count", "give the number of draws");
  draw.design.count = static_cast<std::size_t>(table.integer("count", 1, count_maximum, 1));
  draw.design.seed = static_cast<std::uint64_t>(table.integer("seed", 0, seed_maximum, 1));
  draw.repeats = static_cast<std::size_t>(table.integer("repeats", 1, repeats_maximum, 1));
  if (const TomlNode* sampling = table.find("sampling"))
    draw.design.sampling =
        static_cast<Sampling>(table.choice(*sampling, "sampling", {"random", "latin_hypercube", "saltelli"}));
  const TomlNode& variables = table.need("variable", "give [sweep.draw.variable.NAME] with key and law");
  if (variables.kind != TomlKind::table) SweepTable::wrong_type(variables, "sweep.draw.variable", "a table");
  if (variables.entries.empty() || variables.entries.size() > variables_maximum)
    reject_key(variables.key_place, "sweep.draw.variable",
               "wrong number of variables (value " + std::to_string(variables.entries.size()) + ", allowed [1, " +
                   std::to_string(variables_maximum) + "])");
  for (const auto& [name, variable] : variables.entries) draw.variables.push_back(read_variable(name, variable));
  check_names(draw);
  check_keys(draw);
  check_repeats(table, draw);
  return draw;
}

}  // namespace gem
