// A report is written from data and from a run file as one page, and refuses an incomplete run.
#include "gem/report/report.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <utility>

#include "gem/base/error.h"
#include "gem/record/run_file/run_writer.h"
#include "gem/report/report_fixture.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

TEST_F(Report, IsOnePageWithItsFiguresInside) {
  write_report(swinging_platform(), out(), false);
  const std::string html = page();
  EXPECT_NE(html.find("<h1>swing_&lt;1&gt;</h1>"), std::string::npos);
  EXPECT_EQ(html.find("class=\"warning\""), std::string::npos);
  for (const std::string name : {"field_start", "field_middle", "field_end", "field_platform", "motion_x", "motion_y",
                                 "orbit", "spectrum", "ice_force", "ice_and_mooring", "books"}) {
    for (const char* kind : {".svg", ".gp"})
      EXPECT_TRUE(fs::exists(folder_ / "report" / "figures" / (name + kind))) << name << kind;
    EXPECT_NE(html.find("figures/" + name + ".gp"), std::string::npos) << name;
  }
  std::size_t pictures = 0;
  for (std::size_t at = html.find("<svg"); at != std::string::npos; at = html.find("<svg", at + 1)) ++pictures;
  EXPECT_EQ(pictures, 11u);
  EXPECT_EQ(html.find("<img"), std::string::npos);
  EXPECT_EQ(html.find("src="), std::string::npos);
}

TEST_F(Report, ShowsTheForcesOnFixedBodies) {
  RunData run = swinging_platform();
  run.on_fixed.force.resize(2);
  for (int n = 1; n <= 40; ++n) {
    run.on_fixed.time.push_back(10.0 * n);
    run.on_fixed.force[0].push_back({3e3, 4e3});
    run.on_fixed.force[1].push_back({0.0, 0.0});  // no ice came
  }
  write_report(run, out(), false);
  EXPECT_NE(page().find("<th scope=\"row\">fixed body 1</th><td>no contact</td>"), std::string::npos);
  EXPECT_NE(page().find("Force of the ice on fixed bodies"), std::string::npos);
  std::ifstream script(folder_ / "report" / "figures" / "fixed_force.gp");
  const std::string text{std::istreambuf_iterator<char>(script), {}};
  EXPECT_NE(text.find("fixed_force_0.csv"), std::string::npos) << text;
  EXPECT_EQ(text.find("fixed_force_1.csv"), std::string::npos) << text;
  std::ifstream curve(folder_ / "report" / "figures" / "fixed_force_0.csv");
  const std::string rows{std::istreambuf_iterator<char>(curve), {}};
  EXPECT_NE(rows.find(",5\n"), std::string::npos) << rows;  // 3 and 4 kN
}

TEST_F(Report, ShowsTheForcesOnFixedBodiesWithoutAPlatform) {
  RunData run = swinging_platform();
  run.platform = {};
  run.on_fixed.force.resize(1);
  for (int n = 1; n <= 40; ++n) {
    run.on_fixed.time.push_back(10.0 * n);
    run.on_fixed.force[0].push_back({0.0, 4e3});
  }
  write_report(run, out(), false);
  EXPECT_NE(page().find("<td>4.00 kN</td>"), std::string::npos) << page();
  EXPECT_EQ(page().find("no contact"), std::string::npos);
  EXPECT_NE(page().find(">Forces on fixed bodies<"), std::string::npos);
}

/// The platform rests at (200, 10). A wall passes over its picture, which reaches 30 m to three sides and 42 m to the
/// fourth.
TEST_F(Report, DrawsTheIceAroundThePlatformWhereItStands) {
  RunData run = swinging_platform();
  run.rest = {200.0, 10.0};
  for (double& x : run.platform.x) x += 200.0;
  for (double& y : run.platform.y) y += 10.0;
  run.fixed = {{{0.0, 25.0}, {500.0, 35.0}, {500.0, 900.0}, {0.0, 900.0}}};
  write_report(run, out(), false);
  std::ifstream commands(folder_ / "report" / "figures" / "field_platform.gp");
  const std::string text{std::istreambuf_iterator<char>(commands), {}};
  EXPECT_NE(text.find("set xrange [158.00:230.00]\nset yrange [-20.000:40.000]"), std::string::npos) << text;
  std::ifstream wall(folder_ / "report" / "figures" / "field_platform_fixed.csv");
  std::string line;
  std::getline(wall, line);
  std::set<std::pair<double, double>> corners;
  while (std::getline(wall, line) && !line.empty()) {
    double x = 0.0, y = 0.0;
    const char* end = line.data() + line.size();
    const char* comma = std::from_chars(line.data(), end, x).ptr;
    ASSERT_LT(comma, end);
    std::from_chars(comma + 1, end, y);
    corners.insert({x, y});
  }
  ASSERT_EQ(corners.size(), 4u);
  const double left = 25.0 + 158.0 * 10.0 / 500.0, right = 25.0 + 230.0 * 10.0 / 500.0;
  const std::set<std::pair<double, double>> wanted = {{158.0, left}, {158.0, 40.0}, {230.0, right}, {230.0, 40.0}};
  for (auto is = corners.begin(), want = wanted.begin(); is != corners.end(); ++is, ++want) {
    EXPECT_NEAR(is->first, want->first, 1e-3);
    EXPECT_NEAR(is->second, want->second, 1e-3);
  }
}

TEST_F(Report, HasNoFiguresOfAMotionThatIsNone) {
  RunData run = swinging_platform();
  run.platform.x.assign(run.platform.x.size(), 0.0);
  run.platform.y.assign(run.platform.y.size(), 0.0);
  write_report(run, out(), false);
  EXPECT_EQ(page().find("figures/motion_x.gp"), std::string::npos);
  EXPECT_EQ(page().find("figures/spectrum.gp"), std::string::npos);
  EXPECT_NE(page().find("figures/ice_force.gp"), std::string::npos);
}

// The impulse belongs to the sample that ends at 200 s. Its mean over 1 s is recorded there and drawn at 199.5 s.
TEST_F(Report, DrawsTheWindowsMeanAtItsMiddle) {
  RunData run = swinging_platform();
  write_report(run, out(), false);
  const auto text_of = [&](const std::string& name) {
    std::ifstream file(folder_ / "report" / "figures" / name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  };
  const std::string means = text_of("ice_force_window_mean.csv");
  EXPECT_NE(means.find("\n199.5,10\n"), std::string::npos) << means;
  EXPECT_NE(text_of("ice_force_window.csv").find("\n200,20\n"), std::string::npos);
  EXPECT_NE(text_of("ice_force.gp").find("ice_force_window_mean.csv"), std::string::npos);
  run.force_window_s = 0.5;  // one sample
  write_report(run, out(), false);
  EXPECT_EQ(text_of("ice_force.gp").find("ice_force_window_mean.csv"), std::string::npos);
}

TEST_F(Report, ReplacesItsOwnPageAndNoOthers) {
  RunData run = swinging_platform();
  write_report(run, out(), false);
  write_report(run, out(), false);
  run.identity.name = "another";
  EXPECT_THROW(write_report(run, out(), false), Error);
  EXPECT_NE(page().find("swing_&lt;1&gt;"), std::string::npos);
}

TEST_F(Report, RefusesAnIncompleteRunUnlessAsked) {
  RunData run = swinging_platform();
  run.identity.status = "stopped:signal";
  EXPECT_THROW(write_report(run, out(), false), Error);
  EXPECT_FALSE(fs::exists(folder_ / "report"));
  write_report(run, out(), true);
  EXPECT_NE(page().find("class=\"warning\""), std::string::npos);
  EXPECT_NE(page().find("stopped:signal"), std::string::npos);
  EXPECT_EQ(page().find("not known: the run was cut off"), std::string::npos);
  run.identity.status = "running";
  write_report(run, out(), true);
  EXPECT_NE(page().find("not known: the run was cut off"), std::string::npos);
}

TEST_F(Report, NamesThePackageWhenGnuplotIsMissing) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder_.c_str(), 1);
  try {
    write_report(swinging_platform(), out(), false);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("gnuplot-nox"), std::string::npos);
  }
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(fs::exists(folder_ / "report"));
}

TEST_F(Report, SaysWhyTheFieldIsNotPictured) {
  RunData run = swinging_platform();
  const std::string heading = "<h2>The field</h2>\n<p class=\"notes\">";
  write_report(run, out(), false);
  EXPECT_EQ(page().find(heading), std::string::npos);
  for (const char* recorded : {"Two frames of the floes recorded", "One frame", "No frames"}) {
    run.frames.pop_back();
    write_report(run, out(), false);
    EXPECT_NE(page().find(heading + recorded), std::string::npos) << recorded;
  }
  run.floe_outlines.clear();
  write_report(run, out(), false);
  EXPECT_NE(page().find(heading + "The run has no floes."), std::string::npos);
}

TEST_F(Report, DoesWithoutAPlatform) {
  RunData run = swinging_platform();
  run.platform = {};
  run.events = {};
  run.platform_outline = {};
  write_report(run, out(), false);
  EXPECT_EQ(page().find("Motion of the platform"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "report" / "figures" / "field_end.svg"));
}

/// Two floes, one of which is gone in the last frame, and a platform at rest.
void write_run_file(const std::string& path, const std::string& status) {
  SceneDef scene;
  scene.run.name = "tiny";
  scene.boundary.present = false;
  Bodies bodies;
  BodyDef body;
  body.kind = BodyKind::platform;
  body.outline = a_square;
  body.mass = 1e8;
  append(bodies, body);
  body.kind = BodyKind::floe;
  body.mass = 0.0;
  for (const double x : {-20.0, 20.0}) {
    body.origin = {x, 0.0};
    append(bodies, body);
  }
  RunWriter writer(path, true, scene, bodies,
                   {"tiny", resolved_toml(scene), scene_hash(scene), "gem run tiny.toml", "cpu", "coupled"});
  Slab slab;
  for (int i = 0; i < 200; ++i) {
    PlatformRow row;
    row.time = 0.1 * i;
    row.position = {0.01 * std::sin(0.5 * row.time), 0.0};
    slab.platform.push_back(row);
  }
  for (int i = 0; i < 3; ++i) {
    StatsRow row;
    row.time = 10.0 * i;
    row.wall_time = 0.1 * i;
    slab.stats.push_back(row);
    slab.floes.time.push_back(row.time);
    for (int floe = 0; floe < 2; ++floe) {
      slab.floes.x.push_back(floe == 0 ? -20.0F : 20.0F);
      for (auto* values : {&slab.floes.y, &slab.floes.theta, &slab.floes.vx, &slab.floes.vy, &slab.floes.omega})
        values->push_back(0.0F);
      slab.floes.active.push_back(i == 2 && floe == 1 ? 0.0F : 1.0F);
    }
  }
  writer.write(slab);
  writer.finish(status, 0x1234);
}

TEST_F(Report, ReadsARunFile) {
  const std::string run_file = (folder_ / "tiny.h5").string();
  write_run_file(run_file, "complete");
  write_report(run_file, out(), false);
  const std::string html = page();
  EXPECT_NE(html.find("<h1>tiny</h1>"), std::string::npos);
  EXPECT_NE(html.find("0000000000001234"), std::string::npos);
  EXPECT_NE(html.find("<strong>not judged</strong>"), std::string::npos) << "the file has no verdict";
  EXPECT_NE(html.find("88.86 s"), std::string::npos);
  EXPECT_LT(fs::file_size(folder_ / "report" / "figures" / "field_end.csv"),
            fs::file_size(folder_ / "report" / "figures" / "field_start.csv"));
}

TEST_F(Report, SaysThatAnotherProgramHasLockedTheFile) {
  const std::string run_file = (folder_ / "tiny.h5").string();
  write_run_file(run_file, "running");
  const int writer = open(run_file.c_str(), O_RDONLY);
  ASSERT_EQ(flock(writer, LOCK_EX), 0);
  try {
    write_report(run_file, out(), true);
    ADD_FAILURE() << "was read";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("another program changes it"), std::string::npos) << error.what();
  }
  close(writer);
}

TEST_F(Report, RefusesAnIncompleteRunFile) {
  const std::string run_file = (folder_ / "tiny.h5").string();
  write_run_file(run_file, "stopped:interrupted");
  EXPECT_THROW(write_report(run_file, out(), false), Error);
  write_report(run_file, out(), true);
  EXPECT_NE(page().find("stopped:interrupted"), std::string::npos);
}

}  // namespace
}  // namespace gem
