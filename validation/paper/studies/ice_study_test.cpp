// Rows of ice distances are read into pairs, and mistakes in them are reported.
#include "validation/paper/studies/ice_study.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/base/scratch_folder.h"

namespace gem {
namespace {

/// Distances that grow at 0.05/s: for `independent` from the size of the disturbance, for `coupled` from one size for
/// all.
std::string rows() {
  std::string text = "t_s";
  for (const char* contacts : {"independent", "coupled"})
    for (const char* moved : {"1e-9", "1e-7", "1e-5"})
      for (const char* seed : {"1", "2"}) text += "," + std::string(contacts) + ":" + moved + ":" + seed;
  text += "\n";
  for (int i = 0; i < 300; ++i) {
    text += number_text(2.0 * i);
    for (const bool independent : {true, false})
      for (const double moved : {1e-9, 1e-7, 1e-5})
        for (const double scatter : {0.9, 1.1})
          text +=
              "," + number_text(std::fmin(1.0, scatter * (independent ? moved : 1e-10) * std::exp(0.05 * 2.0 * i)), 8);
    text += "\n";
  }
  return text + "commit,c0\n";
}

IceStudy study_of(const std::string& text) {
  const ScratchFolder folder;
  if (!text.empty()) folder.write("ice_distances.csv", text);
  return read_ice_study(folder.path());
}

std::string message_of(const std::string& text) {
  try {
    study_of(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(IceStudy, PairsOfEachKindOfContactsTellTheirGrowthAndShift) {
  const IceStudy study = study_of(rows());
  EXPECT_EQ(study.commit, "c0");
  ASSERT_EQ(study.of_contacts.size(), 2U);
  EXPECT_EQ(study.of_contacts.at("coupled").pairs.size(), 6U);
  EXPECT_EQ(study.of_contacts.at("coupled").interval_s, 2.0);
  FolderNumbers numbers;
  add_ice_numbers(study, numbers);
  EXPECT_NEAR(numbers.at("ice_divergence_rate_independent_per_s").value, 0.05, 1e-3);
  EXPECT_NEAR(numbers.at("ice_onset_shift_independent").value, 1.0, 0.02);
  EXPECT_NEAR(numbers.at("ice_onset_shift_coupled").value, 0.0, 0.02);
}

TEST(IceStudy, WithoutRowsThereIsNone) {
  FolderNumbers numbers;
  add_ice_numbers(study_of(""), numbers);
  EXPECT_TRUE(numbers.empty());
}

TEST(IceStudy, FaultsNameTheirFileAndLine) {
  EXPECT_NE(message_of("t_s,coupled:1e-9:1\n0,1\n").find("no commit"), std::string::npos);
  EXPECT_NE(message_of("t_s,coupled 1e-9\n").find("names no pair"), std::string::npos);
  EXPECT_NE(message_of("t_s,coupled:1e-9:1\n0,1\n2\n").find("line 3"), std::string::npos);
  EXPECT_NE(message_of("t_s,coupled:1e-9:1\n0,1\n2,1\n5,1\n").find("line 4"), std::string::npos);
}

TEST(IceStudy, TheShippedRowsAreRead) {
  EXPECT_EQ(read_ice_study(GEM_SOURCE_DIR "/validation/paper").of_contacts.size(), 2U);
}

}  // namespace
}  // namespace gem
