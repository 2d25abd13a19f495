// Rows of a column whose chunks do not all stand in the file.
#include "gem/record/hdf5/row_extent.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <vector>

#include "gem/base/scratch_folder.h"

namespace gem::hdf5 {
namespace {

constexpr hsize_t chunk_rows = 4;

/// A column of 42 rows in 11 chunks, of which some are not written. `width` above 1: two dimensions, chunks of 2.
class RowExtent : public testing::Test {
 protected:
  Handle column(const std::set<hsize_t>& missing, hsize_t width = 1) {
    const int rank = width > 1 ? 2 : 1;
    const hsize_t size[2] = {42, width}, most[2] = {H5S_UNLIMITED, width}, chunk[2] = {chunk_rows, 2};
    const Handle space = checked(H5Screate_simple(rank, size, most), H5Sclose, "space");
    const Handle creation = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "creation");
    check(H5Pset_chunk(creation, rank, chunk), "chunk");
    file_ = checked(H5Fcreate(next_path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, "file");
    Handle id =
        checked(H5Dcreate2(file_, "x", H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose, "column");
    const std::vector<double> values(chunk_rows * 2, 1.0);
    for (hsize_t n = 0; n < 11; ++n)
      for (hsize_t first = 0; first < width; first += 2) {
        const hsize_t place[2] = {n * chunk_rows, first};
        if (missing.contains(n) && first + 2 >= width) continue;  // of a wide row the last part
        check(H5Dwrite_chunk(id, H5P_DEFAULT, 0, place, chunk_rows * (width > 1 ? 2 : 1) * 8, values.data()), "write");
      }
    return id;
  }

  /// A dataset that lives keeps its file open, so each column has a file of its own.
  std::string next_path() { return (folder_.path() / (std::to_string(++files_) + ".h5")).string(); }

  ScratchFolder folder_{"gem row extent"};
  int files_ = 0;
  Handle file_;
};

TEST_F(RowExtent, AllChunksStand) {
  EXPECT_EQ(rows_on_disk(column({}), 1000000, 1), 42u);
  EXPECT_EQ(rows_on_disk(column({}), 1000000, 1000), 42u);
}

TEST_F(RowExtent, TheLastChunksAreMissing) {
  EXPECT_EQ(rows_on_disk(column({9, 10}), 1000000, 1), 36u);
  EXPECT_EQ(rows_on_disk(column({9, 10}, 6), 1000000, 1), 36u) << "of a wide row the last part";
}

TEST_F(RowExtent, AChunkInTheMiddleIsMissing) {
  EXPECT_EQ(rows_on_disk(column({8}), 1000000, 1), 42u) << "only the last one is looked at";
  EXPECT_EQ(rows_on_disk(column({8}), 1000000, 3), 32u);
  EXPECT_EQ(rows_on_disk(column({8}), 1000000, 2), 42u) << "beyond what is looked at";
  EXPECT_EQ(rows_on_disk(column({6, 8, 10}), 1000000, 2), 24u);
  EXPECT_EQ(rows_on_disk(column({0}, 6), 1000000, 1000), 0u);
}

TEST_F(RowExtent, AChunkBehindTheEndOfTheFileIsMissing) {
  const Handle id = column({});
  const hsize_t place[2] = {8 * chunk_rows, 0};
  unsigned filters = 0;
  haddr_t address = 0;
  hsize_t bytes = 0;
  check(H5Dget_chunk_info_by_coord(id, place, &filters, &address, &bytes), "chunk");
  EXPECT_EQ(rows_on_disk(id, address + bytes, 1), 36u);
  EXPECT_EQ(rows_on_disk(id, address + bytes - 1, 1), 32u);
}

}  // namespace
}  // namespace gem::hdf5
