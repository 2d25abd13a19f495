// Draws from streams of counter-based random numbers, one stream per variable.
#include "gem/scene/sweep/draw_design.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "gem/base/hash.h"
#include "gem/base/random.h"

namespace gem {
namespace {

/// Streams of the generator of fields and of the analysis have other numbers.
enum class DrawStream : std::uint32_t { first = 2000, second, stratum };

std::uint64_t key_of(std::uint64_t seed, const std::string& variable) {
  Hash hash;
  hash.add(seed);
  for (const char c : variable) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  return hash.value();
}

Random stream_of(const DrawDesign& design, const std::string& variable, DrawStream stream, std::size_t repeat = 0) {
  return Random(key_of(design.seed, variable), static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(repeat));
}

std::vector<double> at_random(const Random& random, std::size_t count) {
  std::vector<double> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = random.uniform(i);
  return numbers;
}

/// Puts each number into a stratum of its own, in a random order (McKay, Beckman and Conover 1979).
void stratify(std::vector<double>& numbers, RandomSequence order) {
  std::vector<std::size_t> stratum(numbers.size());
  std::iota(stratum.begin(), stratum.end(), std::size_t{0});
  for (std::size_t i = stratum.size(); i > 1; --i) std::swap(stratum[i - 1], stratum[order.below(i)]);
  const auto count = static_cast<double>(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = std::min((static_cast<double>(stratum[i]) + numbers[i]) / count, 1.0 - 0x1p-53);
}

}  // namespace

std::vector<double> draw_numbers(const DrawDesign& design, const std::string& variable, std::size_t repeat) {
  std::vector<double> numbers = at_random(stream_of(design, variable, DrawStream::first, repeat), design.count);
  if (design.sampling == Sampling::latin_hypercube)
    stratify(numbers, RandomSequence(stream_of(design, variable, DrawStream::stratum, repeat)));
  return numbers;
}

std::vector<double> second_draw_numbers(const DrawDesign& design, const std::string& variable) {
  return at_random(stream_of(design, variable, DrawStream::second), design.count);
}

}  // namespace gem
