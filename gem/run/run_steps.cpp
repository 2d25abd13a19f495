// Blocks of time steps up to the next frame or flush, and the end of a run.
#include "gem/run/run_steps.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>

#include "gem/analysis/verdict/judge_run.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/field/floe_reserve.h"
#include "gem/record/run_file/run_file.h"
#include "gem/run/checkpoint/checkpoint_file.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {

namespace {

using Clock = std::chrono::steady_clock;

/// Floe frames, and other rows, per slab. Chosen by hand: bounds the memory of the rows that wait.
constexpr std::size_t slab_frames = 64, slab_rows = 65536;

/// Slabs of rows that wait at most for a disk that is slow; then the run waits. Chosen by hand.
constexpr std::size_t most_slabs = 2;

/// Wall time from the start to the first flush [s], so that a run can be watched soon. Chosen by hand.
constexpr double first_flush_s = 1.0;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * double(usage.ru_maxrss);
}

void check_book(const char* what, double residual, double limit, double time) {
  if (residual <= limit) return;
  throw Error(ExitCode::numerical_stop, std::string("the ") + what + " books do not close at " + number_text(time) +
                                            " s (residual " + number_text(residual, 3) + ", limit " +
                                            number_text(limit) + "); choose a smaller numerics.time_step_s");
}

/// Wall time between two checkpoints [s]; 0: none.
double checkpoint_interval(const RunOptions& options, const Engine& engine) {
  return options.output.empty() || !engine.method().empty() ? 0.0 : options.checkpoint_interval_s;
}

/// Does what can still be done after a failure.
template <class Action>
void attempt(Action action) {
  try {
    action();
  } catch (const std::exception&) {
  }
}

}  // namespace

Provenance provenance_of(const SceneDef& scene, const Engine& engine, const RunOptions& options) {
  const std::string solver = solver_name(scene.contact.solver);
  return {scene.run.name,    resolved_toml(scene),
          scene_hash(scene), options.command_line,
          engine.name(),     engine.method().empty() ? solver : engine.method(),
          options.threads,   engine.method().empty() ? "strict" : "its own",
          engine.device()};
}

RunSteps::RunSteps(const SceneDef& scene, Engine& engine, const RunOptions& options)
    : scene_(scene),
      engine_(engine),
      options_(options),
      log_(options.log),
      recorder_(scene, engine),
      watch_(scene, engine),
      checkpoints_(checkpoint_interval(options, engine)) {
  if (scene.output.contact_forces && !engine.has_contact_forces())
    throw Error(ExitCode::usage, "the engine " + engine.name() +
                                     " cannot record output.contact_forces (it keeps the forces between bodies to "
                                     "itself); use --engine cpu, or leave the key out");
  case_steps_ = last_step_ = steps_of(scene);
  if (options.step_limit > 0) last_step_ = std::min(last_step_, options.step_limit);
  summary_.frames = 1;
  summary_.file = options.output;
  summary_.engine = engine.name();
  summary_.residual = residual(engine.ledger());
  if (options.from) {
    go_on_from(*options.from);
  } else if (!options.output.empty()) {
    begin_file();
  }
}

void RunSteps::begin_file() {
  const Provenance provenance = provenance_of(scene_, engine_, options_);
  case_sha256_ = provenance.case_sha256;
  writer_.emplace(options_.output, options_.overwrite, scene_, engine_.bodies(), provenance);
  remove_checkpoints(options_.output);
}

void RunSteps::begin() {
  flushed_ = Clock::now();
  checkpoints_.begin(options_.from ? options_.from->serial + 1 : 0);
  start_ = flushed_ - std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(summary_.wall_time));
}

std::int64_t RunSteps::steps_ahead(std::int64_t most) const {
  const std::int64_t now = engine_.step();
  return std::min({now + most, recorder_.next_frame(), last_step_}) - now;
}

void RunSteps::prepare(StepLog& log) const {
  log.clear();
  log.wants_events = scene_.output.platform_events || scene_.output.side_loads;
}

void RunSteps::last_rows() {
  if (engine_.step() < case_steps_) checkpoint();
  if (engine_.step() >= last_step_) recorder_.sample_rest();
  if (engine_.step() > frame_step_) frame();
}

void RunSteps::take(const StepLog& log) {
  recorder_.add(log, case_steps_);
  recorder_.keep_pieces(log, engine_.bodies());
  say_no_room(log);
  watch_.add(log);
  const bool coupled = scene_.contact.solver == ContactSolver::coupled;
  for (const StepQuality& quality : log.quality) {
    summary_.worst.worsen(quality);
    // gradient iterations may meet the tolerance after the last round of splitting
    const bool met = quality.residual <= watch_.asked_residual();
    summary_.at_limit += coupled && !met && quality.iterations >= scene_.numerics.iterations_maximum;
  }
  summary_.overlap += log.overlap;
  summary_.overlap_share += log.overlap_share;
  if (engine_.step() == recorder_.next_frame() || engine_.step() == case_steps_) frame();
  const bool free = !writer_ || writer_->has_room();  // else a slow disk has not yet taken what waits
  if (free && checkpoints_.is_due()) checkpoint();
  tell_fault_of_checkpoints();
  const double pause = flushes_ > 0 ? options_.flush_interval_s : std::min(options_.flush_interval_s, first_flush_s);
  const bool due = seconds_since(flushed_) >= pause;
  const std::size_t slabs = std::max(recorder_.frames_waiting() / slab_frames, recorder_.rows_waiting() / slab_rows);
  if ((free && (due || slabs >= 1)) || slabs >= most_slabs) hand_over(due);
  if (writer_) writer_->check();
  if (options_.on_block) options_.on_block(time());
  progress(log);
}

void RunSteps::say_no_room(const StepLog& log) {
  if (said_no_room_ || log.splits.empty()) return;
  const Bodies& b = engine_.bodies();
  const bool rows_left = first_unborn(b) + 2 <= b.count();
  const bool refused = std::any_of(log.splits.begin(), log.splits.end(), [](const SplitEvent& one) {
    return one.split.result == FloeSplit::Result::no_room;
  });
  if (rows_left && !refused) return;
  const std::string what = rows_left ? "the corners are used up of" : "the last is made of";
  log_.message("warning", what + " breakup.maximum_pieces = " + std::to_string(scene_.breakup.maximum_pieces) +
                              " pieces at " + number_text(log.splits.back().time) +
                              " s: floes stay whole from now on; raise the key");
  said_no_room_ = true;
}

void RunSteps::frame() {
  const StatsRow row = recorder_.add_frame(engine_, seconds_since(start_));
  watch_.look_at(engine_.bodies(), row);
  frame_step_ = engine_.step();
  ++summary_.frames;
  summary_.contact = row.ledger.contact;
  LedgerResidual& worst = summary_.residual;
  worst.momentum = std::max(worst.momentum, row.residual.momentum);
  worst.angular_momentum = std::max(worst.angular_momentum, row.residual.angular_momentum);
  worst.energy = std::max(worst.energy, row.residual.energy);
  // equal terms in every time step, as for a floe at rest, may all be rounded in the same direction
  const double rounded = 0x1p-53 * double(engine_.step());
  check_book("momentum", row.residual.momentum, std::max(rounded, options_.books.momentum), row.time);
  check_book("angular momentum", row.residual.angular_momentum, std::max(rounded, options_.books.angular_momentum),
             row.time);
  check_book("energy", row.residual.energy, options_.books.energy, row.time);
}

void RunSteps::hand_over(bool flush) {
  Slab slab = recorder_.take();
  if (writer_ && (flush || !slab.empty())) writer_->write(std::move(slab), flush);
  if (!flush) return;
  flushed_ = Clock::now();
  ++flushes_;
}

void RunSteps::progress(const StepLog& log) {
  const double end =
      last_step_ < case_steps_ ? double(last_step_) * scene_.numerics.time_step_s : scene_.run.duration_s;
  if (!log_.wants(time(), end)) return;
  const int contacts = log.quality.empty() ? 0 : log.quality.back().contacts;
  log_.show({time(), end, seconds_since(start_), contacts, summary_.residual.energy});
}

RunSummary RunSteps::finish(int stop_signal) {
  summary_.stop_signal = stop_signal;
  summary_.status = summary_.stop_signal == SIGINT    ? "stopped:SIGINT"
                    : summary_.stop_signal == SIGTERM ? "stopped:SIGTERM"
                    : summary_.stop_signal == SIGHUP  ? "stopped:SIGHUP"
                    : engine_.step() < case_steps_    ? until_status
                                                      : "complete";
  summary_.state_hash = engine_.state_hash();
  summary_.compliant = is_compliant(scene_);
  summary_.asked_residual = watch_.asked_residual();
  summary_.verdict = judge_run(watch_.measures());
  recorder_.end_hits();
  hand_over(false);
  if (writer_) writer_->finish(summary_.status, summary_.state_hash, summary_.verdict);
  tell_fault_of_checkpoints();
  if (writer_ && engine_.step() >= case_steps_) remove_checkpoints(options_.output);
  summary_.time = time();
  summary_.wall_time = seconds_since(start_);
  summary_.sim_rate = summary_.wall_time > 0.0 ? summary_.time / summary_.wall_time : 0.0;
  summary_.steps = engine_.step();
  summary_.loaded_steps = watch_.measures().loaded_steps;
  summary_.events = recorder_.hits_seen();
  summary_.line_break_times = recorder_.line_break_times();
  const Bodies& b = engine_.bodies();
  summary_.active_floes = double(std::count(b.active.begin() + std::ptrdiff_t(first_floe(b)), b.active.end(), 1));
  summary_.peak_memory = peak_memory();
  return summary_;
}

void RunSteps::fail(const std::exception& error) {
  if (!writer_) return;
  const auto* fault = dynamic_cast<const Error*>(&error);
  const bool numerical = fault && fault->code() == ExitCode::numerical_stop;
  const RunMeasures measures = watch_.measures();
  const RunVerdict verdict = numerical ? judge_stopped_run(measures, error.what()) : judge_run(measures);
  const std::string reason = numerical ? "numerical" : "failure";
  // The first error is the one to report. A writer that takes no more rows still writes the status.
  attempt([&] {
    recorder_.end_hits();
    hand_over(false);
  });
  attempt([&] { writer_->finish("stopped:" + reason + ": " + error.what(), engine_.state_hash(), verdict); });
}

std::int64_t steps_of(const SceneDef& scene) { return std::llround(scene.run.duration_s / scene.numerics.time_step_s); }

}  // namespace gem
