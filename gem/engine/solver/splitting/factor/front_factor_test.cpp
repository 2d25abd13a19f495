// Order and factor of the equations of an island.
#include "gem/engine/solver/splitting/factor/front_factor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "gem/engine/solver/splitting/factor/dissection.h"

namespace gem {
namespace {

/// A square lattice of bodies, each touching its neighbours.
struct Lattice {
  std::int32_t side;
  std::vector<Vec2> position;
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;

  explicit Lattice(std::int32_t n) : side(n) {
    for (std::int32_t i = 0; i < n * n; ++i) position.push_back({1.0 * (i % n), 1.0 * (i / n)});
    for (std::int32_t i = 0; i < n * n; ++i) {
      if (i % n + 1 < n) pairs.emplace_back(i, i + 1);
      if (i / n + 1 < n) pairs.emplace_back(i, i + n);
    }
  }

  ContactGraph graph() const {
    ContactGraph g;
    for (std::int32_t i = 0; i < side * side; ++i) {
      g.first.push_back(static_cast<std::int32_t>(g.neighbour.size()));
      for (const auto& [a, b] : pairs)
        if (a == i || b == i) g.neighbour.push_back(a == i ? b : a);
    }
    g.first.push_back(static_cast<std::int32_t>(g.neighbour.size()));
    return g;
  }

  /// The pairs by place in the order of elimination, lower place first.
  std::vector<std::pair<std::int32_t, std::int32_t>> placed(const std::vector<std::int32_t>& order) const {
    std::vector<std::int32_t> place(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<std::int32_t>(k);
    std::vector<std::pair<std::int32_t, std::int32_t>> all;
    for (const auto& [a, b] : pairs) all.emplace_back(std::min(place[a], place[b]), std::max(place[a], place[b]));
    std::sort(all.begin(), all.end());
    return all;
  }
};

std::size_t stored_numbers(const Lattice& lattice, const EliminationTree& tree) {
  FrontFactor factor;
  factor.analyse(tree, lattice.placed(tree.order));
  return factor.stored_numbers();
}

TEST(Dissection, TakesEachBodyOnceAndKeepsTheFactorSmall) {
  const Lattice lattice(32);
  EliminationTree tree;
  Dissection().order(lattice.position, lattice.graph(), tree);
  std::vector<std::int32_t> sorted = tree.order, all(32 * 32);
  std::sort(sorted.begin(), sorted.end());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(sorted, all);
  for (std::size_t k = 0; k + 1 < tree.node.size(); ++k) {
    EXPECT_EQ(tree.node[k].end, tree.node[k + 1].begin);
    EXPECT_GT(tree.node[k].parent, static_cast<std::int32_t>(k));
  }
  // row by row every body fills a band of 32 blocks; dissection is to save more than half of them at this size
  EliminationTree by_rows;
  by_rows.order = all;
  for (std::int32_t k = 0; k < 32; ++k) by_rows.node.push_back({32 * k, 32 * k + 32, k < 31 ? k + 1 : -1});
  EXPECT_LT(2 * stored_numbers(lattice, tree), stored_numbers(lattice, by_rows));
}

TEST(Dissection, LeavesBodiesInOnePlaceTogether) {
  Lattice lattice(4);
  for (Vec2& position : lattice.position) position = {3.0, 4.0};
  EliminationTree tree;
  Dissection().order(lattice.position, lattice.graph(), tree);
  EXPECT_EQ(tree.node.size(), 1u);
}

/// Solves for two vectors and puts the results into the equations. Returns the number of nodes.
std::size_t expect_solution(const Lattice& lattice) {
  IslandCrew crew;
  const auto n = static_cast<std::int32_t>(lattice.position.size());
  EliminationTree tree;
  Dissection().order(lattice.position, lattice.graph(), tree);
  const auto pairs = lattice.placed(tree.order);
  FrontFactor factor;
  factor.analyse(tree, pairs);
  factor.reset();
  for (std::int32_t i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) factor.diagonal(i)[4 * c] = 1.0F;
  // K = 1 + sum of g g^T, as the points of an island give it
  std::mt19937 random(1);
  std::uniform_real_distribution<float> any(-2.0F, 2.0F);
  std::vector<double> k(9 * n * n, 0.0);
  for (std::int32_t i = 0; i < 3 * n; ++i) k[i * 3 * n + i] = 1.0;
  for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
    const auto [a, b] = pairs[pair];
    float g[6];
    for (float& x : g) x = any(random);
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c)
        k[(3 * (r < 3 ? a : b) + r % 3) * 3 * n + 3 * (c < 3 ? a : b) + c % 3] += double{g[r]} * g[c];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        factor.diagonal(a)[3 * r + c] += g[r] * g[c];
        factor.diagonal(b)[3 * r + c] += g[3 + r] * g[3 + c];
        factor.below(static_cast<std::int32_t>(pair))[3 * r + c] += g[3 + r] * g[c];
      }
  }
  factor.factor(crew);
  std::vector<float> b(8 * n, 0.0F);
  for (std::int32_t i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) {
      b[8 * i + c] = any(random);
      b[8 * i + 4 + c] = any(random);
    }
  std::vector<float> first = b, both = b;
  factor.solve_first(first.data(), crew);
  factor.solve_both(both.data(), crew);
  for (std::int32_t i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(first[8 * i + c], both[8 * i + c]);
      EXPECT_EQ(first[8 * i + 4 + c], b[8 * i + 4 + c]) << "the second half is left alone";
      for (const int half : {0, 4}) {
        double sum = 0.0, size = 0.0;
        for (std::int32_t j = 0; j < n; ++j)
          for (int d = 0; d < 3; ++d) {
            const double term = k[(3 * i + c) * 3 * n + 3 * j + d] * both[8 * j + half + d];
            sum += term;
            size += std::fabs(term);
          }
        // single precision, and at most n eliminations before a row
        EXPECT_NEAR(sum, b[8 * i + half + c], n * std::ldexp(1.0, -24) * (size + std::fabs(sum)));
      }
    }
  return factor.nodes();
}

TEST(FrontFactor, SolvesItsEquations) { EXPECT_GT(expect_solution(Lattice(9)), 10u); }

TEST(FrontFactor, SolvesOneLargeFront) {
  Lattice lattice(12);
  for (Vec2& position : lattice.position) position = {3.0, 4.0};
  EXPECT_EQ(expect_solution(lattice), 1u);
}

}  // namespace
}  // namespace gem
