// How a run leaves checkpoints, and goes on from one.
#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/run/checkpoint_file.h"
#include "gem/run/run_steps.h"

namespace gem {
namespace {

using Clock = std::chrono::steady_clock;

/// Checkpoints take at most 1 / least_pause of the wall time, however large the field and slow the disk.
constexpr double least_pause = 100.0;

}  // namespace

/// The recorder and the watch have looked at the state at t = 0 before; what they saw is replaced. The engine comes
/// first: its books at t = 0 must not be looked at again.
void RunSteps::go_on_from(const Checkpoint& from) {
  if (!recorder_.fits(from.recorder))
    throw Error(ExitCode::file_system, "cannot go on with " + shown(options_.output) +
                                           " (its checkpoint has other columns than its case) run the case anew");
  engine_.restore(from.engine);
  recorder_.restore(from.recorder);
  watch_.restore(from.watch);
  static_cast<RunTotals&>(summary_) = from.totals;
  frame_step_ = from.recorder.now.frame_step;
  next_checkpoint_ = from.serial + 1;
  case_sha256_ = from.case_sha256;
  writer_.emplace(options_.output, from.position, scene_, engine_.bodies(), provenance_of(scene_, engine_, options_));
}

void RunSteps::checkpoint() {
  const auto begin = checkpointed_ = Clock::now();
  if (!keeps_checkpoints_) return;
  hand_over(false);
  Checkpoint now;
  now.position = writer_->settle();
  now.serial = next_checkpoint_;
  now.build = build_text();
  now.case_sha256 = case_sha256_;
  now.engine_name = engine_.name();
  now.engine = engine_.save();
  now.floes = options_.floes_of_engine;
  now.recorder = recorder_.state();
  now.watch = watch_.state();
  now.totals = summary_;
  now.totals.wall_time = std::chrono::duration<double>(begin - start_).count();
  try {
    write_checkpoint(options_.output, now);
    ++next_checkpoint_;
  } catch (const Error& error) {
    if (!said_no_checkpoint_) log_.message("warning", error.what());
    said_no_checkpoint_ = true;
  }
  checkpointed_ = Clock::now();
  const double cost = std::chrono::duration<double>(checkpointed_ - begin).count();
  checkpoint_pause_ = std::max(options_.checkpoint_interval_s, least_pause * cost);
}

}  // namespace gem
