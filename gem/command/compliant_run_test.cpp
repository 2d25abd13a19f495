// Compliant contacts from the case to the file, the verdict and the texts.
#include <gtest/gtest.h>

#include <algorithm>

#include "gem/command/command_fixture.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/verdict_attributes.h"
#include "gem/record/schema.h"

namespace gem {
namespace {

/// The corner of a floe hits a fixed platform.
class CompliantRunTest : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    std::ofstream(path("corner.toml"))
        << "[run]\nname = \"corner\"\nduration_s = 4.0\n[current]\nvelocity_m_per_s = [0.0, 0.0]\n[water]\n"
           "drag_law = \"none\"\n[floes]\nsource = \"listed\"\n[boundary]\npresent = false\n[platform]\n"
           "outline = \"listed\"\noutline_m = [[-50.0, -80.0], [50.0, -80.0], [50.0, 80.0], [-50.0, 80.0]]\n"
           "fixed = true\n[numerics]\ntime_step_s = 0.05\n[output]\nfloes_interval_s = 0.5\nplatform_interval_s = "
           "0.05\n[[floe]]\n"
           "outline_m = [[-7.0710678, 0], [0, -7.0710678], [7.0710678,0], [0, 7.0710678]]\n"
           "position_m = [-57.2, 0.0]\nvelocity_m_per_s = [0.5, 0.0]\nthickness_m = 1.0\n";
  }
  static std::string corner(const std::string& more) { return "gem run corner.toml --threads 1 " + more; }
  static std::string rigid(const std::string& more) { return corner("--set 'contact.solver=\"coupled\"' " + more); }
  static std::string compliant(const std::string& more) {
    return corner("--set 'contact.solver=\"compliant\"' " + more);
  }
  Judgement judged(const std::string& file, const std::string& criterion) const {
    for (const Judgement& one : verdict_of(RunFile(path(file))).judgements)
      if (one.criterion == criterion) return one;
    return {};
  }
};

TEST_F(CompliantRunTest, OnlyItsFileHasTheBooksOfTheContacts) {
  ASSERT_EQ(shell(compliant("-q --out c.h5") + " && " + rigid("-q --out rigid.h5")), 0) << text_of("err");
  const RunFile run(path("c.h5")), rigid(path("rigid.h5"));
  for (const auto& entry : compliant_stats_columns()) {
    const std::string name = "stats/" + entry.column.name;
    EXPECT_EQ(run.column(name).size(), run.rows("stats/time")) << name;
    EXPECT_FALSE(rigid.has(name)) << name;
  }
  EXPECT_FALSE(rigid.has("events/largest_force"));
  const std::vector<double> crushed = run.column("stats/energy_contact_crushed");
  EXPECT_TRUE(std::is_sorted(crushed.begin(), crushed.end()));
  // 91 t at 0.5 m/s: most of its energy crushes ice
  EXPECT_GT(crushed.back(), 0.5 * 11250.0);
  EXPECT_EQ(run.attribute("gem_solver"), "compliant");
}

TEST_F(CompliantRunTest, TheForceOfAHitIsTheLargestOfItsSubsteps) {
  ASSERT_EQ(shell(compliant("-q --out c.h5")), 0) << text_of("err");
  const RunFile run(path("c.h5"));
  ASSERT_EQ(run.rows("events/time"), 1U);
  const double largest = run.column("events/largest_force")[0], peak = run.column("events/force_peak")[0];
  EXPECT_NEAR(largest, peak, 0.1 * peak);
}

TEST_F(CompliantRunTest, ItsCoarseSubstepsTurnTheVerdict) {
  ASSERT_EQ(shell(compliant("--out c.h5")), 0) << text_of("err");
  const std::string summary = text_of("out");
  EXPECT_EQ(judged("c.h5", "softened_share").grade, Grade::good) << judged("c.h5", "softened_share").text;
  EXPECT_EQ(judged("c.h5", "created_energy").grade, Grade::good) << judged("c.h5", "created_energy").text;
  EXPECT_EQ(RunFile(path("c.h5")).attribute("gem_verdict"), "good");
  const std::size_t at = summary.find("substeps ");
  ASSERT_NE(at, std::string::npos) << summary;
  const int substeps = std::stoi(summary.substr(summary.find_first_of("0123456789", at)));
  ASSERT_EQ(shell(compliant("-q --out coarse.h5 --set numerics.substeps=" + std::to_string(substeps / 4))), 0);
  EXPECT_EQ(judged("coarse.h5", "softened_share").grade, Grade::bad) << judged("coarse.h5", "softened_share").text;
}

TEST_F(CompliantRunTest, TextsSayEnergiesInPlaceOfIterations) {
  ASSERT_EQ(shell(compliant("--out c.h5")), 0) << text_of("err");
  const std::string summary = text_of("out");
  for (const char* words : {"substeps ", "beyond crushed ice", "contact energy ", " crushed, ", "softened "})
    EXPECT_NE(summary.find(words), std::string::npos) << words << "\n" << summary;
  for (const char* words : {"iterations", "largest residual", "complementarity", "friction cone"})
    EXPECT_EQ(summary.find(words), std::string::npos) << words << "\n" << summary;
  for (const char* command : {"gem info c.h5", "gem analyse c.h5"}) {
    ASSERT_EQ(shell(command), 0) << text_of("err");
    EXPECT_NE(text_of("out").find(" crushed, "), std::string::npos) << command << "\n" << text_of("out");
    EXPECT_NE(text_of("out").find("of the load, through corners with less than half the stiffness of their ice"),
              std::string::npos);
  }
  ASSERT_EQ(shell(compliant("--json --out j.h5")), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("\"softened_share\""), std::string::npos);
  EXPECT_EQ(text_of("out").find("\"iterations\""), std::string::npos);
}

TEST_F(CompliantRunTest, AnotherRunBeginsWithCrushedIce) {
  ASSERT_EQ(shell(compliant("-q --out c.h5")), 0) << text_of("err");
  const RunFile run(path("c.h5"));
  const auto most = [&run](const char* name) {
    const std::vector<double> values = run.column(name);
    return *std::max_element(values.begin(), values.end());
  };
  // 364 kN crush 58.7 mm and shorten the spring of 5e7 N/m by 7.3 mm
  EXPECT_GT(most("stats/maximum_depth"), 7.0 * most("stats/maximum_overlap"));
  EXPECT_EQ(shell(compliant("-q --from c.h5@1 --out later.h5")), 0) << text_of("err");
  EXPECT_LT(RunFile(path("later.h5")).column("stats/energy_contact_crushed").back(), 100.0) << "it crushes again";
}

TEST_F(CompliantRunTest, ATableHasItsColumns) {
  ASSERT_EQ(shell(compliant("-q --out c.h5") + " && gem export c.h5 stats.csv --table stats && "
                                               "gem export c.h5 events.csv --table events"),
            0)
      << text_of("err");
  EXPECT_NE(text_of("stats.csv").find("energy_contact_crushed_J"), std::string::npos);
  EXPECT_NE(text_of("events.csv").find("largest_force_N"), std::string::npos);
}

TEST_F(CompliantRunTest, ItsKeysAreRefusedWithOtherSolvers) {
  for (const char* key : {"contact.face_stiffness_Pa=5e8", "contact.damping_ratio=0.5",
                          "contact.structure_stiffness_N_per_m=1e9", "numerics.substeps=20"}) {
    EXPECT_EQ(shell(rigid(std::string("--set ") + key)), 3) << key;
    EXPECT_NE(text_of("err").find("allowed only with contact.solver = \"compliant\""), std::string::npos)
        << text_of("err");
    EXPECT_EQ(shell(compliant(std::string("-q --overwrite --out c.h5 --set ") + key)), 0) << text_of("err");
  }
}

TEST_F(CompliantRunTest, IsNotForBaselines) {
  EXPECT_EQ(shell(compliant("-q --out c.h5")), 0) << text_of("err");
  EXPECT_EQ(RunFile(path("c.h5")).attribute("gem_engine"), "cpu");
  if (shell("gem run --help | grep -q velocity-iterations") != 0) GTEST_SKIP() << "built without a baseline";
  EXPECT_EQ(shell(compliant("--engine box2d --out b.h5")), 2);
  EXPECT_NE(text_of("err").find("the engine box2d cannot run contact.solver = \"compliant\""), std::string::npos);
}

}  // namespace
}  // namespace gem
