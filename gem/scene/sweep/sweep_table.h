// A table of a sweep file, read with messages that name key and place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gem/scene/toml/toml_tree.h"

namespace gem {

/// All members throw Error(scene_rejected) "place: key: problem". The node must outlive the table.
class SweepTable {
 public:
  /// `name` is the path of the table: "sweep.draw".
  SweepTable(const TomlNode& node, std::string name);

  const TomlPlace& place() const { return node_.key_place; }
  std::string path(const std::string& key) const { return name_ + "." + key; }
  const TomlNode* find(const std::string& key) const { return node_.find(key); }
  /// The value of a key that must be there.
  const TomlNode& need(const std::string& key, const std::string& hint) const;

  double number(const TomlNode& node, const std::string& key) const;
  std::optional<double> number(const std::string& key) const;
  double needed_number(const std::string& key) const;
  double positive_number(const std::string& key) const;
  std::int64_t integer(const std::string& key, std::int64_t low, std::int64_t high, std::int64_t otherwise) const;
  /// Index of a choice.
  std::size_t choice(const TomlNode& node, const std::string& key, const std::vector<std::string>& names) const;
  /// A list that must be there, with 1 to 10,000 items.
  const std::vector<TomlNode>& list(const std::string& key, const std::string& hint) const;
  /// Refuses keys that mean nothing here.
  void only(const std::vector<std::string>& known) const;

  [[noreturn]] static void wrong_type(const TomlNode& node, const std::string& key, const std::string& expected);

 private:
  const TomlNode& node_;
  std::string name_;
};

}  // namespace gem
