// A summary read back through the library itself.
#include "gem/record/summary_file.h"

#include <gtest/gtest.h>
#include <hdf5_hl.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "gem/base/error.h"
#include "gem/record/hdf5_handle.h"

namespace gem {
namespace {

using hdf5::Handle;

SummaryTable two_runs() {
  SummaryTable table;
  table.title = "two runs";
  table.history = "gem sweep collect";
  table.runs = {"one", "tw\xc3\xb6"};
  table.time = {0.0, 1.0, 2.0};
  table.columns = {{"gap_m", "m", "gap", true, {400.0, 300.0}},
                   {"offset_m", "m", "offset", false, {1.5, std::nan("")}},
                   {"engine", "", "engine", false, {}, {"cpu", "reference"}}};
  table.series = {{"x", "m", "displacement", {0.0F, 1.0F, 2.0F, 0.5F, 1.5F, std::nanf("")}}};
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
