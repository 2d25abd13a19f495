// What the repair mends, and that it leaves the file itself alone.
#include "gem/record/run_file/run_repair.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/record/fake_engine.h"
#include "gem/record/hdf5/hdf5_handle.h"
#include "gem/record/recorder.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/run_layout.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

class RunRepairTest : public testing::Test {
 protected:
  void SetUp() override {
    scene_.output.floes_interval_s = scene_.numerics.time_step_s;
    FakeEngine engine(scene_, fake_field(3));
    const std::string written = (folder_.path() / "written.h5").string();
    RunLayout layout(written, scene_, engine.bodies(), {});
    Recorder recorder(scene_, engine);
    for (int frame = 1; frame < 7; ++frame) {
      StepLog log;
      engine.advance(1, log);
      recorder.add(log, 100);
      recorder.add_frame(engine, 0.0);
    }
    layout.append(recorder.take());
    layout.flush([] {});
    fs::copy_file(written, path_);  // as after a kill
    layout.set_end("complete", 7, {});
    layout.close();
    fs::rename(written, complete_);
  }

  /// Makes a dataset of the complete file longer, as older programs did when they were killed: the new rows are zeros.
  void lengthen(const char* dataset, hsize_t rows, hsize_t width) {
    const hdf5::Handle file = hdf5::checked(H5Fopen(complete_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open");
    const hdf5::Handle id = hdf5::checked(H5Dopen2(file, dataset, H5P_DEFAULT), H5Dclose, dataset);
    const hsize_t size[2] = {rows, width};
    hdf5::check(H5Dset_extent(id, size), dataset);
  }

  static std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  ScratchFolder folder_{"gem repair"};
  std::string path_ = (folder_.path() / "killed.h5").string();
  std::string complete_ = (folder_.path() / "complete.h5").string();
  std::string mended_ = (folder_.path() / "mended.h5").string();
  SceneDef scene_;
};

TEST_F(RunRepairTest, AKilledRunGetsItsStatusAndOpensLikeAnyOther) {
  const std::string before = bytes_of(path_);
  const RepairReport report = repair_run_file(path_, mended_, false);
  EXPECT_EQ(report.output, mended_);
  EXPECT_EQ(bytes_of(path_), before);
  EXPECT_GE(H5Fclose(H5Fopen(mended_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)), 0);
  const RunFile file(mended_, true);
  EXPECT_EQ(file.status(), "stopped:killed");
  EXPECT_EQ(file.column("floes/x"), RunFile(path_, true).column("floes/x"));
  EXPECT_EQ(file.frame_count(), 7U);
}

TEST_F(RunRepairTest, LengthsAreEvenedAndZerosGo) {
  lengthen("/floes/vx", 40, 3);
  lengthen("/stats/time", 12, 0);  // within its chunk: a row of zeros
  lengthen("/stats/steps", 12, 0);
  EXPECT_EQ(RunFile(complete_).column("floes/vx").size(), 21U);
  const RepairReport report = repair_run_file(complete_, mended_, false);
  ASSERT_EQ(report.done.size(), 3U);
  EXPECT_EQ(report.done[0], "/floes: 7 whole rows kept, up to 33 rows without data cut");
  EXPECT_EQ(report.done[1], "/stats: 7 whole rows kept, up to 5 rows without data cut");
  EXPECT_EQ(report.done[2], "gem_status: complete -> stopped:repaired");
  EXPECT_EQ(repair_run_file(mended_, (folder_.path() / "again.h5").string(), false).output, "");
}

// The library would take the letters of the new status for an address.
TEST_F(RunRepairTest, AStatusOfVariableLengthIsReplaced) {
  {
    const hdf5::Handle file = hdf5::open_left_file(path_);
    hdf5::check(H5Adelete(file, "gem_status"), "delete");
    const hdf5::Handle type = hdf5::checked(H5Tcopy(H5T_C_S1), H5Tclose, "type");
    hdf5::check(H5Tset_size(type, H5T_VARIABLE), "type");
    const hdf5::Handle space = hdf5::checked(H5Screate(H5S_SCALAR), H5Sclose, "space");
    const hdf5::Handle status =
        hdf5::checked(H5Acreate2(file, "gem_status", type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "status");
    const char* text = "running";
    hdf5::check(H5Awrite(status, type, &text), "status");
  }
  EXPECT_EQ(RunFile(path_, true).status(), "running");
  EXPECT_EQ(repair_run_file(path_, mended_, false).output, mended_);
  EXPECT_EQ(RunFile(mended_, true).status(), "stopped:killed");
}

TEST_F(RunRepairTest, NumbersOfAnotherLengthAreReplaced) {
  const hdf5::Handle file = hdf5::open_left_file(path_);
  hdf5::write_numbers(file, "values", H5T_IEEE_F64LE, std::vector<double>(100, 1.0));
  hdf5::write_numbers(file, "values", H5T_IEEE_F64LE, {2.0, 3.0});
  EXPECT_EQ(H5Aget_storage_size(hdf5::checked(H5Aopen(file, "values", H5P_DEFAULT), H5Aclose, "values")), 16U);
}

TEST_F(RunRepairTest, NothingWrongNothingMade) {
  EXPECT_EQ(repair_run_file(complete_, mended_, false).output, "");
  EXPECT_FALSE(fs::exists(mended_));
}

TEST_F(RunRepairTest, RefusesItsOwnInputAndAnExistingOutput) {
  EXPECT_THROW(repair_run_file(path_, path_, true), Error);
  EXPECT_THROW(repair_run_file(path_, complete_, false), Error);
  EXPECT_THROW(repair_run_file((folder_.path() / "none.h5").string(), mended_, false), Error);
}

}  // namespace
}  // namespace gem
