#include "gem/run/checkpoint/checkpoint_keeper.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "gem/run/checkpoint/checkpoint_file.h"

namespace gem {
namespace {

/// All checkpoints of a run together take at most this share of its wall time as processor time of one thread, however
/// large the field, and `head_start_s` more: the first ones touch new memory and cost several times as much. The time
/// in which the writer's thread waits for the disk holds nobody up.
constexpr double largest_share = 0.01;
constexpr double head_start_s = 0.1;

/// Wall time from the start to the first checkpoint [s]: until then a killed run begins again. Chosen by hand.
constexpr double first_checkpoint_s = 1.0;

double seconds(std::chrono::steady_clock::duration time) { return std::chrono::duration<double>(time).count(); }

}  // namespace

double thread_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

CheckpointKeeper::CheckpointKeeper(double interval_s)
    : interval_(interval_s), pause_(std::min(interval_s, first_checkpoint_s)) {}

void CheckpointKeeper::begin(std::uint64_t serial) {
  begun_at_ = taken_at_ = Clock::now();
  serial_ = serial;
}

bool CheckpointKeeper::is_due() const {
  if (!on() || on_their_way_ > 0) return false;
  const Clock::time_point now = Clock::now();
  return seconds(now - taken_at_) >= pause_ && spent_ <= largest_share * seconds(now - begun_at_) + head_start_s;
}

void CheckpointKeeper::start(TakenCheckpoint& taken) {
  taken_at_ = Clock::now();
  pause_ = interval_;
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
  spent_ = spent_ + taken.cost + thread_seconds() - begin;
  --on_their_way_;
}

std::string CheckpointKeeper::take_fault() {
  const std::lock_guard lock(mutex_);
  return std::exchange(fault_, {});
}

}  // namespace gem
