// The manifest of a sweep and its updates: nothing is lost, and its cost does not grow with the number of runs.
#include "gem/command/sweep/folder/sweep_manifest.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/command/sweep/folder/sweep_folder.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

std::vector<SweepRow> rows_of(int runs) {
  std::vector<SweepRow> rows;
  for (int k = 1; k <= runs; ++k) {
    SweepRow row;
    row.index = k;
    row.name = "run_" + std::to_string(k);
    rows.push_back(row);
  }
  return rows;
}

class SweepManifest : public testing::Test {
 protected:
  void update(const SweepRow& row, const std::string& status) {
    SweepRow changed = row;
    changed.status = status;
    update_manifest(folder(), {changed});
  }
  std::string folder() const { return folder_.path().string(); }
  fs::path updates() const { return folder_.path() / "manifest.updates"; }
  /// What is left of the updates if the process that wrote the manifest was killed before it removed them. Makes
  /// `change` write the manifest.
  void kill_before_removal(const std::function<void()>& change) {
    const fs::path kept = folder_.path() / "kept";
    while (fs::exists(updates())) {
      fs::remove(kept);
      fs::create_hard_link(updates(), kept);
      change();
    }
    fs::rename(kept, updates());
  }
  fs::path manifest() const { return folder_.path() / "manifest.json"; }

 private:
  ScratchFolder folder_;
};

TEST_F(SweepManifest, KeepsTheNewestRowOfEachRun) {
  const std::vector<SweepRow> rows = rows_of(40);
  write_manifest(folder(), rows);
  update(rows[30], "running");
  update(rows[2], "failed");
  update(rows[30], "done");
  ASSERT_TRUE(fs::exists(updates()));
  const auto check = [&] {
    const std::vector<SweepRow> read = read_manifest(folder());
    ASSERT_EQ(read.size(), 40u);
    for (std::size_t k = 0; k < 40; ++k) {
      EXPECT_EQ(read[k].index, static_cast<std::int64_t>(k + 1));
      EXPECT_EQ(read[k].status, k == 30 ? "done" : k == 2 ? "failed" : "missing");
    }
  };
  check();
  settle_manifest(folder());
  EXPECT_FALSE(fs::exists(updates()));
  check();
}

TEST_F(SweepManifest, PassesOverALineThatAKilledProcessLeftUnfinished) {
  const std::vector<SweepRow> rows = rows_of(40);
  write_manifest(folder(), rows);
  update(rows[0], "done");
  fs::resize_file(updates(), fs::file_size(updates()) - 10);
  EXPECT_EQ(read_manifest(folder())[0].status, "missing");
  update(rows[1], "done");
  EXPECT_EQ(read_manifest(folder())[0].status, "missing");
  EXPECT_EQ(read_manifest(folder())[1].status, "done");
}

TEST_F(SweepManifest, WritesBytesInProportionToItsRowsHoweverManyTheyAre) {
  constexpr int runs = 300;
  const std::vector<SweepRow> rows = rows_of(runs);
  write_manifest(folder(), rows);
  int rewritten = 0;
  for (const SweepRow& row : rows) {
    for (const char* const status : {"running", "done"}) {
      update(row, status);
      if (!fs::exists(updates())) ++rewritten;
      EXPECT_LE(fs::exists(updates()) ? fs::file_size(updates()) : 0, fs::file_size(manifest()));
    }
  }
  EXPECT_GE(rewritten, 1);
  EXPECT_LE(rewritten, 3) << "600 updates are about two manifests in size";
  for (const SweepRow& row : read_manifest(folder())) EXPECT_EQ(row.status, "done");
}

TEST_F(SweepManifest, AKillBeforeTheUpdatesAreRemovedBringsBackNoOldRow) {
  const std::vector<SweepRow> rows = rows_of(3);
  write_manifest(folder(), rows);
  update(rows[0], "running");
  ASSERT_TRUE(fs::exists(updates()));
  int number = 0;
  kill_before_removal([&] { update(rows[0], "step " + std::to_string(++number)); });
  ASSERT_GE(number, 1);
  EXPECT_EQ(read_manifest(folder())[0].status, "step " + std::to_string(number));
}

TEST_F(SweepManifest, AKilledSweepOfOtherCasesLeavesNoOldRowEither) {
  std::vector<SweepRow> rows = rows_of(3);
  write_manifest(folder(), rows);
  update(rows[1], "failed");
  ASSERT_TRUE(fs::exists(updates()));
  rows[1].case_sha256 = "another";
  kill_before_removal([&] { enter_folder(folder(), rows); });
  EXPECT_EQ(read_manifest(folder())[1].case_sha256, "another");
  EXPECT_EQ(read_manifest(folder())[1].status, "missing");
}

TEST_F(SweepManifest, ADamagedOneIsRemovedOnlyWhereNoRunWasMade) {
  const auto advice = [&] {
    try {
      read_manifest(folder());
    } catch (const Error& fault) {
      EXPECT_EQ(fault.code(), ExitCode::file_system);
      return std::string(fault.what());
    }
    return std::string("read");
  };
  std::ofstream(manifest()) << "{\"runs\": [";
  EXPECT_NE(advice().find("remove it; no run has been made here"), std::string::npos) << advice();
  std::ofstream(folder() + "/run_1.h5.checkpoint-a") << "state";
  EXPECT_EQ(advice().find("remove"), std::string::npos) << advice();
  EXPECT_NE(advice().find("rename it; then `gem sweep status SWEEPFILE --out "), std::string::npos) << advice();
}

TEST_F(SweepManifest, UpdatesThatCannotBeReadAreNamed) {
  write_manifest(folder(), rows_of(3));
  fs::create_directory(updates());
  try {
    read_manifest(folder());
    ADD_FAILURE() << "read";
  } catch (const Error& fault) {
    EXPECT_EQ(fault.code(), ExitCode::file_system);
    EXPECT_NE(std::string(fault.what()).find("manifest.updates"), std::string::npos) << fault.what();
    EXPECT_NE(std::string(fault.what()).find("make it a file that can be read"), std::string::npos) << fault.what();
  }
}

TEST_F(SweepManifest, WithoutItThereAreNoRows) {
  write_manifest(folder(), rows_of(20));
  update(rows_of(1)[0], "done");
  ASSERT_TRUE(fs::exists(updates()));
  fs::remove(manifest());
  EXPECT_TRUE(read_manifest(folder()).empty());
}

}  // namespace
}  // namespace gem
