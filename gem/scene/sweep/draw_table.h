// The table [sweep.draw]: variables with their distributions, and the numbers that are drawn from them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gem/scene/sweep/distribution.h"
#include "gem/scene/sweep/draw_design.h"
#include "gem/scene/sweep/draw_target.h"

namespace gem {

struct DrawVariable {
  std::string name;
  DrawTarget target;
  bool is_factor = false;  // multiplies what the case has
  Distribution distribution;
  TomlPlace place;
};

/// One run of each case of the sweep.
struct DrawnSet {
  std::size_t draw = 1;    // from 1
  std::string part;        // Saltelli: "A", "B" or the variable that is taken from B; else empty
  std::size_t repeat = 1;  // from 1
  std::vector<double> values;

  /// "d3", "d3_r2", "d3_A".
  std::string name(std::size_t repeats) const;
};

struct DrawTable {
  DrawDesign design;
  std::size_t repeats = 1;
  std::vector<DrawVariable> variables;

  /// Number of runs of each case.
  std::size_t size() const;
  std::vector<DrawnSet> sets() const;
};

/// Whether a text is the name of a variable: at most 40 letters, digits, _ and -. It stands in names of files.
bool is_variable_name(const std::string& text);

/// Reads and checks the table. Throws Error(scene_rejected) with the place of the fault.
DrawTable read_draw_table(const TomlNode& draw);

}  // namespace gem
