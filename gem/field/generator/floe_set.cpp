// Makes the floe set: sizes from the size law, shapes from the shape generator or from a small library of copied
// shapes.
#include "gem/field/generator/floe_set.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gem/field/generator/shapes.h"
#include "gem/field/generator/size_law.h"

namespace gem {
namespace {

using OutlineSet = std::vector<std::vector<Vec2>>;

std::vector<double> stratified_sizes(const FloesDef& floes, std::size_t count) {
  const TruncatedSizeLaw law(floes);
  std::vector<double> sizes;
  for (std::size_t i = 0; i < count; ++i)
    sizes.push_back(law.quantile((static_cast<double>(i) + 0.5) / static_cast<double>(count)));
  return sizes;
}

template <class T>
void shuffle(std::vector<T>& values, RandomSequence numbers) {
  for (std::size_t left = values.size(); left > 1; --left) std::swap(values[left - 1], values[numbers.below(left)]);
}

RandomSequence numbers_for(const SceneDef& scene, FieldStream stream, std::size_t item = 0) {
  return RandomSequence(Random(scene.run.seed, static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(item)));
}

OutlineSet shapes_of_sizes(const SceneDef& scene, const std::vector<double>& sizes) {
  OutlineSet set;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    RandomSequence numbers = numbers_for(scene, FieldStream::shape, i);
    set.push_back(scaled(random_shape(numbers), sizes[i]));
  }
  return set;
}

/// A few quantiles have a smaller deviation than the law. Spreads them about the mean until the deviation is right.
void spread(std::vector<double>& sizes, const FloesDef& floes) {
  const double n = static_cast<double>(sizes.size());
  const double mean = std::accumulate(sizes.begin(), sizes.end(), 0.0) / n;
  double second = 0.0;
  for (const double s : sizes) second += (s - mean) * (s - mean);
  if (second == 0.0) return;
  const double factor = floes.size_deviation_m / std::sqrt(second / n);
  const auto moved = [&](double size) { return floes.size_mean_m + factor * (size - mean); };
  if (moved(sizes.front()) < floes.size_minimum_m || moved(sizes.back()) > floes.size_maximum_m) return;
  for (double& size : sizes) size = moved(size);
}

OutlineSet copied_set(const SceneDef& scene, std::size_t count) {
  std::vector<double> sizes = stratified_sizes(scene.floes, static_cast<std::size_t>(scene.floes.shape_count));
  spread(sizes, scene.floes);
  const OutlineSet library = shapes_of_sizes(scene, sizes);
  std::vector<std::size_t> which(count);
  const std::size_t full_rounds = count / library.size() * library.size();
  // The last, incomplete round takes shapes evenly from the whole library, which keeps the mean size.
  for (std::size_t i = 0; i < count; ++i)
    which[i] = i < full_rounds ? i % library.size()
                               : (2 * (i - full_rounds) + 1) * library.size() / (2 * (count - full_rounds));
  shuffle(which, numbers_for(scene, FieldStream::size_order));
  OutlineSet set;
  for (std::size_t i = 0; i < count; ++i) {
    const Rotation turn = strict::rotation_of_turns(numbers_for(scene, FieldStream::copy, i).uniform());
    set.emplace_back();
    for (const Vec2 p : library[which[i]]) set.back().push_back(rotate(turn, p));
  }
  return set;
}

}  // namespace

std::vector<std::vector<Vec2>> make_floe_set(const SceneDef& scene, std::int64_t count) {
  if (count <= 0) return {};
  const auto floe_count = static_cast<std::size_t>(count);
  if (scene.floes.source == FloeSource::copied) return copied_set(scene, floe_count);
  std::vector<double> sizes = stratified_sizes(scene.floes, floe_count);
  shuffle(sizes, numbers_for(scene, FieldStream::size_order));
  return shapes_of_sizes(scene, sizes);
}

std::vector<std::size_t> largest_first(const std::vector<double>& area) {
  std::vector<std::size_t> order(area.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return area[a] > area[b]; });
  return order;
}

std::vector<std::uint8_t> mixed_classes(const std::vector<double>& area, const std::vector<IceClassDef>& classes) {
  double tenths = 0.0;
  for (const IceClassDef& c : classes) tenths += c.tenths;
  std::vector<std::uint8_t> result(area.size(), 0);
  if (classes.size() < 2 || !(tenths > 0.0)) return result;
  std::vector<double> given(classes.size(), 0.0);
  double dealt = 0.0;
  for (const std::size_t floe : largest_first(area)) {
    dealt += area[floe];
    std::size_t best = 0;
    const auto lack = [&](std::size_t c) { return dealt * classes[c].tenths / tenths - given[c]; };
    for (std::size_t c = 1; c < classes.size(); ++c)
      if (lack(c) > lack(best)) best = c;
    result[floe] = static_cast<std::uint8_t>(best);
    given[best] += area[floe];
  }
  return result;
}

}  // namespace gem
