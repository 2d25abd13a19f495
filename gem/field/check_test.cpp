// Bad outlines, bad fields and bad floe files each get their own message. Good ones are read.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/field/check_field.h"
#include "gem/field/check_outline.h"
#include "gem/field/field.h"
#include "gem/field/files/floe_file.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

template <class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

void expect_contains(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message << " | " << part;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

std::vector<Vec2> regular(int sides) {
  std::vector<Vec2> outline;
  for (int i = 0; i < sides; ++i)
    outline.push_back({10 * std::cos(6.2831853 * i / sides), 10 * std::sin(6.2831853 * i / sides)});
  return outline;
}

TEST(CheckOutline, RefusesWithTheVertexNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Vec2> star;
  for (int i = 0; i < 5; ++i) star.push_back({std::cos(2.5132741 * i), std::sin(2.5132741 * i)});
  const struct {
    std::vector<Vec2> outline;
    std::vector<std::string> parts;
  } rows[] = {
      {{{0, 0}, {1, 0}}, {"2 vertices", "at least 3"}},
      {regular(21), {"21 vertices", "at most 20"}},
      {{{0, 0}, {1, nan}, {0, 1}}, {"vertex 1", "not finite"}},
      {{{0, 0}, {1, 0}, {1, 1}, {1, 0}}, {"vertex 3", "repeats vertex 1"}},
      {{{0, 0}, {1, 0}, {1, 0.0005}, {0, 1}}, {"vertex 1", "0.0005 m"}},
      {{{0, 0}, {1, 1}, {3, 3}}, {"zero area"}},
      {{{0, 0}, {1, 0}, {2, 0}, {1, 1}}, {"vertex 1", "on the line"}},
      {{{0, 0}, {4, 0}, {1, 1}, {0, 4}}, {"vertex 2 (counted from 0) turns inwards"}},
      {{{0, 4}, {1, 1}, {4, 0}, {0, 0}}, {"vertex 1", "turns inwards"}},
      {{{0, 0}, {2, 2}, {2, 0}, {0, 1}}, {"vertex", "crosses itself"}},
      {star, {"vertex", "second time"}},
  };
  for (const auto& row : rows) {
    const std::string message = message_of([&] { check_outline(row.outline, "floe 7"); });
    expect_contains(message, row.parts);
    expect_contains(message, {"floe 7: "});
  }
}

TEST(CheckOutline, AcceptsEitherDirection) {
  const auto given = regular(20);
  auto clockwise = given;
  std::reverse(clockwise.begin(), clockwise.end());
  EXPECT_FALSE(check_outline(given, "floe").reversed);
  EXPECT_TRUE(check_outline(clockwise, "floe").reversed);
  EXPECT_EQ(check_outline(clockwise, "floe").outline.front().x, given.front().x);
}

FloeDef square_at(double x, double y, double size = 10.0) {
  FloeDef floe;
  const double h = 0.5 * size;
  floe.outline_m = {{-h, -h}, {h, -h}, {h, h}, {-h, h}};
  floe.position_m = {x, y};
  return floe;
}

SceneDef listed_scene(std::vector<FloeDef> floes) {
  SceneDef scene;
  scene.floes.source = FloeSource::listed;
  scene.floe = std::move(floes);
  return scene;
}

TEST(CheckField, RefusesOverlapsAndPlacesOutside) {
  const struct {
    std::vector<FloeDef> floes;
    std::vector<std::string> parts;
  } rows[] = {
      {{square_at(-500, 0), square_at(-490.5, 2)}, {"1 pair", "floe 0 and floe 1 by 0.5 m; floe 1 is at (-490"}},
      {{square_at(0, 0)}, {"platform and floe 0"}},
      {{square_at(-500, 198)}, {"floe 0", "outside the channel"}},
      {{square_at(-500, 300)}, {"floe 0", "outside the channel"}},
      {{square_at(-1700, 0)}, {"floe 0", "upstream"}},
  };
  for (const auto& row : rows) expect_contains(message_of([&] { make_field(listed_scene(row.floes)); }), row.parts);
}

TEST(CheckField, ListsTenPairsAndTheCount) {
  std::vector<FloeDef> floes;
  for (int i = 0; i < 15; ++i) floes.push_back(square_at(-500 + 9.0 * i, 0));
  const std::string message = message_of([&] { make_field(listed_scene(floes)); });
  expect_contains(message, {"14 pairs", "floe 9 and floe 10 by 1 m", "and 4 more"});
  EXPECT_EQ(message.find("floe 10 and"), std::string::npos);
}

TEST(CheckField, TouchingIsAllowed) {
  const SceneDef scene = listed_scene({square_at(-500, 0), square_at(-490, 0), square_at(-500, 195)});
  const Bodies bodies = make_field(scene);
  EXPECT_NEAR(summarise(scene, bodies).smallest_gap, 0.0, 1e-12);
  EXPECT_EQ(near_pairs(bodies, 1e-9).size(), 2U);
}

TEST(CheckField, FindsOneOverlapAmongMany) {
  std::vector<FloeDef> floes;
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 30; ++j) floes.push_back(square_at(-1400 + 11.0 * i, -180 + 11.0 * j));
  EXPECT_EQ(make_field(listed_scene(floes)).count(), 3003U);
  floes.push_back(square_at(-1400 + 11.0 * 40 + 1.0, -180 + 11.0 * 10, 1.0));
  expect_contains(message_of([&] { make_field(listed_scene(floes)); }), {"1 pair", "floe 1210 and floe 3000"});
}

class FloeFile : public ::testing::Test {
 protected:
  std::string write(const std::string& ending, const std::string& text) {
    return folder_.write("floes" + ending, text);
  }
  ScratchFolder folder_;
};

TEST_F(FloeFile, ReadsCsvInEitherDirection) {
  const std::string path = write(".csv",
                                 "floe,x,y,thickness\r\na,-500,0,0.7\na,-490,0,0.7\na,-490,1e1,0.7\n\n"
                                 "b,-400,0,1.2\nb,-400,10,1.2\nb,-390.5,0,1.2\n");
  const auto floes = read_floe_file(path).floes;
  ASSERT_EQ(floes.size(), 2U);
  EXPECT_EQ(floes[0].outline_m.size(), 3U);
  EXPECT_EQ(floes[0].outline_m[2].y, 10.0);
  EXPECT_EQ(floes[0].thickness_m, 0.7);
  SceneDef scene;
  scene.floes.source = FloeSource::file;
  scene.floes.path = path;
  const Bodies bodies = make_field(scene);
  EXPECT_NEAR(bodies.area[3], 50.0, 1e-12);
  EXPECT_NEAR(bodies.area[4], 47.5, 1e-12);
  EXPECT_EQ(bodies.thickness[4], 1.2);
  EXPECT_EQ(summarise(scene, bodies).clockwise_outlines, 1);
}

TEST_F(FloeFile, WithoutThicknessTheClassesDecide) {
  SceneDef scene;
  scene.floes.source = FloeSource::file;
  scene.floes.path = write(".csv", "floe,x,y\n1,-500,0\n1,-490,0\n1,-490,10\n");
  scene.floes.classes[0].thickness_m = 0.9;
  EXPECT_EQ(make_field(scene).thickness.back(), 0.9);
}

TEST_F(FloeFile, RefusesSlipsOfUnit) {
  const struct {
    std::string text;
    std::vector<std::string> parts;
  } rows[] = {
      {"floe,x,y\n1,-9000,0\n1,-2000,0\n1,-2000,7000\n", {"floe[0]: size", "allowed [0.1, 1000] m", "give it in m"}},
      {"floe,x,y,thickness\n1,-70,0,1200\n1,-60,0,1200\n1,-60,9,1200\n", {"floe[0]: thickness", "value 1200"}},
      // the origin of an outline in a file is 0, so its centre is what counts
      {"floe,x,y\n1,400,0\n1,410,0\n1,400,10\n", {"output.retire_x_m: floe[0] starts downstream", "value 300"}},
  };
  for (const auto& row : rows) {
    SceneDef scene;
    scene.floes.source = FloeSource::file;
    scene.floes.path = write(".csv", row.text);
    expect_contains(message_of([&] { make_field(scene); }), row.parts);
  }
}

TEST_F(FloeFile, RefusesBadCsvWithTheLine) {
  const struct {
    std::string text;
    std::vector<std::string> parts;
  } rows[] = {
      {"", {"no header"}},
      {"x,y\n", {":1: unknown header"}},
      {"floe,x,y\n", {"no floes"}},
      {"floe,x,y\n\n", {"no floes"}},
      {"floe,x,y\n1,0,0\n1,1\n", {":3: 2 fields"}},
      {"floe,x,y\n1,0,0\n1,1;5,0\n", {":3: x \"1;5\""}},
      {"floe,x,y\n1,0,nan\n", {":2: y \"nan\""}},
      {"floe,x,y\n1,0,1e400\n", {":2: y \"1e400\""}},
      {"floe,x,y\n1,0,0x10\n", {":2: y \"0x10\""}},
      {"floe,x,y\n1,0,1e300\n", {":2: a coordinate is out of range (value 1e+300", "give it in m"}},
      {"floe,x,y\n1,-2e6,0\n", {":2: a coordinate is out of range"}},
      {"floe,x,y\n,0,0\n", {":2: no floe name"}},
      {"floe,x,y,thickness\n1,0,0,-1\n", {":2: thickness must be positive"}},
      {"floe,x,y,thickness\n1,0,0,1\n1,1,0,2\n", {":3: thickness differs"}},
      {"floe,x,y\n1,0,0\n1,1,0\n1,0,1\n2,5,5\n2,6,5\n2,5,6\n1,9,9\n", {":8: floe 1 comes a second time"}},
      {"floe,x,y\n1,0,0\n2,5,5\n1,1,0\n2,6,5\n",
       {":4: floe 1 comes a second time (the rows of a floe must be together)"}},
      {"floe,x,y\n1,0,0\n1,1,0\n1,0,1\n2,5,5\n2,6,5\n", {":5: floe 2: 2 vertices"}},
      {"floe,x,y\n1,0,0\n1,4,0\n1,1,1\n1,0,4\n", {":2: floe 1: vertex 2", "turns inwards"}},
  };
  for (const auto& row : rows) {
    const std::string path = write(".csv", row.text);
    expect_contains(message_of([&] { read_floe_file(path); }), row.parts);
  }
}

std::string feature(const std::string& coordinates, const std::string& properties = "{}") {
  return R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":)" + properties +
         R"(,"geometry":{"type":"Polygon","coordinates":)" + coordinates + "}}]}";
}

TEST_F(FloeFile, ReadsGeoJson) {
  const auto floes =
      read_floe_file(write(".geojson", feature("[[[0,0],[10,0],[10,10],[0,0]]]", R"({"thickness":0.7})"))).floes;
  ASSERT_EQ(floes.size(), 1U);
  EXPECT_EQ(floes[0].outline_m.size(), 3U);
  EXPECT_EQ(floes[0].thickness_m, 0.7);
}

TEST_F(FloeFile, RefusesBadGeoJson) {
  const struct {
    std::string text;
    std::vector<std::string> parts;
  } rows[] = {
      {"{\"type\":", {"not valid JSON"}},
      {"[]", {"not a FeatureCollection"}},
      {R"({"type":"FeatureCollection","features":[]})", {"no floes"}},
      {R"({"type":"FeatureCollection","features":[{"geometry":null}]})", {"feature 0: not a Polygon"}},
      {R"({"type":"FeatureCollection","features":[3]})", {"feature 0: not a Polygon"}},
      {feature("[[[0,0],[10,0],[10,10]]]"), {"feature 0: the ring is not closed"}},
      {feature("[[[0,0],[9,0],[9,9],[0,0]],[[1,1],[2,1],[2,2],[1,1]]]"), {"feature 0: a hole (1 inner ring(s)"}},
      {feature("[[[0,0],[9,\"a\"],[9,9],[0,0]]]"), {"a position is not"}},
      {feature("[[[0,0],[9,0],[0,0]]]"), {"feature 0: 2 vertices"}},
      {feature("[[[0,0],[9,0],[9,9],[0,0]]]", R"({"thickness":"x"})"), {"thickness is not a number"}},
      {feature("[[[0,0],[9,0],[9,9],[0,0]]]", R"({"thickness":0})"), {"thickness must be positive"}},
      {feature("[[[0,0],[9,0],[9,9],[0,0]]]", R"({"thickness_m":2})"),
       {"\"thickness_m\"", "did you mean `thickness`?"}},
      {feature("[[[0,0],[9,0],[9,9],[0,0]]]", R"({"id":7,"Thickness":2})"), {"\"Thickness\"", "did you mean"}},
      {feature("[[[0,0],[9,0],[9,9],[0,0]]]", R"({"thicknes":2})"), {"\"thicknes\"", "did you mean"}},
      {feature("[[[0,0],[1e7,0],[9,9],[0,0]]]"), {"feature 0: a coordinate is out of range"}},
      {std::string(100000, '['), {"nested too deep"}},
  };
  for (const auto& row : rows) {
    const std::string path = write(".geojson", row.text);
    expect_contains(message_of([&] { read_floe_file(path); }), row.parts);
  }
}

TEST_F(FloeFile, OtherPropertiesAreAllowed) {
  const std::string properties = R"({"id":7,"area":50,"thickness":0.7,"source":"satellite"})";
  EXPECT_EQ(read_floe_file(write(".geojson", feature("[[[0,0],[10,0],[10,10],[0,0]]]", properties))).floes.size(), 1U);
}

TEST_F(FloeFile, MessagesAndFilesHaveLimits) {
  const std::string path = write(".csv", "floe,x,y\n1," + std::string(10000000, '9') + "x,0\n");
  const std::string message = message_of([&] { read_floe_file(path); });
  EXPECT_LT(message.size(), 1000U);
  expect_contains(message, {":2: x \"999", "is not a finite number"});
  std::filesystem::resize_file(path, std::uintmax_t{1} << 40);
  expect_contains(message_of([&] { read_floe_file(path); }), {"the file is too large (allowed 67108864 bytes)"});
}

TEST_F(FloeFile, AFileWithOtherFloesThanTheCaseNamesIsRefused) {
  SceneDef scene;
  scene.floes.source = FloeSource::file;
  scene.floes.path = write(".csv", "floe,x,y\n1,-500,0\n1,-490,0\n1,-490,10\n");
  scene.floes.sha256 = floes_sha256(read_floe_file(scene.floes.path).floes);
  EXPECT_EQ(make_field(scene).count(), 4U);
  write(".csv", "floe,x,y\n1,-500,0\n1,-490,0\n1,-490,10.5\n");
  expect_contains(message_of([&] { make_field(scene); }),
                  {"holds other floes than the case names", scene.floes.sha256});
}

TEST(FloeFilePath, MissingFileAndUnknownKind) {
  expect_contains(message_of([] { read_floe_file("/nowhere/floes.csv"); }), {"/nowhere/floes.csv", "cannot read"});
  const ScratchFolder folder("gem.csv");
  const auto inside = folder.path() / "folder.csv";
  std::filesystem::create_directory(inside);
  expect_contains(message_of([&] { read_floe_file(inside.string()); }), {"cannot read"});
  expect_contains(message_of([] { read_floe_file("floes.shp"); }), {"unknown kind"});
}

}  // namespace
}  // namespace gem
