// Sweeps: one file that stands for many runs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gem/scene/scene_def.h"
#include "gem/scene/toml/toml_tree.h"

namespace gem {

/// One number that was drawn for a run.
struct DrawnValue {
  std::string variable;
  std::string key;
  std::string law;  ///< in words: "uniform from 0.1 to 0.5", "times normal, mean 1, ..." for a factor
  double value = 0.0;
};

/// What was drawn for a run; no draw without [sweep.draw].
struct SweepDraw {
  std::string condition;    ///< name of the run without its draw; empty for a sweep that is one case
  std::int64_t draw = 0;    ///< from 1; 0: nothing is drawn
  std::string part;         ///< of a Saltelli design: "A", "B" or the variable that comes from B
  std::int64_t repeat = 1;  ///< from 1
  std::vector<DrawnValue> values;
};

/// One run of a sweep.
struct SweepMember {
  std::int64_t index = 0;  ///< from 1, in the order of the file
  std::string name;
  SceneDef scene;
  std::vector<std::string> differences;  ///< from the rest of the file: "key=value" in TOML syntax
  SweepDraw draw = {};
};

/// Whether the file (or one that it includes) has a [sweep] table. Throws like read_scene if it cannot be read.
bool is_sweep(const std::string& path);

/// All runs of a sweep file, checked. The table is written in one of two ways.
///
/// [sweep]                                  # every combination, the last axis runs fastest
/// mode = "product"
/// name = "{ice}_{gap}"                     # {axis} is replaced by the value
/// ice = ["thin", "thick"]                  # an axis: any other key with a list
/// gap = [400, 300]
/// map = { gap = "boundary.gap_m" }         # the value itself is given to an option
/// set.ice.thin.ice.class = [...]           # or each value stands for settings
/// set."ice,gap"."thin,400".run = { ... }   # or each combination of values
///
/// [sweep]                                  # a list
/// mode = "list"
/// [[sweep.run]]
/// name = "first"                           # the other keys are settings
///
/// Either may carry seeds = { count = 20, first = 1 }: each run is repeated with that many seeds. Or it has a table of
/// draws: each run is repeated with numbers from distributions. mode = "draw" does so with the case itself.
///
/// [sweep.draw]
/// count = 64                               # draws; sampling = "latin_hypercube" | "random" | "saltelli"
/// seed = 1                                 # of the draws
/// repeats = 2                              # of each draw, with another run.seed
/// [sweep.draw.variable.friction]
/// key = "ice.friction_ice"                 # any number: section.key, section.key.x, ice.class.key
/// law = "uniform"                          # | normal | lognormal | quantiles | values
/// low = 0.1
/// high = 0.5                               # as = "factor" multiplies what the case has
///
/// Overrides go to every member, or to the table itself ("sweep.seeds.count=20").
/// Throws Error(scene_rejected) with the place of each fault.
std::vector<SweepMember> expand_sweep(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same from a document of load_document().
std::vector<SweepMember> expand_sweep(TomlNode document, const std::vector<std::string>& overrides);

/// The same from text.
std::vector<SweepMember> expand_sweep_text(const std::string& text, const std::string& origin,
                                           const std::vector<std::string>& overrides = {});

}  // namespace gem
