// Where in (0, 1) the draws of a variable lie: at random, one in each of n strata, or in pairs for Sobol indices.
//
// Counter-based: the number of draw i of a variable depends on the seed, the name of the variable and i alone; with
// Latin hypercube sampling also on the number of draws, with repeats also on the number of the repeat.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gem {

enum class Sampling { random, latin_hypercube, saltelli };

struct DrawDesign {
  Sampling sampling = Sampling::latin_hypercube;
  std::uint64_t seed = 1;
  std::size_t count = 0;  // draws
};

/// Numbers in (0, 1) of draws 0 ... count - 1 of one variable. `repeat` counts from 0.
/// Latin hypercube: each stratum [j / count, (j + 1) / count) holds one of them.
std::vector<double> draw_numbers(const DrawDesign& design, const std::string& variable, std::size_t repeat = 0);

/// The second, independent set of a Saltelli design.
std::vector<double> second_draw_numbers(const DrawDesign& design, const std::string& variable);

}  // namespace gem
