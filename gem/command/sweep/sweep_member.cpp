// Rows, run options and outcomes of the members of a sweep.
#include "gem/command/sweep/sweep_member.h"

#include <new>

#include "gem/analysis/verdict/verdict_words.h"
#include "gem/record/run_file/run_writer.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {

SweepRow row_of(const SweepMember& member) {
  SweepRow row;
  row.index = member.index;
  row.name = member.name;
  row.case_sha256 = scene_hash(member.scene);
  row.duration_s = member.scene.run.duration_s;
  row.draw = member.draw;
  return row;
}

RunOptions options_of(const SweepMember& member, const SweepSettings& settings, SweepBoard::Entry& entry,
                      const std::atomic<int>& stop) {
  RunOptions options;
  options.output = run_path(settings.folder, member.name);
  options.overwrite = true;
  options.log.progress = ProgressMode::none;
  options.command_line = settings.command_line;
  options.threads = settings.engine.threads;
  options.checkpoint_interval_s = settings.checkpoint_interval_s;
  options.flush_interval_s = settings.flush_interval_s;
  options.stop = &stop;
  options.on_block = [&entry](double time) { entry.time = time; };
  return options;
}

Outcome outcome_of(const RunSummary& summary, SweepRow& row) {
  row.state_hash = hash_text(summary.state_hash);
  row.engine = summary.engine;
  row.time_s = summary.time;
  row.wall_time_s = summary.wall_time;
  row.verdict = grade_name(summary.verdict.grade);
  row.doubts = doubts_of(summary.verdict);
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

/// Whether the holder of the run's lock must make the run. If not, `row` and the outcome say why.
std::optional<Outcome> reason_not_to(const SweepSettings& settings, SweepBoard::Entry& entry, SweepRow& row) {
  const SweepRow found = look_at_file(settings.folder, row, settings.engine.name);
  if (found.status == "done" && !settings.overwrite) {
    row = found;
    return Outcome::already_done;
  }
  if (found.status == "other" && !settings.overwrite)
    return failure(row, entry, found.error + "; use --overwrite or another --out", ExitCode::file_system);
  return std::nullopt;
}

/// A run whose checkpoint cannot be used begins again: a sweep does not stop for it.
std::optional<Resumable> resumable_run(const SweepSettings& settings, const SweepRow& row) {
  if (settings.overwrite || look_at_file(settings.folder, row, settings.engine.name).status == "other")
    return std::nullopt;
  try {
    Resumable run = resumable(run_path(settings.folder, row.name));
    if ((run.from->engine_name == "reference") != (settings.engine.name == "reference")) return std::nullopt;
    return run;
  } catch (const Error&) {
    return std::nullopt;
  }
}

void note_running(SweepBoard::Entry& entry, SweepRow& row) {
  entry.outcome = Outcome::running;
  row.status = "running";
}

Outcome failure_now(SweepRow& row, SweepBoard::Entry& entry) {
  try {
    throw;
  } catch (const Error& fault) {
    return failure(row, entry, fault.what(), fault.code());
  } catch (const std::bad_alloc&) {
    return failure(row, entry, "out of memory (an allocation failed); use fewer --jobs", ExitCode::resource_limit);
  } catch (const std::exception& fault) {
    return failure(row, entry, std::string("unexpected (") + fault.what() + "); please report this",
                   ExitCode::resource_limit);
  }
}

}  // namespace gem
