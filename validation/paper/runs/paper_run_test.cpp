// Run files become conditions and numbers, other files are listed, and disturbed runs find their partner.
#include "validation/paper/runs/paper_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/report/figures/run_program.h"
#include "validation/paper/page/paper_report.h"
#include "validation/paper/runs/null_model.h"
#include "validation/paper/studies/divergence_study.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

class PaperRunFiles : public ::testing::Test {
 protected:
  void run(const std::string& file, std::vector<std::string> settings) {
    std::vector<std::string> command = {GEM_PROGRAM,
                                        "run",
                                        std::string(GEM_SOURCE_DIR) + "/" + case_,
                                        "--threads",
                                        "1",
                                        "--out",
                                        (folder_ / file).string()};
    for (std::string& setting : settings) command.insert(command.end(), {"--set", std::move(setting)});
    const ProgramResult result = run_program(command, folder_);
    ASSERT_EQ(result.exit_code, 0) << result.output;
  }

  ScratchFolder scratch_{"gem_paper"};
  const fs::path& folder_ = scratch_.path();
  std::string case_ = "cases/analytic/V39_free_swing.toml";
};

TEST_F(PaperRunFiles, AFreeSwingHasThePeriodOfMassAndMooring) {
  run("swing.h5", {"run.duration_s=1800"});
  const PaperRun swing = read_paper_run((folder_ / "swing.h5").string());
  EXPECT_EQ(swing.condition, "V39");
  const double expected = 2.0 * std::numbers::pi * std::sqrt(1e8 / 5e5);
  ASSERT_TRUE(swing.numbers.find("free_period_s"));
  EXPECT_NEAR(swing.numbers.find("free_period_s")->value, expected, 1e-6 * expected);
  EXPECT_FALSE(swing.numbers.find("floe_count"));
  EXPECT_EQ(swing.excursion_peaks.size(), 20U);
  EXPECT_NEAR(swing.excursion_peaks.front(), 1.0, 1e-9);
}

TEST_F(PaperRunFiles, AFolderIsReadBySeedAndWhatIsNoRunIsListed) {
  run("b.h5", {"run.duration_s=60", "run.seed=2", "run.name=\"V39_s2\""});
  run("a.h5", {"run.duration_s=60", "run.seed=1", "run.name=\"V39_s1\""});
  run("again.h5", {"run.duration_s=60", "run.seed=1", "run.name=\"V39_s1\""});
  std::ofstream(folder_ / "broken.h5") << "no run";
  std::ofstream(folder_ / "notes.txt") << "not looked at";
  const PaperFolder folder = read_paper_folders({folder_.string()});
  ASSERT_EQ(folder.of("V39").size(), 2U);
  EXPECT_EQ(folder.of("V39")[0].seed, 1U);
  EXPECT_EQ(folder.of("V39")[1].seed, 2U);
  EXPECT_EQ(folder.numbers("V39", "duration_s").size(), 2U);
  EXPECT_EQ(folder.refused.size(), 1U);
  EXPECT_EQ(folder.repeated, 1U);
  EXPECT_TRUE(folder.of("other").empty());
  EXPECT_THROW(read_paper_folders({(folder_ / "nowhere").string()}), Error);
}

TEST_F(PaperRunFiles, AReportOfNothingReplacesNone) {
  const fs::path report = folder_ / "report";
  fs::create_directories(report / "figures");
  std::ofstream(report / "figures" / "old.svg") << "a picture";
  const auto message = [&] {
    try {
      write_paper_report({folder_.string()}, report.string(),
                         std::string(GEM_SOURCE_DIR) + "/validation/paper/paper.json");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(message().find("no file *.h5"), std::string::npos) << message();
  std::ofstream(folder_ / "broken.h5") << "no run";
  EXPECT_NE(message().find("broken.h5"), std::string::npos) << message();
  EXPECT_TRUE(fs::exists(report / "figures" / "old.svg"));
  EXPECT_FALSE(fs::exists(report / "README.md"));
}

TEST_F(PaperRunFiles, IceGivesLoadsAndCover) {
  case_ = "cases/004_400_25.toml";
  run("ice.h5", {"run.duration_s=120", "floes.count=300", "floes.length_m=100", "floes.width_m=300",
                 "floes.start_x_m=-155", "current.velocity_m_per_s=[1.0, 0.0]", "output.floes_interval_s=10"});
  const Numbers numbers = read_paper_run((folder_ / "ice.h5").string()).numbers;
  ASSERT_TRUE(numbers.find("platform_touches"));
  EXPECT_GT(numbers.find("platform_touches")->value, 10.0);
  EXPECT_EQ(numbers.find("floe_count")->value, 300.0);
  EXPECT_NEAR(numbers.find("cover_start")->value, 300.0 * 62.82 / 3e4, 0.03);
  EXPECT_GT(numbers.find("cover_ahead_largest")->value, numbers.find("cover_start")->value);
  EXPECT_LE(numbers.find("cover_ahead_largest")->value, 1.01);
  EXPECT_GT(numbers.find("ice_work_in_J")->value, 0.0);
  EXPECT_FALSE(numbers.find("free_period_s"));
}

TEST_F(PaperRunFiles, DisturbedRunsFindThePartnerOfTheirSeed) {
  const std::string floe =
      "floe=[{outline_m=[[-5,-5],[5,-5],[5,5],[-5,5]], position_m=[-60,3], velocity_m_per_s=[1,0], thickness_m=1}]";
  for (const char* seed : {"1", "2"})
    for (const char* moved : {"0.0", "1e-3"})
      run(std::string("moved_") + moved + "_" + seed + ".h5",
          {"run.duration_s=60", std::string("run.seed=") + seed, floe, "floes.moved_floe=0",
           std::string("run.name=\"moved_") + moved + "_s" + seed + "\"",
           std::string("floes.moved_by_m=[") + moved + ",0.0]", "platform.start_offset_m=[0.0,0.0]"});
  const DivergenceStudy study = divergence_study(read_paper_folders({folder_.string()}));
  ASSERT_EQ(study.pairs.size(), 2U);
  for (const DivergingPair& pair : study.pairs) {
    EXPECT_EQ(pair.moved_m, 1e-3);
    EXPECT_EQ(pair.distance.front(), 0.0);
    EXPECT_GT(pair.distance.back(), 0.0);  // the floe has hit the platform
    EXPECT_LT(pair.distance.back(), 1e-3);
  }
  FolderNumbers numbers;
  add_divergence_numbers(study, numbers);
  EXPECT_TRUE(numbers.contains("parted_share_0.001"));
}

/// Three pairs for each size of the disturbance. Their distances grow at 0.05/s from `start(size)` with a small
/// scatter.
DivergenceStudy growing_study(double (*start)(double)) {
  DivergenceStudy study;
  study.swing_m = 1e-2;
  std::vector<double> sizes, onsets;
  std::vector<std::uint64_t> fields;
  for (const double size : {1e-9, 1e-7, 1e-5}) {
    std::vector<std::vector<double>> distances;
    for (const double scatter : {0.8, 1.0, 1.25}) {
      std::vector<double> distance = {0.0};
      for (int i = 0; i < 600; ++i) distance.push_back(std::min(scatter * start(size) * std::exp(0.05 * i), 1e-2));
      sizes.push_back(size);
      fields.push_back(static_cast<std::uint64_t>(10.0 * scatter));
      onsets.push_back(onset_time(distance, 1.0, 1e-3).value());
      distances.push_back(std::move(distance));
    }
    study.growth[size] = growth_of(distances, 1.0, study.swing_m).value();
  }
  study.shift = onset_shift(sizes, onsets, fields);
  return study;
}

TEST(Divergence, TheOnsetShiftsAsTheGrowthOfWhatWasPutInSays) {
  const IntervalEstimate share = shift_over_growth(growing_study([](double size) { return size; })).value();
  EXPECT_NEAR(share.value, 1.0, 0.02);
  EXPECT_NEAR(share.low, 1.0, 0.05);
  EXPECT_NEAR(share.high, 1.0, 0.05);
}

TEST(Divergence, AnOnsetThatDoesNotKnowTheSizeOfTheMoveHasNoShift) {
  const IntervalEstimate share = shift_over_growth(growing_study([](double) { return 1e-14; })).value();
  EXPECT_NEAR(share.value, 0.0, 0.02);
  EXPECT_LT(share.high, 0.5);
  EXPECT_FALSE(shift_over_growth(DivergenceStudy{}).has_value());
}

TEST(NullModel, IsDampedAsByFloesThatHitOnce) {
  SceneDef scene;  // run 1: 4/10 of 0.5 m ice at 0.25 m/s
  const auto model = null_model(scene, 0.2);
  ASSERT_TRUE(model);
  EXPECT_NEAR(model->natural_period, 88.857658763, 1e-9);
  EXPECT_NEAR(model->damping_ratio, 4.3e-4, 0.2e-4);  // the amplitude decays by e in about 9 h
  EXPECT_EQ(model->impulse_rate, 0.2);
  scene.mooring.stiffness_N_per_m = 0.0;
  EXPECT_FALSE(null_model(scene, 0.2));
}

}  // namespace
}  // namespace gem
