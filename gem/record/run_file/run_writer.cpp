// The writer thread: takes slabs from a short queue, writes and flushes them, and keeps the first failure.
#include "gem/record/run_file/run_writer.h"

#include <sys/resource.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <future>
#include <mutex>
#include <new>
#include <optional>
#include <system_error>
#include <thread>

#include "gem/base/error.h"
#include "gem/base/fault_stack.h"
#include "gem/base/number_text.h"
#include "gem/record/output/memory_reserve.h"
#include "gem/record/output/output_claim.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_layout.h"
#include "gem_version.h"

namespace gem {

namespace {

constexpr std::size_t queue_limit = 2;         // slabs: one is written while the next is filled
constexpr std::uint64_t spare_room = 1 << 20;  // for the index of the file

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
  std::optional<FilePosition> from;  // null: a new file
};

}  // namespace

std::string build_text() { return "gem " GEM_VERSION " " GEM_COMMIT " " GEM_BUILD_TYPE " " GEM_COMPILER; }

std::string hash_text(std::uint64_t hash) {
  std::string text(16, '0');
  for (std::size_t i = 16; i-- > 0; hash >>= 4) text[i] = "0123456789abcdef"[hash & 15];
  return text;
}

class RunWriter::Thread {
  struct QueuedSlab {
    Slab slab;
    bool flush;
    std::function<void(FilePosition)> then;  // null: nothing
  };

 public:
  Thread(const std::string& path, bool overwrite, Start start)
      : path_(path), claim_(path, overwrite), thread_([this, start = std::move(start)]() mutable {
          begin(std::move(start));
          begun_.set_value();
          work();
        }) {
    // where memory is limited, nothing else may take it while the library builds the file
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) begun_.get_future().wait();
  }

  ~Thread() {
    stop();
    if (layout_ != nullptr) close();
    if (claim_.published() && !any_written_ && !finished_) claim_.remove();
  }

  void put(Slab slab, bool flush, std::function<void(FilePosition)> then = nullptr) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return queue_.size() < queue_limit || failed_; });
    if (failed_) throw failure();
    queue_.push_back({std::move(slab), flush, std::move(then)});
    changed_.notify_all();
  }

  bool has_room() const {
    const std::lock_guard lock(mutex_);
    return queue_.size() < queue_limit || failed_;
  }

  RowCount flush() {
    put({}, true);
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return queue_.empty() || failed_; });
    if (failed_) throw failure();
    return layout_->visible();
  }

  void check() const {
    if (failed_) throw failure();
  }

  void finish(const std::string& status, std::uint64_t state_hash, const RunVerdict& verdict) {
    stop();
    if (layout_ == nullptr) throw failure();
    guarded([&] {
      if (failed_ || !ready_for({})) return;
      layout_->append_rest();
      if (any_appended_) show();
    });
    set_end(status, state_hash, verdict);
    claim_.trim();
    finished_ = !failed_;
    if (!finished_ && !any_written_) claim_.remove();
    if (failed_) throw failure();
  }

 private:
  /// Calls the library. After a failure, which is kept, nothing more is written.
  template <class Action>
  void guarded(Action action, std::size_t memory = MemoryReserve::to_write) {
    const std::lock_guard library(hdf5::library_mutex());
    if (!has_memory(memory)) return;
    prepare_library();
    try {
      action();
    } catch (const hdf5::Failure& fault) {
      broken_ = true;
      out_of_memory_ = out_of_memory_ || hdf5::is_memory(fault.text);
      remember(fault.text);
    } catch (const std::bad_alloc&) {
      broken_ = out_of_memory_ = true;
      remember("out of memory");
    }
  }

  /// Creates the draft and writes what is known at the start. This takes tens of milliseconds, for which the simulation
  /// does not wait.
  void begin(const Start start) {
    guarded(
        [&] {
          if (start.from) copy_to_draft();
          layout_ =
              start.from
                  ? std::make_unique<RunLayout>(claim_.path(), start.scene, start.bodies, start.provenance, *start.from)
                  : std::make_unique<RunLayout>(claim_.path(), start.scene, start.bodies, start.provenance);
          saved_time_ = layout_->saved_time();
        },
        MemoryReserve::to_begin);
  }

  /// The file that goes on stays as it is until the copy, cut and flushed, takes its place.
  void copy_to_draft() {
    std::error_code fault;
    std::filesystem::copy_file(path_, claim_.path(), std::filesystem::copy_options::overwrite_existing, fault);
    if (fault) throw hdf5::Failure{"copy: " + fault.message()};
  }

  void work() {
    const FaultStack stack;
    for (;;) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return !queue_.empty() || stopping_; });
      if (queue_.empty()) return;
      QueuedSlab next = std::move(queue_.front());
      lock.unlock();
      if (!failed_) write(std::move(next));
      lock.lock();
      queue_.pop_front();
      changed_.notify_all();
    }
  }

  void write(QueuedSlab next) {
    guarded([&] {
      if (!ready_for(next.slab)) return;
      any_appended_ = any_appended_ || !next.slab.empty();
      layout_->append(std::move(next.slab));
      if (next.flush) show();
    });
    if (!next.then || failed_) return;
    std::optional<FilePosition> position;
    guarded([&] { position.emplace(layout_->position()); });  // copies the rows that wait
    if (position) next.then(std::move(*position));
  }

  /// Whether the library surely gets the memory that it needs. Else the failure is kept.
  bool has_memory(std::size_t bytes) {
    if (MemoryReserve::has(bytes)) return true;
    reserve_.release();
    out_of_memory_ = true;
    remember("out of memory");
    return false;
  }

  /// Whether the file stands in its place and the slab surely fits. Else the failure is kept and the file stays as it
  /// is, readable.
  bool ready_for(const Slab& slab) {
    if (!has_memory(layout_->room_for(slab) + MemoryReserve::to_write)) return false;
    if (claim_.is_cut()) {
      lost_ = broken_ = true;
      remember("it was truncated during the run");
    } else if (!claim_.in_place()) {
      lost_ = true;
      remember("it was deleted, moved or replaced during the run");
    } else if (!claim_.reserve(layout_->room_for(slab) + spare_room)) {
      if (any_appended_) show();  // there is room for the slabs before
      remember("no room left on the disk");
    }
    return !failed_;
  }

  /// Shows all rows to readers.
  void show() {
    layout_->flush([this] { need(claim_.sync()); });
    if (!claim_.published()) need(claim_.publish());
    any_written_ = true;
    saved_time_ = layout_->saved_time();
  }

  static void need(const std::string& fault) {
    if (!fault.empty()) throw hdf5::Failure{fault};
  }

  /// Writes the attributes of the end, which stand in the file since its start and need no room, and closes the file.
  /// If the library is stuck with what it could not write, they are written past it. Once they are on the disk a close
  /// that fails loses nothing: only the mark that the file is open stays in it, as after a kill.
  void set_end(const std::string& status, std::uint64_t state_hash, const RunVerdict& verdict) {
    reserve_.release();
    const auto end = [&] { return failed_ ? "stopped:" + why_ : status; };
    bool whole = false;
    const auto write_end = [&] {
      layout_->set_end(end(), state_hash, verdict);
      need(claim_.sync());
      whole = true;
    };
    if (claim_.published() && !broken_) guarded(write_end, MemoryReserve::to_end);
    if (close() || whole || lost_ || !claim_.published()) return;
    guarded([&] { set_end_of_broken(claim_.path(), end(), state_hash, verdict); }, MemoryReserve::to_end);
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

  /// Returns whether the library could close the file.
  bool close() {
    const std::lock_guard library(hdf5::library_mutex());
    if (!has_memory(MemoryReserve::to_end)) broken_ = true;
    if (!broken_) prepare_library();
    try {
      if (!broken_) layout_->close();
    } catch (const hdf5::Failure&) {
      broken_ = true;
    }
    if (broken_) layout_->abandon();
    layout_.reset();
    return !broken_;
  }

  Error failure() const {
    const std::string saved = any_written_ ? "saved up to " + number_text(saved_time_) + " s" : "nothing was saved";
    if (out_of_memory_)
      return {ExitCode::resource_limit, "out of memory (while " + shown(path_) + " was written; " + saved +
                                            "); use fewer floes or a machine with more"};
    if (lost_)
      return {ExitCode::file_system,
              "cannot write " + shown(path_) + " (" + why_ + "); leave the file in its place until the run ends"};
    return {ExitCode::file_system,
            "cannot write " + shown(path_) + " (" + why_ + "; " + saved + "); make room and run again"};
  }

  std::string path_;
  OutputClaim claim_;
  MemoryReserve reserve_;
  std::unique_ptr<RunLayout> layout_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<QueuedSlab> queue_;
  std::string why_;
  std::promise<void> begun_;  // the file is laid out, or failed
  std::atomic<bool> failed_ = false;
  std::atomic<double> saved_time_ = 0.0;
  std::atomic<bool> any_written_ = false;
  std::atomic<bool> out_of_memory_ = false;
  std::atomic<bool> lost_ = false;  // the file does not stand in its place
  bool any_appended_ = false;
  bool finished_ = false;
  bool broken_ = false;  // the library could not write, and cannot close the file
  bool stopping_ = false;
  std::thread thread_;  // last member: the thread uses all others
};

RunWriter::RunWriter(const std::string& path, bool overwrite, const SceneDef& scene, const Bodies& bodies,
                     const Provenance& provenance) {
  check_output_path(path, overwrite);
  thread_ = std::make_unique<Thread>(path, overwrite, Start{scene, bodies, provenance, std::nullopt});
}

RunWriter::RunWriter(const std::string& path, FilePosition from, const SceneDef& scene, const Bodies& bodies,
                     const Provenance& provenance) {
  check_output_path(path, true);
  thread_ = std::make_unique<Thread>(path, true, Start{scene, bodies, provenance, std::move(from)});
}

RunWriter::~RunWriter() = default;

void RunWriter::write(Slab slab, bool flush) { thread_->put(std::move(slab), flush); }

void RunWriter::write(Slab slab, std::function<void(FilePosition)> then) {
  thread_->put(std::move(slab), true, std::move(then));
}

bool RunWriter::has_room() const { return thread_->has_room(); }

RowCount RunWriter::flush() { return thread_->flush(); }

void RunWriter::check() const { thread_->check(); }

void RunWriter::finish(const std::string& status, std::uint64_t state_hash, const RunVerdict& verdict) {
  thread_->finish(status, state_hash, verdict);
}

}  // namespace gem
