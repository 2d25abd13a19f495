// Floes of several polygons and concave floes: cut with the same area, replaced by their hull, or refused with a
// reason.
#include "gem/field/files/floe_outlines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "gem/base/error.h"
#include "gem/field/field.h"
#include "gem/field/files/floe_file.h"
#include "gem/geometry/polygon.h"
#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

class FloeOutlines : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  std::string write(const std::string& type, const std::string& coordinates) {
    path_ = testing::TempDir() + "gem_outlines_" + testing::UnitTest::GetInstance()->current_test_info()->name() +
            ".geojson";
    std::ofstream(path_)
        << R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"thickness":0.8},)"
        << R"("geometry":{"type":")" << type << R"(","coordinates":)" << coordinates << "}}]}";
    return path_;
  }
  std::string refusal(ConcaveFloes concave = ConcaveFloes::refuse) {
    try {
      read_floe_file(path_, concave);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  }

  std::string path_;
};

double floes_area(const std::vector<FloeDef>& floes) {
  double sum = 0.0;
  for (const FloeDef& floe : floes) sum += std::fabs(polygon_moments(floe.outline_m).area);
  return sum;
}

// Clockwise, 12 corners; its area is 30 x 10 + 10 x 20 = 500 m2.
const char* const tee_outline = "[[[0,0],[0,10],[30,10],[30,0],[20,0],[20,-20],[10,-20],[10,0],[0,0]]]";

TEST_F(FloeOutlines, EveryPolygonOfAMultiPolygonIsAFloe) {
  const ReadFloes read =
      read_floe_file(write("MultiPolygon", "[[[[0,0],[9,0],[9,9],[0,0]]],[[[20,0],[29,0],[29,9],[20,9],[20,0]]]]"));
  ASSERT_EQ(read.floes.size(), 2U);
  EXPECT_EQ(read.changed, 0);
  EXPECT_EQ(read.floes[1].outline_m.size(), 4U);
  EXPECT_EQ(read.floes[0].thickness_m, 0.8);
  EXPECT_EQ(read.floes[1].thickness_m, 0.8);
}

TEST_F(FloeOutlines, MessagesNameThePolygon) {
  write("MultiPolygon", "[[[[0,0],[9,0],[9,9],[0,0]]],[[[20,0],[29,0],[29,9],[20,9]]]]");
  EXPECT_NE(refusal().find("feature 0, polygon 1: the ring is not closed"), std::string::npos) << refusal();
  write("MultiPolygon", "[]");
  EXPECT_NE(refusal().find("no polygons"), std::string::npos) << refusal();
  write("MultiPolygon", "[[[[0,0],[9,0],[9,9],[0,0]],[[1,1],[2,1],[2,2],[1,1]]]]");
  EXPECT_NE(refusal().find("polygon 0: a hole"), std::string::npos) << refusal();
}

TEST_F(FloeOutlines, ConcaveFloesAreRefusedUnlessTheCaseSaysWhatToDo) {
  write("Polygon", tee_outline);
  EXPECT_NE(refusal().find("turns inwards"), std::string::npos) << refusal();
  EXPECT_NE(refusal().find("set floes.concave = \"cut\" or \"hull\""), std::string::npos) << refusal();
}

TEST_F(FloeOutlines, CutFloesKeepAreaThicknessAndPlace) {
  SceneDef scene;
  scene.floes.source = FloeSource::file;
  scene.floes.path = write("Polygon", tee_outline);
  scene.floes.concave = ConcaveFloes::cut;
  scene.boundary.present = false;
  scene.platform.present = false;
  const ReadFloes read = read_floe_file(path_, ConcaveFloes::cut);
  EXPECT_EQ(read.changed, 1);
  EXPECT_EQ(read.made, std::int64_t(read.floes.size()));
  EXPECT_NEAR(floes_area(read.floes), 500.0, 1e-10);
  for (const FloeDef& floe : read.floes) EXPECT_EQ(floe.thickness_m, 0.8);
  const FieldSummary summary = summarise(scene, make_field(scene));
  EXPECT_EQ(summary.floe_count, std::int64_t(read.floes.size()));
  EXPECT_NEAR(summary.ice_mass, scene.ice.density_kg_per_m3 * 500.0 * 0.8, 1e-6);
  EXPECT_EQ(summary.concave,
            "1 outline cut into " + std::to_string(read.made) + " convex floes, which are not bonded to each other");
  EXPECT_EQ(floes_sha256(read.floes), floes_sha256(read_floe_file(path_, ConcaveFloes::cut).floes));
}

TEST_F(FloeOutlines, TheHullAddsTheBays) {
  const ReadFloes read = read_floe_file(write("Polygon", tee_outline), ConcaveFloes::hull);
  ASSERT_EQ(read.floes.size(), 1U);
  // Two triangles of 10 m x 20 m beside the stem.
  EXPECT_NEAR(read.area_added, 200.0, 1e-10);
  EXPECT_NEAR(floes_area(read.floes), 700.0, 1e-10);
  EXPECT_EQ(concave_text(read, ConcaveFloes::hull), "1 outline replaced by the convex hull, which adds 200 m2 of ice");
}

TEST_F(FloeOutlines, ConvexFloesStayAsTheyAre) {
  write("Polygon", "[[[0,0],[10,0],[10,10],[0,10],[0,0]]]");
  for (const ConcaveFloes concave : {ConcaveFloes::cut, ConcaveFloes::hull}) {
    const ReadFloes read = read_floe_file(path_, concave);
    EXPECT_EQ(read.changed, 0);
    EXPECT_EQ(floes_sha256(read.floes), floes_sha256(read_floe_file(path_).floes));
  }
}

TEST_F(FloeOutlines, OutlinesThatCrossThemselvesAreRefused) {
  write("Polygon", "[[[0,0],[10,10],[10,0],[0,10],[0,0]]]");
  EXPECT_NE(refusal(ConcaveFloes::cut).find("the outline crosses or touches itself"), std::string::npos);
  EXPECT_NE(refusal(ConcaveFloes::hull).find("vertex 0"), std::string::npos);
}

TEST_F(FloeOutlines, ManyCornersAreCutUpToALimit) {
  const auto ring = [](int corners) {
    std::string text;
    for (int i = 0; i <= corners; ++i) {
      const double angle = 2.0 * 3.141592653589793 * (i % corners) / corners;
      text += (i ? ",[" : "[") + std::to_string(100.0 * std::cos(angle)) + "," +
              std::to_string(100.0 * std::sin(angle)) + "]";
    }
    return "[[" + text + "]]";
  };
  write("Polygon", ring(40));
  EXPECT_NE(refusal().find("40 vertices (at most 20 are allowed)"), std::string::npos) << refusal();
  const ReadFloes read = read_floe_file(path_, ConcaveFloes::cut);
  EXPECT_GE(read.floes.size(), 3U);
  for (const FloeDef& floe : read.floes) EXPECT_LE(floe.outline_m.size(), listed_corners_maximum);
  EXPECT_NEAR(floes_area(read.floes), 20.0 * 1e4 * std::sin(2.0 * 3.141592653589793 / 40.0), 1e-2);
  write("Polygon", ring(501));
  EXPECT_NE(refusal(ConcaveFloes::cut).find("at most 500 are allowed"), std::string::npos);
}

}  // namespace
}  // namespace gem
