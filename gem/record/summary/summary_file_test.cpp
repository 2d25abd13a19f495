// A summary is written and read back through the library.
#include "gem/record/summary/summary_file.h"

#include <gtest/gtest.h>
#include <hdf5_hl.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "gem/base/error.h"
#include "gem/record/hdf5/hdf5_handle.h"

namespace gem {
namespace {

using hdf5::Handle;

SummaryTable two_runs() {
  SummaryTable table;
  table.title = "two runs";
  table.history = "gem sweep collect";
  table.runs = {"one", "tw\xc3\xb6"};
  table.axes = {{"time", "s", "time", {0.0, 1.0, 2.0}}, {"block", "s", "start", {0.0, 600.0}}};
  table.columns = {{"gap_m", "m", "gap", true, {400.0, 300.0}},
                   {"offset_m", "m", "offset", false, {1.5, std::nan("")}},
                   {"engine", "", "engine", false, {}, {"cpu", "reference"}}};
  table.series = {{"x", "m", "displacement", "time", false, {0.0, 1.0, 2.0, 0.5, 1.5, std::nan("")}},
                  {"largest", "m", "largest", "block", true, {1.0 / 3.0, 0.1, 1e-9, 7.0}}};
  return table;
}

TEST(SummaryFile, HoldsColumnsSeriesAndTheirScales) {
  const std::string path = testing::TempDir() + "gem_summary_test.h5";
  write_summary(path, true, two_runs());
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  ASSERT_TRUE(file.valid());
  const Handle offset(H5Dopen2(file, "offset_m", H5P_DEFAULT), H5Dclose);
  std::array<double, 2> offsets{};
  ASSERT_GE(H5Dread(offset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, offsets.data()), 0);
  EXPECT_EQ(offsets[0], 1.5);
  EXPECT_TRUE(std::isnan(offsets[1]));
  EXPECT_GT(H5Aexists(offset, "coordinates"), 0);
  const Handle gap(H5Dopen2(file, "gap_m", H5P_DEFAULT), H5Dclose);
  EXPECT_EQ(H5Aexists(gap, "coordinates"), 0) << "a coordinate has none itself";

  const Handle x(H5Dopen2(file, "x", H5P_DEFAULT), H5Dclose);
  const Handle run(H5Dopen2(file, "run", H5P_DEFAULT), H5Dclose);
  const Handle time(H5Dopen2(file, "time", H5P_DEFAULT), H5Dclose);
  EXPECT_GT(H5DSis_attached(x, run, 0), 0);
  EXPECT_GT(H5DSis_attached(x, time, 1), 0);
  EXPECT_GT(H5DSis_attached(offset, run, 0), 0);
  std::array<float, 6> rows{};
  ASSERT_GE(H5Dread(x, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()), 0);
  EXPECT_EQ(rows[2], 2.0F);
  EXPECT_EQ(rows[3], 0.5F);
  EXPECT_TRUE(std::isnan(rows[5]));
}

TEST(SummaryFile, ComesBackAsItWasWritten) {
  const std::string path = testing::TempDir() + "gem_summary_back.h5";
  SummaryTable written = two_runs();
  const std::string first(300, 'a');
  written.columns.push_back({"case_toml", "", "case", false, {}, {first, "\xc3\xb6 = 1\n"}});
  write_summary(path, true, written);
  ASSERT_TRUE(is_summary(path));
  const SummaryTable table = read_summary(path);
  EXPECT_EQ(table.title, "two runs");
  EXPECT_EQ(table.runs, written.runs);
  ASSERT_NE(table.column("case_toml"), nullptr);
  EXPECT_EQ(table.column("case_toml")->texts, (std::vector<std::string>{first, "\xc3\xb6 = 1\n"}));
  EXPECT_EQ(table.column("engine")->texts, (std::vector<std::string>{"cpu", "reference"}));
  EXPECT_TRUE(table.column("gap_m")->is_setting);
  EXPECT_FALSE(table.column("offset_m")->is_setting);
  EXPECT_EQ(table.column("offset_m")->numbers[0], 1.5);
  EXPECT_TRUE(std::isnan(table.column("offset_m")->numbers[1]));
  EXPECT_EQ(table.column("none"), nullptr);
  ASSERT_NE(table.one_series("largest"), nullptr);
  EXPECT_EQ(table.one_series("largest")->values[0], 1.0 / 3.0) << "double precision is kept where it is asked for";
  EXPECT_EQ(table.one_series("largest")->axis, "block");
  EXPECT_TRUE(table.one_series("largest")->exact);
  EXPECT_EQ(table.one_series("x")->axis, "time");
  EXPECT_EQ(table.one_series("x")->values[4], 1.5);
  ASSERT_NE(table.axis("block"), nullptr);
  EXPECT_EQ(table.axis("block")->values[1], 600.0);
}

TEST(SummaryFile, KnowsWhatIsNoSummary) {
  EXPECT_FALSE(is_summary(testing::TempDir() + "gem_summary_nowhere.h5"));
  EXPECT_THROW(read_summary(testing::TempDir() + "gem_summary_nowhere.h5"), Error);
  EXPECT_FALSE(is_summary(std::string(GEM_SOURCE_DIR) + "/README.md"));
}

TEST(SummaryFile, WhatDoesNotFitTogetherIsNamed) {
  const std::string path = testing::TempDir() + "gem_summary_unfit.h5";
  const auto message = [&] {
    try {
      read_summary(path);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  write_summary(path, true, two_runs());
  EXPECT_EQ(message(), "");
  {
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    const std::array<hsize_t, 1> three = {3};
    const std::array<double, 3> values{};
    ASSERT_GE(H5LTmake_dataset_double(file, "longer", 1, three.data(), values.data()), 0);
  }
  EXPECT_NE(message().find("longer has not one value for each run"), std::string::npos) << message();
  write_summary(path, true, two_runs());
  {
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    const Handle x(H5Dopen2(file, "x", H5P_DEFAULT), H5Dclose);
    const Handle time(H5Dopen2(file, "time", H5P_DEFAULT), H5Dclose);
    ASSERT_GE(H5DSdetach_scale(x, time, 1), 0);
  }
  EXPECT_NE(message().find("x has no scale"), std::string::npos) << message();
}

TEST(SummaryFile, ReplacesOnlyWhenTold) {
  const std::string path = testing::TempDir() + "gem_summary_kept.h5";
  write_summary(path, true, two_runs());
  const auto size = std::filesystem::file_size(path);
  EXPECT_THROW(write_summary(path, false, two_runs()), Error);
  EXPECT_EQ(std::filesystem::file_size(path), size);
  EXPECT_THROW(write_summary(testing::TempDir() + "none/summary.h5", false, two_runs()), Error);
}

}  // namespace
}  // namespace gem
