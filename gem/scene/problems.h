// Collects all problems of a scene, so that a user sees them together.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/toml/toml_tree.h"

namespace gem {

class Problems {
 public:
  /// One line: "place: key: problem".
  void add(const TomlPlace& place, const std::string& key, const std::string& problem);
  bool empty() const { return lines_.empty(); }
  /// Throws Error(scene_rejected) with one line per problem, if there is any.
  void throw_if_any() const;

 private:
  std::vector<std::string> lines_;
};

/// The candidate closest to a mistyped name, or "" if none is close. Candidates may be dotted paths.
std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

/// "; did you mean `x`?" or "" if nothing is close.
std::string suggestion(const std::string& name, const std::vector<std::string>& candidates);

/// "; did you mean `x`?" for a key of a case, or if nothing is close where its section or all keys are listed.
std::string suggestion_or_list(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace gem
