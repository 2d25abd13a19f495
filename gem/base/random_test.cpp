// Random numbers and the hash: known values, sensitivity to every argument, moments.
#include "gem/base/random.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gem/base/hash.h"

namespace gem {
namespace {

TEST(Random, MatchesThePublishedPhiloxAnswers) {
  // Known-answer test of Philox4x32-10 for counter and key 0: 6627e8d5 e169c58d bc57ac4c 9b00dbd8.
  const auto words = Random(0, 0, 0).bits(0);
  EXPECT_EQ(words[0], 0xe169c58d6627e8d5U);
  EXPECT_EQ(words[1], 0x9b00dbd8bc57ac4cU);
}

TEST(Random, EverySeedStreamItemAndIndexCounts) {
  const auto first = Random(1, 2, 3).bits(4);
  EXPECT_EQ(first, Random(1, 2, 3).bits(4));
  EXPECT_NE(first, Random(2, 2, 3).bits(4));
  EXPECT_NE(first, Random(1, 3, 3).bits(4));
  EXPECT_NE(first, Random(1, 2, 4).bits(4));
  EXPECT_NE(first, Random(1, 2, 3).bits(5));
  EXPECT_NE(first, Random(1ULL + (1ULL << 40), 2, 3).bits(4));
}

TEST(Random, MomentsOfUniformAndNormal) {
  constexpr int n = 20000;
  const Random random(7, 1);
  double uniform_sum = 0.0, normal_sum = 0.0, normal_square = 0.0;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double u = random.uniform(i);
    ASSERT_TRUE(u > 0.0 && u < 1.0);
    uniform_sum += u;
    const double z = random.normal(i);
    normal_sum += z;
    normal_square += z * z;
  }
  // Four standard errors: 4 x sqrt(1/12/n), 4 / sqrt(n), 4 sqrt(2/n).
  EXPECT_NEAR(uniform_sum / n, 0.5, 0.0082);
  EXPECT_NEAR(normal_sum / n, 0.0, 0.029);
  EXPECT_NEAR(normal_square / n, 1.0, 0.04);
}

TEST(Hash, KnownValueAndSensitivity) {
  // FNV-1a of eight zero bytes.
  Hash zeros;
  zeros.add(std::uint64_t{0});
  EXPECT_EQ(zeros.value(), 0xa8c7f832281a39c5U);
  Hash plus, minus;
  plus.add(0.0);
  minus.add(-0.0);
  EXPECT_NE(plus.value(), minus.value());
}

}  // namespace
}  // namespace gem
