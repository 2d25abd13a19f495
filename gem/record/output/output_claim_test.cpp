// Who may claim an output file while others hold it.
#include "gem/record/output/output_claim.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"

namespace gem {
namespace {

/// Holds a file as a reader does.
class Reader {
 public:
  explicit Reader(const std::string& path) : file_(open(path.c_str(), O_RDONLY)) { flock(file_, LOCK_SH | LOCK_NB); }
  ~Reader() { close(file_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

 private:
  int file_;
};

TEST(OutputClaim, WaitsForAReaderOfMoments) {
  const ScratchFolder folder;
  const std::string path = (folder.path() / "run.h5").string();
  std::ofstream(path) << "a run";
  auto reader = std::make_unique<Reader>(path);
  EXPECT_TRUE(is_claimed(path));
  std::thread end([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    reader.reset();
  });
  EXPECT_NO_THROW(OutputClaim(path, true));
  end.join();
  EXPECT_FALSE(is_claimed(path));
}

TEST(OutputClaim, GivesUpWhereAReaderStays) {
  const ScratchFolder folder;
  const std::string path = (folder.path() / "run.h5").string();
  std::ofstream(path) << "a run";
  const Reader reader(path);
  EXPECT_THROW(OutputClaim(path, true), Error);
  EXPECT_THROW(check_unclaimed(path), Error);
}

TEST(OutputClaim, DoesNotWaitForTheWriterOfAPipe) {
  const ScratchFolder folder;
  const std::string path = (folder.path() / "pipe").string();
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_FALSE(is_claimed(path));
}

}  // namespace
}  // namespace gem
