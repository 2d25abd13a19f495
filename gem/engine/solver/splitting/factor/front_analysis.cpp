// The fronts of a factor: what they hold, where their numbers stand, and which part each is of.
#include "gem/engine/solver/splitting/factor/front_factor.h"

#include <algorithm>

#include "gem/engine/solver/splitting/factor/front_panels.h"

namespace gem {
namespace {

/// Work of a front for each of its bodies, in blocks of the factor. Chosen by hand; affects only speed.
constexpr double work_of_a_body = 2.0;

std::int32_t whole_packs(std::int32_t numbers) { return (numbers + float_lanes - 1) / float_lanes * float_lanes; }

}  // namespace

/// The others of a front: later bodies in contact with its own, and the others of its children.
void FrontFactor::find_others(std::span<const std::pair<std::int32_t, std::int32_t>> pairs, std::int32_t node) {
  Front& f = front_[node];
  const std::int32_t end = f.place + f.own;
  f.first_other = static_cast<std::int32_t>(other_place_.size());
  const auto take = [&](std::int32_t place) {
    if (place < end || mark_[place] == node) return;
    mark_[place] = node;
    other_place_.push_back(place);
  };
  for (std::int32_t k = first_pair_[f.place]; k < first_pair_[end]; ++k) take(pairs[k].second);
  for (std::int32_t child = first_child_[node]; child >= 0; child = next_child_[child]) {
    const Front& c = front_[child];
    for (std::int32_t k = 0; k < c.others; ++k) take(other_place_[c.first_other + k]);
  }
  std::sort(other_place_.begin() + f.first_other, other_place_.end());
  f.others = static_cast<std::int32_t>(other_place_.size()) - f.first_other;
}

/// First row of a body in the columns of a front. The rows of the others follow those of the own bodies.
std::int32_t FrontFactor::row_in(const Front& f, std::int32_t place) const {
  if (place < f.place + f.own) return motions * (place - f.place);
  const auto begin = other_place_.begin() + f.first_other;
  return f.own_rows + motions * static_cast<std::int32_t>(std::lower_bound(begin, begin + f.others, place) - begin);
}

void FrontFactor::list_children(const EliminationTree& tree) {
  const auto nodes = static_cast<std::int32_t>(tree.node.size());
  first_child_.assign(nodes, -1);
  next_child_.assign(nodes, -1);
  for (std::int32_t k = nodes - 1; k >= 0; --k) {
    const std::int32_t parent = tree.node[k].parent;
    if (parent < 0) continue;
    next_child_[k] = first_child_[parent];
    first_child_[parent] = k;
  }
}

/// Divides the fronts among parts, and finds which sums they keep for the trunk.
void FrontFactor::divide(const EliminationTree& tree, std::int32_t parts) {
  work_.resize(front_.size());
  for (std::size_t k = 0; k < front_.size(); ++k) {
    const Front& f = front_[k];
    const double own = f.own, others = f.others;
    work_[k] = own * (own + 2.0 * others) + work_of_a_body * (own + others);
  }
  divide_tree(tree, work_, parts, parts_);
  keeping_.clear();
  std::int32_t kept = 0;
  for (std::size_t k = 0; k < front_.size(); ++k) {
    Front& f = front_[k];
    f.adds = f.others;
    f.first_kept = kept;
    if (parts_.part_of[k] == trunk()) continue;
    while (f.adds > 0 && parts_.part_of[node_of_place_[other_place_[f.first_other + f.adds - 1]]] == trunk()) --f.adds;
    kept += f.others - f.adds;
    if (f.adds < f.others) keeping_.push_back(static_cast<std::int32_t>(k));
  }
  kept_.resize(static_cast<std::size_t>(row_numbers) * kept);
}

void FrontFactor::make_space(std::size_t bodies, std::size_t pairs, std::int32_t parts) {
  std::int32_t most_rows = 0, most_others = 0, most_own = 0;
  std::size_t forth = 0, back = 0;
  for (Front& f : front_) {
    f.forth = forth;
    f.back = back;
    forth += static_cast<std::size_t>(f.other_rows) * motions * f.own;
    back += static_cast<std::size_t>(f.own_rows) * motions * (f.own + f.others);
    most_rows = std::max(most_rows, f.own_rows + f.other_rows);
    most_own = std::max(most_own, f.own);
    most_others = std::max(most_others, f.others);
  }
  diagonal_.resize(block * bodies);
  below_.resize(block * pairs);
  forth_.resize(forth);
  back_.resize(back);
  waiting_from_.resize(front_.size());
  memory_.resize(parts + 1);
  for (Memory& m : memory_) {
    for (std::vector<float>& numbers : m.dense) numbers.resize(most_rows + float_lanes);  // a body is copied as four
    for (std::vector<float>& numbers : m.product) numbers.resize(most_rows + float_lanes);
    m.own_columns.resize(static_cast<std::size_t>(most_rows) * (motions * most_own + 1));
    m.other_columns.resize(static_cast<std::size_t>(whole_packs(motions * most_others)) * motions * most_others);
  }
}

void FrontFactor::analyse(const EliminationTree& tree, std::span<const std::pair<std::int32_t, std::int32_t>> pairs,
                          std::int32_t parts) {
  const auto nodes = static_cast<std::int32_t>(tree.node.size());
  const auto bodies = static_cast<std::int32_t>(tree.order.size());
  first_pair_.assign(bodies + 1, 0);
  later_.resize(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    ++first_pair_[pairs[k].first + 1];
    later_[k] = pairs[k].second;
  }
  for (std::int32_t k = 0; k < bodies; ++k) first_pair_[k + 1] += first_pair_[k];
  front_.assign(nodes, {});
  other_place_.clear();
  mark_.assign(bodies, -1);
  node_of_place_.resize(bodies);
  list_children(tree);
  for (std::int32_t k = 0; k < nodes; ++k) {
    const EliminationNode& node = tree.node[k];
    Front& f = front_[k];
    f.place = node.begin;
    f.own = node.end - node.begin;
    std::fill_n(node_of_place_.begin() + f.place, f.own, k);
    find_others(pairs, k);
    f.own_rows = whole_packs(motions * f.own);
    f.other_rows = whole_packs(motions * f.others);
  }
  row_in_parent_.resize(other_place_.size());
  for (std::int32_t node = 0; node < nodes; ++node) {
    const Front& f = front_[node];
    for (std::int32_t k = 0; k < f.others; ++k)
      row_in_parent_[f.first_other + k] = row_in(front_[tree.node[node].parent], other_place_[f.first_other + k]);
  }
  make_space(bodies, pairs.size(), parts);
  divide(tree, parts);
}

}  // namespace gem
