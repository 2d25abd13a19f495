// Writes the numbers of a draw table into the cases of a sweep.
#include "gem/scene/sweep/member_draws.h"

#include "gem/base/error.h"
#include "gem/scene/sweep/sweep_draft.h"

namespace gem {
namespace {

constexpr std::size_t numbers_maximum = 2'000'000;  // about 400 MB in memory

}  // namespace

MemberDraws::MemberDraws(const TomlNode& sweep, std::size_t drafts) {
  const TomlNode* draw = sweep.find("draw");
  if (draw == nullptr) return;
  table_ = read_draw_table(*draw);
  if (table_->size() * drafts > members_maximum)
    throw Error(ExitCode::scene_rejected, to_string(draw->key_place) + ": sweep.draw: too many runs (" +
                                              std::to_string(table_->size()) + " for each of " +
                                              std::to_string(drafts) + " cases, allowed " +
                                              std::to_string(members_maximum) + " in all); lower count or repeats");
  if (table_->size() * drafts * table_->variables.size() > numbers_maximum)
    throw Error(ExitCode::scene_rejected, to_string(draw->key_place) + ": sweep.draw: too many drawn numbers in all (" +
                                              std::to_string(table_->variables.size()) + " variables in " +
                                              std::to_string(table_->size() * drafts) + " runs, allowed " +
                                              std::to_string(numbers_maximum) + "); lower count or draw less");
  sets_ = table_->sets();
}

void MemberDraws::check_unset(const TomlNode& settings) const {
  if (!table_) return;
  for (const DrawVariable& variable : table_->variables)
    if (!variable.is_factor && sets_target(settings, variable.target))
      throw Error(ExitCode::scene_rejected,
                  to_string(variable.place) + ": sweep.draw.variable." + variable.name + ": " + variable.target.key +
                      " is drawn, and set as well; leave out one of them, or draw a factor with as = \"factor\"");
}

void MemberDraws::apply(std::size_t i, SweepMember& member, TomlNode& tree) const {
  if (!table_) return;
  const DrawnSet& set = sets_[i];
  member.draw.condition = member.name;
  member.draw.draw = static_cast<std::int64_t>(set.draw);
  member.draw.part = set.part;
  member.draw.repeat = static_cast<std::int64_t>(set.repeat);
  member.name += (member.name.empty() ? "" : "_") + set.name(table_->repeats);
  for (std::size_t k = 0; k < table_->variables.size(); ++k) {
    const DrawVariable& variable = table_->variables[k];
    write_draw(tree, variable.target, set.values[k], variable.is_factor, variable.place);
    member.draw.values.push_back({variable.name, variable.target.key,
                                  (variable.is_factor ? "times " : "") + variable.distribution.text(), set.values[k]});
  }
}

}  // namespace gem
