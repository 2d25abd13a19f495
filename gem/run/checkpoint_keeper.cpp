#include "gem/run/checkpoint_keeper.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "gem/run/checkpoint_file.h"

namespace gem {
namespace {

/// Checkpoints take at most 1 / least_pause of the processor time of one thread, however large the field. The time in
/// which the writer's thread waits for the disk holds nobody up.
constexpr double least_pause = 100.0;

/// Wall time from the start to the first checkpoint [s]: until then a killed run begins again. Chosen by hand.
constexpr double first_checkpoint_s = 1.0;

}  // namespace

double thread_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

CheckpointKeeper::CheckpointKeeper(double interval_s)
    : interval_(interval_s), pause_(std::min(interval_s, first_checkpoint_s)) {}

void CheckpointKeeper::begin(std::uint64_t serial) {
  taken_at_ = Clock::now();
  serial_ = serial;
}

bool CheckpointKeeper::is_due() const {
  return on() && on_their_way_ == 0 && std::chrono::duration<double>(Clock::now() - taken_at_).count() >= pause_;
}

void CheckpointKeeper::start(TakenCheckpoint& taken) {
  taken_at_ = Clock::now();
  clock_gettime(CLOCK_REALTIME, &taken.time);
  ++on_their_way_;
}

void CheckpointKeeper::write(const std::string& run_file, TakenCheckpoint& taken) {
  const double begin = thread_seconds();
  taken.state.serial = serial_;
  try {
    write_checkpoint(run_file, taken.state, taken.time);
    ++serial_;
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(told_, true)) fault_ = error.what();
  }
  pause_ = std::max(interval_, least_pause * (taken.cost + thread_seconds() - begin));
  --on_their_way_;
}

std::string CheckpointKeeper::take_fault() {
  const std::lock_guard lock(mutex_);
  return std::exchange(fault_, {});
}

}  // namespace gem
