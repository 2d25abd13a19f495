// A run in memory and a folder for its page, for tests of reports.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "gem/base/scratch_folder.h"
#include "gem/report/figures/run_program.h"
#include "gem/report/report.h"

namespace gem {

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
  const std::filesystem::path& folder_ = scratch_.path();
};

inline const Corners a_square = {{-2.0, -2.0}, {2.0, -2.0}, {2.0, 2.0}, {-2.0, 2.0}};

/// 1200 s of a platform that oscillates with 60 s about an offset of 0.2 m and is hit twice by one floe.
inline RunData swinging_platform() {
  RunData run;
  run.identity.name = "swing_<1>";
  run.identity.status = "complete";
  run.duration_s = 1200.0;
  run.natural_period_s = 60.0;
  run.current_speed = 0.5;
  run.force_window_s = 1.0;
  run.platform_outline = a_square;
  run.floe_outlines = {a_square, a_square};
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

}  // namespace gem
