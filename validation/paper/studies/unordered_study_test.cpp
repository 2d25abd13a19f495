// Rows of repeats without a fixed order are read into pairs by kind, and mistakes in them are reported.
#include "validation/paper/studies/unordered_study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/base/scratch_folder.h"

namespace gem {
namespace {

const std::string kHead = "contacts,sums,run,state_hash,x_deviation_m,a,b,c,d,e,f,g,h,i,commit\n";
const std::string kRuns = kHead +
                          "independent,ordered,0,aa,0.02,0,0,0,0,0,0,0,0,0,c0\n"
                          "independent,zero,1,bb,0.03,100,10,5,2e-8,3e-7,4e-8,5e-7,9,6e-13,c0\n"
                          "coupled,ordered,0,cc,0.04,0,0,0,0,0,0,0,0,0,c0\n";

/// Three pairs that grow from 1e-12 m at 0.1, 0.1 and 0.05 1/s, and one that stays together.
std::string growing() {
  std::string text = "t_s,independent:zero:1-2,independent:zero:3-4,independent:zero:1-0,coupled:zero:1-2\n";
  for (int i = 0; i < 200; ++i) {
    const double t = 2.0 * i;
    text += number_text(t);
    for (const double rate : {0.1, 0.1, 0.05})
      text += "," + (i == 0 ? "0" : number_text(std::fmin(0.02, 1e-12 * std::exp(rate * t)), 12));
    text += ",0\n";
  }
  return text;
}

UnorderedStudy study_of(const std::string& runs, const std::string& distances) {
  const ScratchFolder folder;
  if (!runs.empty()) folder.write("unordered_runs.csv", runs);
  if (!distances.empty()) folder.write("unordered_distances.csv", distances);
  return read_unordered_study(folder.path());
}

std::string message_of(const std::string& runs, const std::string& distances) {
  try {
    study_of(runs, distances);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(UnorderedStudy, PairsOfOneKindStandTogetherAndTellTheirGrowth) {
  const UnorderedStudy study = study_of(kRuns, growing());
  ASSERT_EQ(study.runs.size(), 3U);
  EXPECT_EQ(study.runs[1].changed, 5.0);
  EXPECT_EQ(study.runs[1].rounding_largest, 5e-7);
  EXPECT_EQ(study.runs[1].platform_rms, 6e-13);
  EXPECT_EQ(study.interval_s, 2.0);
  ASSERT_EQ(study.pairs.size(), 3U);
  EXPECT_EQ(study.pairs[0].distances.size(), 2U);
  EXPECT_TRUE(study.pairs[0].repeats);
  EXPECT_EQ(study.pairs[0].swing_m, 0.02);
  ASSERT_TRUE(study.pairs[0].growth);
  EXPECT_NEAR(study.pairs[0].growth->rate.value, 0.1, 1e-6);
  EXPECT_FALSE(study.pairs[1].repeats);
  EXPECT_FALSE(study.pairs[1].growth);  // one pair has no interval
  EXPECT_EQ(study.pairs[2].swing_m, 0.04);
}

TEST(UnorderedStudy, PartingIsThatOfIndependentRepeatsAlone) {
  FolderNumbers numbers;
  add_unordered_numbers(study_of(kRuns, growing()), numbers);
  ASSERT_TRUE(numbers.contains("unordered_parting_s"));
  const Measured& parting = numbers.at("unordered_parting_s");
  EXPECT_EQ(parting.each.size(), 2U);
  EXPECT_NEAR(parting.value, std::log(0.01 / 1e-12) / 0.1, 1e-6);
}

TEST(UnorderedStudy, WithoutRowsThereIsNone) {
  const UnorderedStudy study = study_of("", "");
  EXPECT_TRUE(study.runs.empty());
  FolderNumbers numbers;
  add_unordered_numbers(study, numbers);
  EXPECT_TRUE(numbers.empty());
}

TEST(UnorderedStudy, FaultsNameTheirFileAndLine) {
  EXPECT_NE(message_of(kRuns, "").find("unordered_distances.csv"), std::string::npos);
  EXPECT_NE(message_of(kHead + "independent,zero,1\n", growing()).find("line 2"), std::string::npos);
  EXPECT_NE(message_of(kRuns, "t_s,zero 1-2\n0,0\n").find("names no pair"), std::string::npos);
  EXPECT_NE(message_of(kRuns, "t_s,independent:zero:1-2\n0,0\n2,x\n").find("line 3"), std::string::npos);
  EXPECT_NE(message_of(kRuns, "t_s,independent:zero:1-2\n0,0\n2,0\n5,0\n").find("line 4"), std::string::npos);
}

TEST(UnorderedStudy, TheShippedRowsAreRead) {
  const UnorderedStudy study = read_unordered_study(GEM_SOURCE_DIR "/validation/paper");
  EXPECT_FALSE(study.runs.empty());
  EXPECT_FALSE(study.pairs.empty());
}

}  // namespace
}  // namespace gem
