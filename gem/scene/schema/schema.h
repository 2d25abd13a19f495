// The only table of options. Reading, defaults, checks, messages, `explain` and the JSON Schema use it.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "gem/scene/scene_def.h"

namespace gem {

enum class OptionType { number, integer, text, choice, flag, pair, outline, table };

/// Allowed values. A pair has one range for both components, an outline one for all coordinates.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  ///< true: the bound itself is not allowed
  bool high_open = false;

  bool contains(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
  }
};

inline constexpr Range place_range = {-1e6, 1e6};                                    // of a coordinate [m]
inline constexpr Range floe_size_range = {0.1, 1000.0};                              // root of the area [m]
inline constexpr double concentration_minimum = 0.05, concentration_maximum = 0.95;  // of a generated field [-]
inline constexpr Range thickness_range = {0.01, 10.0};                               // of ice [m]
inline constexpr Range speed_range = {-10.0, 10.0};                                  // of one component [m/s]
inline constexpr Range spin_range = {-10.0, 10.0};                                   // [rad/s]

/// "[0, 1)" with the unit.
std::string range_text(const Range& range, const std::string& unit);

/// OptionRows of a table, each with one number for each of its columns.
using OptionRows = std::vector<std::vector<double>>;

/// One column of a table.
struct OptionColumn {
  std::string name, unit;
  Range range;
};

/// Alternatives in the order of OptionType; text and choice are both strings.
using OptionValue = std::variant<double, std::int64_t, std::string, bool, Vec2, std::vector<Vec2>, OptionRows>;

/// Allowed number of corners of an outline.
inline constexpr std::size_t listed_corners_minimum = 3;
inline constexpr std::size_t listed_corners_maximum = 20;
inline constexpr std::size_t platform_corners_maximum = 256;  // of the platform
inline constexpr std::size_t platform_pieces_maximum = 64;

/// A choice that another option must have. An empty key: none.
struct NeededChoice {
  std::string key, choice;
};

/// An option without its place in a scene.
struct OptionInfo {
  std::string path;  ///< "section.key" of the scene; the bare key in a list
  OptionType type = OptionType::number;
  std::string unit;  ///< "" without dimension
  Range range;
  std::vector<std::string> choices;
  std::string doc;
  std::string why = "";                    ///< reason for the range, for the message; may be empty
  std::vector<OptionColumn> columns = {};  ///< of a table
  bool opt_in = false;  ///< not written where it has its default, so that cases without it keep their hash
  std::size_t corners_maximum = listed_corners_maximum;  ///< of an outline
  NeededChoice counts_with = {};                         ///< without it the option may not be given, and is not written
};

template <class T>
struct Option : OptionInfo {
  std::function<OptionValue(const T&)> get;
  std::function<void(T&, const OptionValue&)> set;
};

/// Every option of a scene except those in lists, grouped by section, in the order of SceneDef.
const std::vector<Option<SceneDef>>& scene_options();

/// Whether the choice is made that the option needs to count.
bool counts(const OptionInfo& option, const SceneDef& scene);

/// Allowed number of rows of a table.
inline constexpr std::size_t table_rows_maximum = 100000;

/// "[time s, x m/s, y m/s]".
std::string columns_text(const std::vector<OptionColumn>& columns);

/// The lists [[ice.class]], [[platform.piece]], [[dp.thruster]], [[floe]] and [[fixed]].
const std::vector<Option<IceClassDef>>& ice_class_options();
const std::vector<Option<PlatformPieceDef>>& platform_piece_options();
const std::vector<Option<ThrusterDef>>& thruster_options();
const std::vector<Option<FloeDef>>& floe_options();
const std::vector<Option<FixedDef>>& fixed_options();

/// A key that had another name in older files. Both names are read; a run reports the old one in a line.
struct RenamedKey {
  const char *section, *old_name, *name;
};
const std::vector<RenamedKey>& renamed_keys();

/// The value as TOML text.
std::string value_text(const OptionValue& value);

/// "number", "choice", ...
std::string type_name(OptionType type);

}  // namespace gem
