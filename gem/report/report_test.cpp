// What the tables of a report say.
#include "gem/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gem/base/error.h"
#include "gem/report/page_tables.h"
#include "gem/report/report_fixture.h"
#include "gem/report/run/run_findings.h"

namespace gem {
namespace {

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

}  // namespace
}  // namespace gem
