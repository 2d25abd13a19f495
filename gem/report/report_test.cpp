// A report is written from data and from a run file, states its findings, and refuses an incomplete run.
#include "gem/report/report.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/record/run_file/run_writer.h"
#include "gem/report/display.h"
#include "gem/report/figures/run_program.h"
#include "gem/report/page_tables.h"
#include "gem/report/run/run_findings.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

class Report : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!run_program({"gnuplot", "--version"}, folder_).found) GTEST_SKIP() << "gnuplot is not installed";
  }
  std::string page() const {
    std::ifstream file(folder_ / "report" / "index.html");
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::string out() const { return (folder_ / "report").string(); }
  ScratchFolder scratch_{"gem_report"};
  const fs::path& folder_ = scratch_.path();
};

const Corners kSquare = {{-2.0, -2.0}, {2.0, -2.0}, {2.0, 2.0}, {-2.0, 2.0}};

/// 1200 s of a platform that oscillates with 60 s about an offset of 0.2 m and is hit twice by one floe.
RunData swinging_platform() {
  RunData run;
  run.identity.name = "swing_<1>";
  run.identity.status = "complete";
  run.duration_s = 1200.0;
  run.natural_period_s = 60.0;
  run.current_speed = 0.5;
  run.force_window_s = 1.0;
  run.platform_outline = kSquare;
  run.floe_outlines = {kSquare, kSquare};
  for (int i = 0; i <= 2400; ++i) {
    const double time = 0.5 * i;
    const double x = 0.2 + 0.1 * std::sin(2.0 * std::numbers::pi * time / 60.0);
    run.platform.time.push_back(time);
    run.platform.x.push_back(x);
    run.platform.y.push_back(0.5 * (x - 0.2));
    run.platform.ice_force_x.push_back(i == 400 ? 2e4 : 0.0);
    run.platform.ice_force_y.push_back(0.0);
    run.platform.ice_force_mean_x.push_back(i == 400 ? 1e4 : 0.0);
    run.platform.ice_force_mean_y.push_back(0.0);
    run.platform.mooring_force_x.push_back(-5e5 * x);
    run.platform.mooring_force_y.push_back(0.0);
    run.platform.contacts.push_back(i == 400 ? 1.0 : 0.0);
  }
  run.events = {{199.7, 199.9}, {2, 2}, {-1.0, -1.0}, {0.0, 0.0}, {6e3, 4e3}, {9e4, 1.2e5}};
  run.stats = {{0.0, 600.0, 1200.0}, {0.0, 1e-15, 2e-15}, {0.0, 0.0, 3e-15},  {0.0, 4e-14, 1e-14},
               {0.0, 0.02, 0.01},    {0.0, 5.0, 10.0},    {0.0, 120.0, 120.0}};
  run.stats.maximum_overlap_share = {0.0, 0.002, 0.001};
  run.stats.energy_created = {0.0, 3.0, 0.0};
  for (int i = 0; i < 1000; ++i) run.stats.overlap.add(i == 0 ? 0.02 : 0.001);
  for (const double time : {0.0, 600.0, 1200.0})
    run.frames.push_back({time, {-20.0 + 0.01 * time, 30.0}, {0.0, 5.0}, {0.1, 0.2}, {0.5, 0.4}});
  return run;
}

TEST(RunFindings, DescribeASwingingPlatform) {
  const RunData run = swinging_platform();
  const RunFindings findings = run_findings(run);
  EXPECT_NEAR(findings.x.deviation, 0.1 / std::sqrt(2.0), 1e-4);
  EXPECT_NEAR(findings.x.excursion, 0.3, 1e-6);
  EXPECT_NEAR(findings.radial_excursion, std::hypot(0.3, 0.05), 1e-6);
  ASSERT_TRUE(findings.x.spectral.has_value());
  EXPECT_LT(findings.x.spectral->low, 60.0);
  EXPECT_GT(findings.x.spectral->high, 60.0);
  EXPECT_EQ(findings.loads.events, 2u);
  EXPECT_EQ(findings.loads.touches, 1u);
  EXPECT_EQ(findings.loads.arrivals, 1u);
  EXPECT_DOUBLE_EQ(findings.loads.event_impulse_largest, 6e3);
  EXPECT_DOUBLE_EQ(findings.loads.sample_impulse_largest, 1e4);
  EXPECT_DOUBLE_EQ(findings.loads.ice_window_largest, 1e4);
  const PlatformRecord& p = run.platform;
  const auto at =
      std::size_t(std::find(p.time.begin(), p.time.end(), findings.loads.ice_window_at.time_s) - p.time.begin());
  ASSERT_LT(at, p.time.size());
  EXPECT_DOUBLE_EQ(std::hypot(p.ice_force_mean_x[at], p.ice_force_mean_y[at]), 1e4);
  EXPECT_DOUBLE_EQ(findings.loads.crushing_largest, 1.2e5);
  EXPECT_NEAR(findings.loads.mooring_largest, 1.5e5, 1.0);
  EXPECT_DOUBLE_EQ(findings.quality.residual_energy, 4e-14);
  EXPECT_DOUBLE_EQ(findings.quality.maximum_overlap, 0.02);
  EXPECT_DOUBLE_EQ(findings.quality.most_overlap, OverlapCount::upper_edge(OverlapCount::class_of(0.001)));
  EXPECT_DOUBLE_EQ(findings.quality.maximum_share, 0.002);
  EXPECT_DOUBLE_EQ(findings.quality.energy_created, 3.0);
  EXPECT_DOUBLE_EQ(findings.quality.speed, 120.0);
}

TEST_F(Report, SaysWhatWasNotMeasured) {
  RunData run = swinging_platform();
  run.stats.complementarity = run.stats.cone_excess = {NAN, NAN, NAN};
  write_report(run, out(), false);
  const std::string html = page();
  EXPECT_NE(html.find("complementarity error</th><td>not measured</td>"), std::string::npos);
  EXPECT_NE(html.find("energy created by the contacts of one time step</th><td>3.0e+00 J</td>"), std::string::npos);
}

TEST_F(Report, SaysThatShortLoadsHaveNotConverged) {
  RunData run = swinging_platform();
  run.verdict.judgements.emplace_back();
  run.verdict.judgements.back().criterion = "unfinished_steps";
  for (const bool doubtful : {true, false}) {
    run.verdict.judgements.back().grade = doubtful ? Grade::doubtful : Grade::good;
    write_report(run, out(), true);
    const std::string html = page();
    EXPECT_EQ(html.find("impulse of one hit, largest</th><td>6.00 kN s (not converged)</td>") != html.npos, doubtful);
    EXPECT_EQ(html.find("hits on the platform, each from first touch to release</th><td>2</td>") == html.npos, false);
    EXPECT_EQ(html.find("MN (not converged)") != html.npos, false) << "only loads of a short time";
  }
}

TEST_F(Report, ShowsTheVerdict) {
  RunData run = swinging_platform();
  run.verdict.grade = Grade::bad;
  run.verdict.judgements.emplace_back();
  run.verdict.judgements.back().criterion = "floe_speed";
  run.verdict.judgements.back().grade = Grade::bad;
  run.verdict.judgements.back().text = "fastest floe <19> m/s";
  write_report(run, out(), false);
  const std::string html = page();
  EXPECT_NE(html.find("its verdict is bad"), std::string::npos);
  EXPECT_NE(html.find("floe speed</th><td>bad: fastest floe &lt;19&gt; m/s</td>"), std::string::npos);
  run.verdict.grade = Grade::doubtful;
  write_report(run, out(), false);
  EXPECT_EQ(page().find("its verdict is bad"), std::string::npos);
  EXPECT_NE(page().find("<strong>doubtful</strong>"), std::string::npos);
}

TEST_F(Report, SaysWhatTheAnalysisSays) {
  const RunData run = swinging_platform();
  const std::vector<Finding> analysis = whole_run_analysis(run);
  write_report(run, out(), false);
  const std::string html = page();
  const IntervalEstimate offset = finding_of(analysis, "x_offset_m").interval.value();
  const std::string half = decimal_text(500.0 * (offset.high - offset.low), 1);
  EXPECT_NE(html.find("&plusmn; " + half), std::string::npos) << half;
  // The record has 19 times between crossings, one too few for the page and for the analysis.
  EXPECT_FALSE(finding_of(analysis, "x_period_by_crossings_s").value.has_value());
  EXPECT_NE(html.find("up-crossings</th><td>not resolved</td><td>not resolved</td>"), std::string::npos);
}

TEST_F(Report, ShowsTheMainPeriodWithItsInterval) {
  RunData run = swinging_platform();
  write_report(run, out(), false);
  const IntervalEstimate period = finding_of(whole_run_analysis(run), "x_period_by_spectrum_s").interval.value();
  ASSERT_LT(period.high, 2.0 * period.low);
  EXPECT_NE(page().find("<strong>" + rounded_text(period.value, 3) + " s</strong><span>main period in x, " +
                        rounded_text(period.low, 3) + " to " + rounded_text(period.high, 3) + " s; natural"),
            std::string::npos);
}

TEST(Headline, AMainPeriodOfAFactorOfTwoIsNotResolved) {
  const RunData run = swinging_platform();
  const std::vector<Finding> analysis = {{"x_period_by_spectrum_s", 117.0, IntervalEstimate{117.0, 86.0, 185.0}}};
  const std::string html = headline_html(run, run_findings(run), analysis);
  EXPECT_NE(html.find("<strong>not resolved</strong><span>main period in x, 86.0 to 185 s"), std::string::npos) << html;
}

TEST(Headline, ShowsNoNumbersWithoutContact) {
  RunData run = swinging_platform();
  for (auto* column : {&run.platform.ice_force_x, &run.platform.ice_force_mean_x, &run.platform.contacts})
    std::fill(column->begin(), column->end(), 0.0);
  run.events = {};
  RunFindings findings = run_findings(run);
  EXPECT_TRUE(without_contact(run, findings.loads));
  // A platform that swings by itself loads its mooring.
  EXPECT_NE(headline_html(run, findings, {}).find("<strong>150 kN</strong><span>largest mooring"), std::string::npos);
  EXPECT_NE(headline_html(run, findings, {}).find("<strong>no contact</strong><span>largest ice"), std::string::npos);
  for (double& x : run.platform.x) x = 1e-14;
  for (double& y : run.platform.y) y = 0.0;
  findings = run_findings(run);
  EXPECT_NE(headline_html(run, findings, {}).find("<strong>no contact</strong><span>largest mooring"),
            std::string::npos);
  EXPECT_NE(motion_html(run, findings, {}).find("largest excursion from rest</th><td>none"), std::string::npos);
}

TEST(Loads, SayWhenAndWhere) {
  const RunData run = swinging_platform();
  const std::string html = loads_html(run, run_findings(run), {});
  EXPECT_NE(html.find("one sample (0.5 s), largest</th><td>20.0 kN in the 0.5 s up to 200 s, 0&deg; from +x"),
            std::string::npos)
      << html;
  EXPECT_NE(html.find("over 1 s, largest</th><td>10.0 kN in the 1 s up to 200 s, 0&deg; from +x"), std::string::npos);
}

TEST(RunFindings, RefuseUnevenSamples) {
  RunData run = swinging_platform();
  run.platform.time[700] += 0.1;
  EXPECT_THROW(run_findings(run), Error);
}

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
  body.outline = kSquare;
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
