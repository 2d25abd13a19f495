// The side of a contact: on a face, at a corner, and near the end of a short side.
#include "gem/geometry/outline_side.h"

#include <gtest/gtest.h>

namespace gem {
namespace {

// 100 m long, 20 m wide, its stem cut to a side of 4 m.
const std::vector<Vec2> hull = {{-50.0, -2.0}, {-40.0, -10.0}, {50.0, -10.0},
                                {50.0, 10.0},  {-40.0, 10.0},  {-50.0, 2.0}};

TEST(OutlineSide, FaceTakesWhatPressesOnIt) {
  EXPECT_EQ(side_of(hull, {0.0, -10.0}, {0.0, -1.0}), 1U);
  EXPECT_EQ(side_of(hull, {50.0, 3.0}, {1.0, 0.0}), 2U);
  EXPECT_EQ(side_of(hull, {-49.9, 0.0}, {-1.0, 0.0}), 5U) << "a tenth of a metre deep";
}

TEST(OutlineSide, FaceKeepsItsContactAtItsEnd) {
  EXPECT_EQ(side_of(hull, {-39.9, -9.9}, {0.0, -1.0}), 1U);
  EXPECT_EQ(side_of(hull, {-40.0, -10.0}, {-0.624695, -0.780869}), 0U) << "the same corner, on the bow's face";
  EXPECT_EQ(side_of(hull, {-49.8, 1.95}, {-1.0, 0.0}), 5U) << "deep in the corner of the short side";
}

TEST(OutlineSide, CornerGoesToTheSideThatFacesTheFloe) {
  EXPECT_EQ(side_of(hull, {50.0, -10.0}, {0.6, -0.8}), 1U);
  EXPECT_EQ(side_of(hull, {50.0, -10.0}, {0.8, -0.6}), 2U);
}

TEST(OutlineSide, NearestSideWinsOverOneThatFacesBetter) {
  // a normal along +y, but on the transom: the port side faces it, far away
  EXPECT_EQ(side_of(hull, {50.0, 0.0}, {0.6, 0.8}), 2U);
}

}  // namespace
}  // namespace gem
