// The writer thread: takes slabs from a short queue, writes and flushes them, and keeps the first failure.
#include "gem/record/run_writer.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <new>
#include <thread>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/record/output_path.h"
#include "gem/record/run_layout.h"
#include "gem_version.h"

namespace gem {

namespace {

using Clock = std::chrono::steady_clock;

// A kill during the milliseconds of a flush may damage the index of the file, so flushes are at least this far apart.
// Chosen by hand: a kill loses up to this much wall time more.
constexpr auto flush_pause = std::chrono::seconds(2);
constexpr std::size_t queue_limit = 2;         // slabs: one is written while the next is filled
constexpr std::uint64_t spare_room = 1 << 20;  // for the index of the file and the final status

std::uint64_t bytes(const Slab& slab) {
  return slab.platform.size() * platform_columns().size() * 8 + slab.events.size() * event_columns().size() * 8 +
         slab.stats.size() * (stats_columns().size() + count_columns().size() * OverlapCount::classes) * 8 +
         slab.floes.x.size() * floe_columns().size() * 4;
}

/// Stops the library from closing files at exit, which fails on a full disk. Switches off its error output, which is
/// per thread.
void prepare_library() {
  static const bool once = [] { return H5dont_atexit() >= 0; }();
  static_cast<void>(once);
  hdf5::quiet_errors();
}

/// What the file says about the start of the run. A copy, since the engine moves its bodies meanwhile.
struct Start {
  SceneDef scene;
  Bodies bodies;
  Provenance provenance;
};

}  // namespace

std::string build_text() { return "gem " GEM_VERSION " " GEM_COMMIT " " GEM_BUILD_TYPE " " GEM_COMPILER; }

std::string hash_text(std::uint64_t hash) {
  std::string text(16, '0');
  for (std::size_t i = 16; i-- > 0; hash >>= 4) text[i] = "0123456789abcdef"[hash & 15];
  return text;
}

class RunWriter::Thread {
 public:
  Thread(const std::string& path, bool overwrite, Start start)
      : path_(path), claim_(path, overwrite), thread_([this, start = std::move(start)]() mutable {
          begin(std::move(start));
          work();
        }) {}

  ~Thread() {
    stop();
    if (layout_ == nullptr) return;
    close();
    if (!any_written_ && !finished_) unlink(path_.c_str());
  }

  void put(Slab slab) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return queue_.size() < queue_limit || failed_; });
    if (failed_) throw failure();
    queue_.push_back(std::move(slab));
    changed_.notify_all();
  }

  void check() const {
    if (failed_) throw failure();
  }

  void finish(const std::string& status, std::uint64_t state_hash, const RunVerdict& verdict) {
    stop();
    if (layout_ == nullptr) throw failure();
    guarded([&] {
      if (!layout_->waiting().empty() && !has_room_for({}) && !failed_) remember("no room left on the disk");
      if (!failed_) layout_->append_rest();
      layout_->set_text("gem_state_hash", hash_text(state_hash));
      if (!verdict.judgements.empty()) layout_->set_verdict(verdict);
      layout_->set_text("gem_status", failed_ ? "stopped:" + why_ : status);
      flush();
    });
    close();
    finished_ = !failed_;
    if (!finished_ && !any_written_) unlink(path_.c_str());
    if (failed_) throw failure();
  }

 private:
  /// Calls the library. After a failure, which is kept, nothing more is written.
  template <class Action>
  void guarded(Action action) {
    const std::lock_guard library(hdf5::library_mutex());
    prepare_library();
    try {
      action();
    } catch (const hdf5::Failure& fault) {
      broken_ = true;
      remember(fault.text);
    } catch (const std::bad_alloc&) {
      broken_ = out_of_memory_ = true;
      remember("out of memory");
    }
  }

  /// Creates the file and writes what is known at the start. This takes tens of milliseconds, for which the simulation
  /// does not wait.
  void begin(const Start start) {
    guarded([&] {
      claim_.let_go();
      layout_ = std::make_unique<RunLayout>(path_, start.scene, start.bodies, start.provenance);
    });
    if (layout_ == nullptr && claim_.made()) unlink(path_.c_str());
  }

  void work() {
    for (;;) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return !queue_.empty() || stopping_; });
      if (queue_.empty()) return;
      Slab slab = std::move(queue_.front());
      lock.unlock();
      if (!failed_) write(std::move(slab));
      lock.lock();
      queue_.pop_front();
      changed_.notify_all();
    }
  }

  /// A slab is written only if it surely fits, so that the file stays readable when the disk is full.
  void write(Slab slab) {
    guarded([&] {
      if (!has_room_for(slab)) {
        flush();
        return remember("no room left on the disk");
      }
      unflushed_ += bytes(slab);
      layout_->append(std::move(slab));
      if (Clock::now() - flushed_ >= flush_pause) flush();
    });
  }

  /// Rows that wait or are not flushed need disk space too.
  bool has_room_for(const Slab& slab) const {
    return room_at(path_) >= unflushed_ + bytes(slab) + bytes(layout_->waiting()) + spare_room;
  }

  void flush() {
    layout_->flush();
    flushed_ = Clock::now();
    unflushed_ = 0;
    any_written_ = layout_->any_written();
    saved_time_ = layout_->saved_time();
  }

  void remember(const std::string& why) {
    const std::lock_guard lock(mutex_);
    if (why_.empty()) why_ = why;
    failed_ = true;
    changed_.notify_all();
  }

  void stop() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
      changed_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
  }

  void close() {
    const std::lock_guard library(hdf5::library_mutex());
    prepare_library();
    try {
      if (broken_) {
        layout_->abandon();
      } else {
        layout_->close();
      }
    } catch (const hdf5::Failure& fault) {
      layout_->abandon();
      remember(fault.text);
    }
    layout_.reset();
  }

  Error failure() const {
    const std::string saved = any_written_ ? "saved up to " + number_text(saved_time_) + " s" : "nothing was saved";
    if (out_of_memory_)
      return {ExitCode::resource_limit, "out of memory (while " + shown(path_) + " was written; " + saved +
                                            ") use fewer floes or a machine with more"};
    return {ExitCode::file_system,
            "cannot write " + shown(path_) + " (" + why_ + "; " + saved + ") make room and run again"};
  }

  std::string path_;
  OutputClaim claim_;
  std::unique_ptr<RunLayout> layout_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Slab> queue_;
  std::string why_;
  Clock::time_point flushed_ = Clock::now();
  std::atomic<bool> failed_ = false;
  std::atomic<double> saved_time_ = 0.0;
  std::atomic<bool> any_written_ = false;
  std::uint64_t unflushed_ = 0;
  std::atomic<bool> out_of_memory_ = false;
  bool finished_ = false;
  bool broken_ = false;
  bool stopping_ = false;
  std::thread thread_;  // last member: the thread uses all others
};

RunWriter::RunWriter(const std::string& path, bool overwrite, const SceneDef& scene, const Bodies& bodies,
                     const Provenance& provenance) {
  check_output_path(path, overwrite);
  thread_ = std::make_unique<Thread>(path, overwrite, Start{scene, bodies, provenance});
}

RunWriter::~RunWriter() = default;

void RunWriter::write(Slab slab) { thread_->put(std::move(slab)); }

void RunWriter::check() const { thread_->check(); }

void RunWriter::finish(const std::string& status, std::uint64_t state_hash, const RunVerdict& verdict) {
  thread_->finish(status, state_hash, verdict);
}

}  // namespace gem
