#include "gem/run/checkpoint/resume.h"

#include <optional>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/killed_end.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/run/checkpoint/checkpoint_file.h"

namespace gem {
namespace {

[[noreturn]] void refuse(const std::string& run_file, const std::string& why) {
  throw Error(ExitCode::file_system, "cannot go on with " + shown(run_file) + " (" + why +
                                         "); run the case again; `gem info FILE --case` prints it");
}

/// Rows of a column; 0 if the file has no such column.
std::size_t rows_of(const RunFile& file, const char* dataset) {
  return file.has(dataset) ? file.shape(dataset).at(0) : 0;
}

/// Why the file does not fit to a checkpoint; empty if it does.
std::string misfit(const RunFile& file, const Checkpoint& c) {
  if (file.attribute("gem_case_sha256") != c.case_sha256) return "its checkpoint belongs to another case";
  const struct {
    const char* dataset;
    std::uint64_t needed;
  } columns[] = {{"platform/time", c.position.platform}, {"events/time", c.position.events},
                 {"stats/time", c.position.stats},       {"floes/time", c.position.frames},
                 {"contacts/time", c.position.contacts},  // only some runs have this and the next one
                 {"splits/time", c.position.splits}};
  for (const auto& [dataset, needed] : columns)
    if (const std::size_t rows = needed > 0 ? rows_of(file, dataset) : 0; rows < needed)
      return std::string("its checkpoint is newer than its rows: ") + dataset + " has " + std::to_string(rows) +
             ", the checkpoint counts on " + std::to_string(needed);
  return "";
}

}  // namespace

Resumable resumable(const std::string& run_file) {
  std::optional<RunFile> file(std::in_place, run_file, true);
  if (file->status() == "complete") {
    file.reset();  // it holds a lock
    finish_killed_end(run_file);
    refuse(run_file, "it is complete");
  }
  const SceneDef scene = stored_scene(*file);
  FoundCheckpoints found = find_checkpoints(run_file);
  if (found.whole.empty() && found.faults.empty())
    refuse(run_file, "there is no checkpoint beside it: the run ended before its first one, or kept none");
  std::string why = found.faults;
  for (Checkpoint& one : found.whole) {
    const std::string fault = misfit(*file, one);
    if (!fault.empty()) {
      why += (why.empty() ? "" : "; ") + fault;
      continue;
    }
    Resumable run;
    run.scene = run.engine_scene = scene;
    if (!one.floes.empty()) run.engine_scene.floe = one.floes;
    if (!why.empty()) run.note = "an older checkpoint is used (" + why + ")";
    if (one.build != build_text())
      run.note += (run.note.empty() ? "" : "; ") +
                  ("the checkpoint was written by " + one.build + ", so the bits may differ from those of one program");
    run.from = std::make_shared<const Checkpoint>(std::move(one));
    return run;
  }
  refuse(run_file, why);
}

void finish_killed_end(const std::string& run_file) {
  if (close_killed_end(run_file)) remove_checkpoints(run_file);
}

void go_on(RunOptions& options, const Resumable& run) {
  options.from = run.from;
  options.floes_of_engine = run.from->floes;
}

}  // namespace gem
