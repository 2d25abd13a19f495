// The memory that a growing file takes.
#include "gem/record/hdf5/column_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "gem/base/scratch_folder.h"

namespace gem {
namespace {

TEST(ColumnFile, KeepsLittleOfItsIndexInMemory) {
  const ScratchFolder folder{"gem column file"};
  const Column column{"stats", "value", "time", Stored::f8, "1", "a value", ""};
  const Column time{"stats", "time", "time", Stored::f8, "s", "time", ""};
  const ChunkShape chunk = chunk_shape(0);
  ColumnFile file((folder.path() / "run.h5").string(), {}, chunk);
  file.add_group("stats");
  file.add_column(time, nullptr);
  file.add_column(column, nullptr);
  file.start();
  const std::vector<double> rows(1024 * chunk.frames, 1.5);
  std::size_t largest = 0, between = 0;
  for (int n = 0; n < 200; ++n) {
    for (const char* path : {"/stats/time", "/stats/value"}) file.append(path, rows, rows.size(), Rows::whole);
    between = std::max(between, file.index_bytes());
    file.flush();
    largest = std::max(largest, file.index_bytes());
  }
  // 400,000 chunks take 14 bytes each in the index; the library keeps a megabyte, and the flush before it grew by 2048
  constexpr std::size_t megabyte = 1 << 20;
  EXPECT_LE(largest, megabyte);
  EXPECT_LE(between, 2 * megabyte);
  file.close();
}

}  // namespace
}  // namespace gem
