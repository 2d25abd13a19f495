// Columns of any length, read piece by piece.
#include "gem/record/run_file/column_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/record/fake_engine.h"
#include "gem/record/hdf5/untrusted_file.h"
#include "gem/record/recorder.h"
#include "gem/record/run_file/crafted_structures.h"
#include "gem/record/run_file/run_layout.h"

namespace gem {
namespace {

constexpr hsize_t classes = OverlapCount::classes;

class ColumnPieces : public testing::Test {
 protected:
  /// Writes a run file with a frame after each of `steps` time steps.
  void write(int steps) {
    scene_.output.floes_interval_s = scene_.numerics.time_step_s;
    FakeEngine engine(scene_, fake_field(1));
    RunLayout layout(path_, scene_, engine.bodies(), Provenance{});
    Recorder recorder(scene_, engine);
    for (int n = 0; n < steps; ++n) {
      StepLog log;
      engine.advance(1, log);
      recorder.add(log, steps);
      recorder.add_frame(engine, 0.1 * n);
    }
    layout.append(recorder.take());
    layout.append_rest();
    layout.flush([] {});
    layout.close();
  }

  void change(const std::function<void(hid_t)>& body) const {
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    body(file);
    H5Fclose(file);
  }

  ScratchFolder folder_{"gem pieces"};
  std::string path_ = (folder_.path() / "run.h5").string();
  SceneDef scene_;
};

/// A table of counts with `rows` rows of zeros, as a long run has it, and `written` of its chunks in the file.
void put_counts(hid_t file, hsize_t rows, hsize_t written) {
  constexpr hsize_t chunk_rows = 8192;
  put_dataset(file, "stats/overlap_count", {H5T_IEEE_F64LE, {rows, classes}, [](hid_t creation) {
                                              chunk_of(creation, {chunk_rows, classes});
                                              H5Pset_deflate(creation, 1);
                                            }});
  const hid_t table = H5Dopen2(file, "stats/overlap_count", H5P_DEFAULT), all = H5Dget_space(table);
  hsize_t place[2] = {0, 0}, count[2] = {chunk_rows, classes}, bytes = 0;
  const std::vector<double> zeros(chunk_rows * classes);
  const hid_t memory = H5Screate_simple(2, count, nullptr);
  H5Sselect_hyperslab(all, H5S_SELECT_SET, place, nullptr, count, nullptr);
  ASSERT_GE(H5Dwrite(table, H5T_NATIVE_DOUBLE, memory, all, H5P_DEFAULT, zeros.data()), 0);
  H5Fflush(file, H5F_SCOPE_LOCAL);  // packs the first chunk; the others are copies of it
  ASSERT_GE(H5Dget_chunk_storage_size(table, place, &bytes), 0);
  std::vector<unsigned char> packed(bytes);
  std::uint32_t filters = 0;
  ASSERT_GE(H5Dread_chunk(table, H5P_DEFAULT, place, &filters, packed.data()), 0);
  for (hsize_t n = 1; n < written; ++n) {
    place[0] = n * chunk_rows;
    ASSERT_GE(H5Dwrite_chunk(table, H5P_DEFAULT, filters, place, bytes, packed.data()), 0);
  }
  H5Sclose(memory);
  H5Sclose(all);
  H5Dclose(table);
}

TEST_F(ColumnPieces, HoldEachRowOnceAndInOrder) {
  write(4000);
  const RunFile file(path_, true);
  const std::vector<std::string> names = {"stats/time", "stats/overlap_count", "stats/wall_time"};
  std::vector<std::vector<double>> all(names.size());
  int pieces = 0;
  for_each_piece(file, names, [&](const ColumnPiece& piece) {
    EXPECT_EQ(piece.first, all[0].size());
    EXPECT_EQ(piece.values[0].size(), piece.rows);
    for (std::size_t c = 0; c < names.size(); ++c)
      all[c].insert(all[c].end(), piece.values[c].begin(), piece.values[c].end());
    ++pieces;
  });
  EXPECT_GT(pieces, 1);
  for (std::size_t c = 0; c < names.size(); ++c) EXPECT_EQ(all[c], file.column(names[c])) << names[c];
}

TEST_F(ColumnPieces, GiveTheSumOfAllCounts) {
  write(4000);
  const RunFile file(path_, true);
  const OverlapCount sum = overlaps_of(file, "stats/overlap_count");
  EXPECT_EQ(sum.total(), 4000);
  EXPECT_EQ(sum.count[OverlapCount::class_of(1e-3)], 4000);
  EXPECT_EQ(last_value(file, "stats/steps"), 4000.0);
  EXPECT_EQ(largest_value(file, "stats/wall_time"), 0.1 * 3999);
  EXPECT_EQ(largest_value(file, "stats/none"), 0.0);
  EXPECT_EQ(last_value(file, "stats/none"), 0.0);
}

TEST_F(ColumnPieces, RefuseColumnsOfDifferentLengths) {
  write(30);
  const RunFile file(path_, true);
  EXPECT_THROW(for_each_piece(file, {"stats/time", "shape/mass"}, [](const ColumnPiece&) {}), Error);
}

TEST_F(ColumnPieces, ReadATableThatIsTooLargeToReadAtOnce) {
  write(30);
  constexpr hsize_t rows = 400000;
  static_assert(rows * classes > hdf5::values_at_once(0));
  change([](hid_t file) { put_counts(file, rows, (rows + 8191) / 8192); });
  const RunFile file(path_, true);
  EXPECT_EQ(overlaps_of(file, "stats/overlap_count").total(), 0);
}

TEST_F(ColumnPieces, DoNotOpenATableThatTheFileCannotHold) {
  write(30);
  change([](hid_t file) { put_counts(file, 400000, 2); });
  try {
    const RunFile file(path_, true);
    ADD_FAILURE() << "it was read";
  } catch (const Error& refused) {
    EXPECT_NE(std::string(refused.what()).find("more data than the file holds"), std::string::npos) << refused.what();
  }
}

TEST(ValuesAtOnce, GrowWithTheFile) {
  EXPECT_EQ(hdf5::values_at_once(1000), hsize_t{1} << 27);
  EXPECT_EQ(hdf5::values_at_once(hsize_t{1} << 30), hsize_t{1} << 30);
  EXPECT_EQ(hdf5::values_together(1000), hsize_t{1} << 30);
}

}  // namespace
}  // namespace gem
