// One run of a sweep, from its lock to its row in the manifest.
#include "gem/command/sweep_worker.h"

#include <sys/mman.h>

#include <new>

#include "gem/base/error.h"
#include "gem/command/command.h"
#include "gem/record/run_writer.h"
#include "gem/run_scene.h"
#include "gem/scene/scene_file.h"

namespace gem {
namespace {

static_assert(std::atomic<double>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "the board is shared by processes");

RunSummary run_member(const SweepMember& member, const SweepSettings& settings, SweepBoard::Entry& entry,
                      const std::atomic<int>& stop) {
  const Bodies field = field_of(member.scene);
  const auto engine = engine_for(member.scene, field, settings.engine);
  RunOptions options;
  options.output = run_path(settings.folder, member.name);
  options.overwrite = true;
  options.log.progress = ProgressMode::none;
  options.command_line = settings.command_line;
  options.threads = settings.engine.threads;
  options.stop = &stop;
  options.on_block = [&entry](double time) { entry.time = time; };
  if (!engine->method().empty()) options.books = reported_only;
  return run_scene(member.scene, *engine, options);
}

Outcome outcome_of(const RunSummary& summary, SweepRow& row) {
  row.state_hash = hash_text(summary.state_hash);
  row.engine = summary.engine;
  row.time_s = summary.time;
  row.wall_time_s = summary.wall_time;
  const bool complete = summary.status == "complete";
  row.status = complete ? "done" : "stopped";
  row.error = complete ? "" : summary.status;
  return complete ? Outcome::done : Outcome::stopped;
}

Outcome failure(SweepRow& row, SweepBoard::Entry& entry, const std::string& why, ExitCode code) {
  row.status = "failed";
  row.error = why;
  row.time_s = entry.time;
  entry.exit_code = static_cast<int>(code);
  return Outcome::failed;
}

Outcome locked_run(const SweepMember& member, const SweepSettings& settings, SweepBoard::Entry& entry,
                   const std::atomic<int>& stop, SweepRow& row) {
  const SweepRow found = look_at_file(settings.folder, row, settings.engine.name);
  if (found.status == "done" && !settings.overwrite) {
    row = found;
    return Outcome::already_done;
  }
  if (found.status == "other" && !settings.overwrite)
    return failure(row, entry, found.error + "; use --overwrite or another --out", ExitCode::file_system);
  entry.outcome = Outcome::running;
  row.status = "running";
  update_manifest(settings.folder, {row});
  return outcome_of(run_member(member, settings, entry, stop), row);
}

}  // namespace

SweepBoard::SweepBoard(std::size_t runs) : bytes_(sizeof(Entry) * (runs + 1)) {
  void* memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  stop_ = new (memory) std::atomic<int>(0);
  entries_ = static_cast<Entry*>(memory) + 1;
  for (std::size_t i = 0; i < runs; ++i) new (entries_ + i) Entry{0.0, Outcome::waiting, 0};
}

SweepBoard::~SweepBoard() { munmap(stop_, bytes_); }

SweepRow row_of(const SweepMember& member) {
  SweepRow row;
  row.index = member.index;
  row.name = member.name;
  row.case_sha256 = scene_hash(member.scene);
  row.duration_s = member.scene.run.duration_s;
  return row;
}

void run_sweep_member(const SweepMember& member, const SweepSettings& settings, SweepBoard::Entry& entry,
                      const std::atomic<int>& stop) {
  SweepRow row = row_of(member);
  Outcome outcome = Outcome::failed;
  try {
    const auto lock = SweepLock::try_run(settings.folder, member.name);
    if (!lock) {
      entry.outcome = Outcome::elsewhere;
      return;
    }
    try {
      outcome = locked_run(member, settings, entry, stop, row);
    } catch (const Error& fault) {
      outcome = failure(row, entry, fault.what(), fault.code());
    } catch (const std::bad_alloc&) {
      outcome = failure(row, entry, "out of memory (an allocation failed) use fewer --jobs", ExitCode::resource_limit);
    } catch (const std::exception& fault) {
      outcome = failure(row, entry, std::string("unexpected (") + fault.what() + ") please report this",
                        ExitCode::resource_limit);
    }
    update_manifest(settings.folder, {row});
  } catch (const Error& fault) {
    outcome = failure(row, entry, fault.what(), fault.code());
  }
  entry.outcome = outcome;
}

}  // namespace gem
