// Repeats every run of a sweep with drawn numbers.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "gem/scene/sweep/draw_table.h"
#include "gem/scene/sweep/sweep.h"

namespace gem {

/// The draws of a sweep; without [sweep.draw] each draft is one run as it is.
class MemberDraws {
 public:
  /// Throws Error(scene_rejected) for a table with faults, or if the sweep becomes too large.
  MemberDraws(const TomlNode& sweep, std::size_t drafts);

  /// Number of runs of a draft.
  std::size_t per_draft() const { return table_ ? sets_.size() : 1; }
  /// Throws Error(scene_rejected) if settings give a key that is drawn: they would have no effect.
  void check_unset(const TomlNode& settings) const;
  /// Writes draw `i` into the case of a member, its name and its list of drawn values.
  void apply(std::size_t i, SweepMember& member, TomlNode& tree) const;

 private:
  std::optional<DrawTable> table_;
  std::vector<DrawnSet> sets_;
};

}  // namespace gem
