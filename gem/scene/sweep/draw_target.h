// The number of a case that a sweep draws.
#pragma once

#include <string>

#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/toml_tree.h"

namespace gem {

/// Where a drawn number goes: an option, one component of a pair, or one key of all entries of a list.
struct DrawTarget {
  std::string key;   // as the sweep file names it
  std::string path;  // of the option, or of the list
  std::string unit;
  Range range;
  bool whole = false;  // an integer
  int component = -1;  // of a pair: 0 (x) or 1 (y)
  std::string entry;   // key in each entry of a list; empty for an option
  double usual = 0.0;  // the value where a case gives none
};

/// The target of "section.key", "section.key.x" or "list.key". Throws Error(scene_rejected) with the place of `node`,
/// named `what` in the message, if the key is unknown or no number.
DrawTarget draw_target(const TomlNode& node, const std::string& what);

/// Writes a number into a case, or multiplies the number that is there. Throws Error(scene_rejected) if the case has no
/// entry of the list, or something that is no number.
void write_draw(TomlNode& document, const DrawTarget& target, double value, bool is_factor, const TomlPlace& place);

/// Whether a document or a part of it sets the target.
bool sets_target(const TomlNode& document, const DrawTarget& target);

}  // namespace gem
