// A list of problems, and the search for the nearest name behind "did you mean".
#include "gem/scene/problems.h"

#include <algorithm>
#include <numeric>

#include "gem/base/error.h"

namespace gem {
namespace {

constexpr std::size_t lines_shown_maximum = 50;

/// Insertions, deletions and substitutions that turn a into each beginning of b, from the empty one to the whole.
std::vector<std::size_t> edit_distances(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row;
}

std::string last_part(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

/// The smallest of the distances to the key and to its beginnings. A missing unit suffix costs nothing, nor do other
/// whole words at the end. A name that stops within a word costs one edit; of few letters it says nothing.
std::size_t distance_without_suffix(const std::string& name, const std::string& key) {
  const std::size_t shortest_beginning = key.rfind('.') + 1 + 4;  // without a point rfind() + 1 is 0
  const std::vector<std::size_t> distances = edit_distances(name, key);
  std::size_t least = distances.back();
  for (std::size_t length = 1; length < key.size(); ++length) {
    if (key[length] == '_') least = std::min(least, distances[length]);
    if (length >= shortest_beginning) least = std::min(least, distances[length] + 1);
  }
  return least;
}

/// Smaller is closer. The right key in the wrong section costs one edit.
std::size_t distance(const std::string& name, const std::string& candidate) {
  return std::min(distance_without_suffix(name, candidate),
                  distance_without_suffix(last_part(name), last_part(candidate)) + 1);
}

}  // namespace

void Problems::add(const TomlPlace& place, const std::string& key, const std::string& problem) {
  std::string line = to_string(place) + ": " + key + ": " + problem;
  if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(std::move(line));
}

void Problems::throw_if_any() const {
  if (lines_.empty()) return;
  std::string message;
  for (std::size_t i = 0; i < std::min(lines_.size(), lines_shown_maximum); ++i)
    message += (i == 0 ? "" : "\n") + lines_[i];
  if (lines_.size() > lines_shown_maximum)
    message += "\nand " + std::to_string(lines_.size() - lines_shown_maximum) + " more";
  throw Error(ExitCode::scene_rejected, message);
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates) {
  if (name.size() > 100) return "";
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, last_part(name).size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t d = distance(name, candidate);
    if (d < best_distance) best_distance = d, best = candidate;
  }
  return best;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : "; did you mean `" + nearest + "`?";
}

std::string suggestion_or_list(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string near = suggestion(name, candidates), section = name.substr(0, name.find('.'));
  if (!near.empty()) return near;
  for (const std::string& candidate : candidates)
    if (section != name && candidate.starts_with(section + "."))
      return "; `gem case explain " + section + "` lists the keys of this section";
  return "; `gem case explain` lists all keys";
}

}  // namespace gem
