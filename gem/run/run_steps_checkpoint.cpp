// How a run leaves checkpoints, and goes on from one.
#include <memory>
#include <utility>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/run/run_steps.h"

namespace gem {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

/// The recorder and the watch have looked at the state at t = 0 before; what they saw is replaced. The engine comes
/// first: its books at t = 0 must not be looked at again.
void RunSteps::go_on_from(const Checkpoint& from) {
  if (!recorder_.fits(from.recorder))
    throw Error(ExitCode::file_system, "cannot go on with " + shown(options_.output) +
                                           " (its checkpoint has other columns than its case); run the case anew");
  engine_.restore(from.engine);
  recorder_.restore(from.recorder);
  watch_.restore(from.watch);
  static_cast<RunTotals&>(summary_) = from.totals;
  frame_step_ = from.recorder.now.frame_step;
  case_sha256_ = from.case_sha256;
  writer_.emplace(options_.output, from.position, scene_, engine_.bodies(), provenance_of(scene_, engine_, options_));
}

void RunSteps::checkpoint() {
  if (!checkpoints_.on()) return;
  const double begin = thread_seconds();
  const auto taken = std::make_shared<TakenCheckpoint>();  // shared, since a std::function can be copied
  checkpoints_.start(*taken);
  Slab slab = recorder_.take();  // first: the recorder's state is without the rows that wait in it
  Checkpoint& now = taken->state;
  now.build = build_text();
  now.case_sha256 = case_sha256_;
  now.engine_name = engine_.name();
  now.engine = engine_.save();
  now.floes = options_.floes_of_engine;
  now.recorder = recorder_.state();
  now.watch = watch_.state();
  now.totals = summary_;
  flushed_ = Clock::now();
  ++flushes_;
  now.totals.wall_time = std::chrono::duration<double>(flushed_ - start_).count();
  taken->cost = thread_seconds() - begin;
  writer_->write(std::move(slab), [this, taken](FilePosition position) {
    taken->state.position = std::move(position);
    checkpoints_.write(options_.output, *taken);
  });
}

void RunSteps::tell_fault_of_checkpoints() {
  const std::string fault = checkpoints_.take_fault();
  if (!fault.empty()) log_.message("warning", fault);
}

}  // namespace gem
