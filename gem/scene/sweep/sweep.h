// Sweeps: one file that stands for many runs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gem/scene/scene_def.h"
#include "gem/scene/toml/toml_tree.h"

namespace gem {

/// One run of a sweep.
struct SweepMember {
  std::int64_t index = 0;  ///< from 1, in the order of the file
  std::string name;
  SceneDef scene;
  std::vector<std::string> differences;  ///< from the rest of the file: "key=value" in TOML syntax
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
/// Either may carry seeds = { count = 20, first = 1 }: each run is repeated with that many seeds.
/// Overrides go to every member, or to the table itself ("sweep.seeds.count=20").
/// Throws Error(scene_rejected) with the place of each fault.
std::vector<SweepMember> expand_sweep(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same from a document of load_document().
std::vector<SweepMember> expand_sweep(TomlNode document, const std::vector<std::string>& overrides);

/// The same from text.
std::vector<SweepMember> expand_sweep_text(const std::string& text, const std::string& origin,
                                           const std::vector<std::string>& overrides = {});

}  // namespace gem
