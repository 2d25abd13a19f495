// Makes one run of a sweep in its process, from the lock to the row in the manifest.
#include "gem/command/sweep/sweep_worker.h"

#include "gem/command/command.h"
#include "gem/command/sweep/folder/sweep_manifest.h"
#include "gem/field/field.h"

namespace gem {
namespace {

RunSummary run_member(const SweepMember& member, const SweepSettings& settings, SweepBoard::Entry& entry,
                      const std::atomic<int>& stop, const SweepRow& row) {
  RunOptions options = options_of(member, settings, entry, stop);
  if (const auto found = resumable_run(settings, row)) {
    const auto engine = engine_for(found->engine_scene, found->from->engine.bodies, settings.engine);
    go_on(options, *found);
    return run_scene(found->scene, *engine, options);
  }
  const SceneDef listed = with_floes_of_run_file(member.scene);
  const auto engine = engine_for(listed, make_field(listed), settings.engine);
  if (!engine->method().empty()) options.books = reported_only;
  if (member.scene.floe.empty()) options.floes_of_engine = listed.floe;
  return run_scene(member.scene, *engine, options);
}

Outcome locked_run(const SweepMember& member, const SweepSettings& settings, SweepBoard::Entry& entry,
                   const std::atomic<int>& stop, SweepRow& row) {
  if (const auto reason = reason_not_to(settings, entry, row)) return *reason;
  note_running(entry, row);
  update_manifest(settings.folder, {row});
  return outcome_of(run_member(member, settings, entry, stop, row), row);
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
