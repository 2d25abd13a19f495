// Makes one run of a sweep in its process, from the lock to the row in the manifest.
#include "gem/command/sweep/sweep_worker.h"

#include "gem/command/command.h"
#include "gem/field/field.h"

namespace gem {
namespace {

RunSummary run_member(const SweepMember& member, const SweepSettings& settings, SweepBoard::Entry& entry,
                      const std::atomic<int>& stop) {
  const SceneDef listed = with_floes_of_run_file(member.scene);
  const auto engine = engine_for(listed, make_field(listed), settings.engine);
  RunOptions options = options_of(member, settings, entry, stop);
  if (!engine->method().empty()) options.books = reported_only;
  return run_scene(member.scene, *engine, options);
}

Outcome locked_run(const SweepMember& member, const SweepSettings& settings, SweepBoard::Entry& entry,
                   const std::atomic<int>& stop, SweepRow& row) {
  if (const auto reason = reason_not_to(settings, entry, row)) return *reason;
  say_running(settings, entry, row);
  return outcome_of(run_member(member, settings, entry, stop), row);
}

}  // namespace

void run_sweep_member(const SweepTask& task, const SweepSettings& settings, const std::atomic<int>& stop) {
  SweepRow row = row_of(*task.member);
  Outcome outcome = Outcome::failed;
  try {
    const auto lock = SweepLock::try_run(settings.folder, row.name);
    if (!lock) {
      task.entry->outcome = Outcome::elsewhere;
      return;
    }
    try {
      outcome = locked_run(*task.member, settings, *task.entry, stop, row);
    } catch (...) {
      outcome = failure_now(row, *task.entry);
    }
    update_manifest(settings.folder, {row});
  } catch (...) {
    outcome = failure_now(row, *task.entry);
  }
  task.entry->outcome = outcome;
}

}  // namespace gem
