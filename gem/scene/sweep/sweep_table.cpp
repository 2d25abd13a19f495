// Reads values of a sweep table and refuses what does not fit.
#include "gem/scene/sweep/sweep_table.h"

#include <algorithm>
#include <cmath>

#include "gem/scene/problems.h"
#include "gem/scene/sweep/reject_key.h"

namespace gem {
namespace {

constexpr std::size_t rows_maximum = 10000;
constexpr double number_maximum = 1e15;

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

SweepTable::SweepTable(const TomlNode& node, std::string name) : node_(node), name_(std::move(name)) {
  if (node.kind != TomlKind::table) wrong_type(node, name_, "a table");
}

const TomlNode& SweepTable::need(const std::string& key, const std::string& hint) const {
  const TomlNode* found = node_.find(key);
  if (found == nullptr) reject_key(node_.key_place, path(key), "missing; " + hint);
  return *found;
}

void SweepTable::wrong_type(const TomlNode& node, const std::string& key, const std::string& expected) {
  reject_key(node.place, key, "wrong type (value " + describe(node) + ", expected " + expected + ")");
}

double SweepTable::number(const TomlNode& node, const std::string& key) const {
  const bool whole = node.kind == TomlKind::integer;
  if (!whole && node.kind != TomlKind::number) wrong_type(node, path(key), "a number");
  const double value = whole ? static_cast<double>(node.integer) : node.number;
  if (!(std::abs(value) <= number_maximum))
    reject_key(node.place, path(key), "out of range (value " + describe(node) + ", allowed [-1e15, 1e15])");
  return value;
}

std::optional<double> SweepTable::number(const std::string& key) const {
  const TomlNode* found = find(key);
  if (found == nullptr) return std::nullopt;
  return number(*found, key);
}

double SweepTable::needed_number(const std::string& key) const { return number(need(key, "give a number"), key); }

double SweepTable::positive_number(const std::string& key) const {
  const double value = needed_number(key);
  if (!(value > 0.0))
    reject_key(find(key)->place, path(key), "out of range (value " + describe(*find(key)) + ", allowed above 0)");
  return value;
}

std::int64_t SweepTable::integer(const std::string& key, std::int64_t low, std::int64_t high,
                                 std::int64_t otherwise) const {
  const TomlNode* node = find(key);
  if (node == nullptr) return otherwise;
  if (node->kind != TomlKind::integer) wrong_type(*node, path(key), "an integer");
  if (node->integer < low || node->integer > high)
    reject_key(node->place, path(key),
               "out of range (value " + describe(*node) + ", allowed [" + std::to_string(low) + ", " +
                   std::to_string(high) + "])");
  return node->integer;
}

std::size_t SweepTable::choice(const TomlNode& node, const std::string& key,
                               const std::vector<std::string>& names) const {
  if (node.kind != TomlKind::text) wrong_type(node, path(key), "text in quotes");
  const auto found = std::find(names.begin(), names.end(), node.text);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  reject_key(
      node.place, path(key),
      "unknown choice (value " + describe(node) + ", allowed " + joined(names) + ")" + suggestion(node.text, names));
}

const std::vector<TomlNode>& SweepTable::list(const std::string& key, const std::string& hint) const {
  const TomlNode& node = need(key, hint);
  if (node.kind != TomlKind::list || node.items.empty() || node.items.size() > rows_maximum)
    reject_key(node.place, path(key), "wrong list (value " + describe(node) + ") " + hint);
  return node.items;
}

void SweepTable::only(const std::vector<std::string>& known) const {
  for (const auto& [key, value] : node_.entries)
    if (std::find(known.begin(), known.end(), key) == known.end())
      reject_key(value.key_place, path(key), "unknown key (known are " + joined(known) + ")" + suggestion(key, known));
}

}  // namespace gem
