// Runs the members of a sweep in processes, shows one progress line for all, and prints the results.
#include "gem/command/sweep/sweep_run.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/sweep/folder/sweep_manifest.h"
#include "gem/command/sweep/folder/sweep_row_json.h"
#include "gem/command/sweep/process_pool.h"
#include "gem/command/sweep/sweep_plan.h"
#include "gem/record/output/output_path.h"
#include "gem/record/verdict.h"
#include "gem/run/checkpoint/resume.h"
#include "gem/run/run_signals.h"

namespace gem {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

/// Progress of a sweep.
struct Count {
  std::size_t done = 0, already = 0, running = 0, failed = 0, stopped = 0, elsewhere = 0;
  double time = 0.0;  // simulated by this call [s]
  double left = 0.0;  // remaining [s]
};

class SweepRun {
 public:
  SweepRun(const SweepPlan& plan, RunLog& log)
      : plan_(plan), log_(log), board_(plan.to_do.size()), free_devices_(plan.devices) {}

  void go() {
    const StopSignals signals;
    start_ = Clock::now();
    while (next_ < plan_.batches.size() || pool_.running() > 0) {
      if (StopSignals::received() != 0) {
        board_.stop() = StopSignals::received();
        next_ = plan_.batches.size();
      }
      while (next_ < plan_.batches.size() && pool_.running() < static_cast<std::size_t>(plan_.jobs)) start_next();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      pool_.reap([this](std::size_t place, ProcessEnd end) { ended(place, end); });
      progress();
    }
    signal_ = board_.stop();
  }

  Count count() const {
    Count now;
    now.already = plan_.rows.size() - plan_.to_do.size();
    for (std::size_t i = 0; i < plan_.to_do.size(); ++i) {
      const auto& entry = board_[i];
      const double time = entry.time;
      now.time += time;
      switch (entry.outcome) {
        case Outcome::running:
          ++now.running;
          [[fallthrough]];
        case Outcome::waiting:
          now.left += member(i).scene.run.duration_s - time;
          break;
        case Outcome::done:
          ++now.done;
          break;
        case Outcome::already_done:
          ++now.already;
          break;
        case Outcome::failed:
          ++now.failed;
          break;
        case Outcome::stopped:
          ++now.stopped;
          break;
        case Outcome::elsewhere:
          ++now.elsewhere;
          break;
      }
    }
    return now;
  }

  double wall_time() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  int exit_code() const {
    if (signal_ != 0) return exit_code_of_signal(signal_);
    if (count().failed == 0) return 0;
    return plan_.rows.size() == 1 ? board_[0].exit_code.load() : static_cast<int>(ExitCode::some_failed);
  }

 private:
  const SweepMember& member(std::size_t job) const { return plan_.members[plan_.chosen[plan_.to_do[job]]]; }

  void start_next() {
    const std::size_t place = next_++;
    std::vector<SweepTask> tasks;
    for (const std::size_t job : plan_.batches[place]) tasks.push_back({&member(job), &board_[job]});
    SweepSettings settings = plan_.settings;
    if (!free_devices_.empty()) {
      settings.engine.device = device_of_[place] = free_devices_.back();
      free_devices_.pop_back();
    }
    pool_.start(place, [this, tasks, settings] {
      if (tasks.size() > 1) return run_sweep_batch(tasks, settings, board_.stop());
      run_sweep_member(tasks.front(), settings, board_.stop());
    });
  }

  /// A worker reports how its runs ended. A run of which it says nothing was lost with it.
  void ended(std::size_t place, ProcessEnd end) {
    if (const auto device = device_of_.find(place); device != device_of_.end()) free_devices_.push_back(device->second);
    for (const std::size_t job : plan_.batches[place]) {
      const Outcome outcome = board_[job].outcome;
      if (outcome == Outcome::waiting || outcome == Outcome::running) {
        note_lost(job, end);
      } else if (outcome == Outcome::failed) {
        say_failure(job);
      }
    }
  }

  static std::string lost_by(ProcessEnd end) {
    if (end.signal == 0)
      return "its process ended before the run did (exit code " + std::to_string(end.exit_code) +
             "); please report this";
    return "its process was killed by signal " + std::to_string(end.signal) +
           (end.signal == SIGKILL ? " (by a user, or because memory ran out); use fewer --jobs"
                                  : "; please report this");
  }

  void note_lost(std::size_t job, ProcessEnd end) {
    SweepRow row = row_of(member(job));
    row.status = "failed";
    row.error = lost_by(end);
    row.time_s = board_[job].time;
    board_[job].exit_code = static_cast<int>(ExitCode::resource_limit);
    board_[job].outcome = Outcome::failed;
    update_manifest(plan_.settings.folder, {row});
    log_.message("error", shown(row.name) + ": " + row.error);
  }

  void say_failure(std::size_t job) {
    for (const SweepRow& row : read_manifest(plan_.settings.folder))
      if (row.name == member(job).name) log_.message("error", shown(row.name) + ": " + row.error);
  }

  void progress() {
    const Count now = count();
    const double all = now.time + now.left;
    const bool over = next_ == plan_.batches.size() && pool_.running() == 0;
    const double fraction = over ? 1.0 : all > 0.0 ? std::min(now.time / all, 0.999) : 0.0;
    if (!log_.wants(fraction, 1.0)) return;
    const double wall = wall_time();
    const double rate = wall > 0.0 ? now.time / wall : 0.0;
    const double left = rate > 0.0 ? now.left / rate : 0.0;
    const std::size_t done = now.done + now.already;
    const std::string line = std::to_string(done) + "/" + std::to_string(plan_.rows.size()) + " done, " +
                             std::to_string(now.running) + " running, " + std::to_string(now.failed) + " failed  " +
                             rate_text(rate) + " x real time  " + clock_text(left) + " left";
    const Json object = {{"level", "progress"},    {"runs", plan_.rows.size()}, {"done", done},
                         {"running", now.running}, {"failed", now.failed},      {"time_s", now.time},
                         {"wall_time_s", wall},    {"sim_rate", rate},          {"left_s", left}};
    log_.show(fraction, line, object.dump());
  }

  const SweepPlan& plan_;
  RunLog& log_;
  mutable SweepBoard board_;
  ProcessPool pool_;
  std::size_t next_ = 0;
  std::vector<int> free_devices_;
  std::map<std::size_t, int> device_of_;  // of batches that run or have ended
  int signal_ = 0;
  Clock::time_point start_;
};

/// The state of every chosen run now, from its file.
std::vector<SweepRow> rows_now(const SweepPlan& plan) {
  std::vector<SweepRow> rows = plan.rows;
  for (SweepRow& row : rows) row = look_at_run(plan.settings.folder, row, plan.settings.engine.name);
  return rows;
}

/// Number of done runs with this verdict.
std::size_t with_verdict(const std::vector<SweepRow>& rows, const std::string& verdict) {
  return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [&verdict](const SweepRow& row) {
    return row.status == "done" && row.verdict == verdict;
  }));
}

std::string verdicts_text(const std::vector<SweepRow>& rows) {
  std::string text;
  for (const Grade grade : {Grade::good, Grade::doubtful, Grade::bad, Grade::not_judged})
    if (const std::size_t runs = with_verdict(rows, grade_name(grade)); runs > 0)
      text += (text.empty() ? "  verdict: " : ", ") + std::to_string(runs) + " " + grade_name(grade);
  return text.empty() ? "" : text + "\n";
}

std::string count_text(const Count& all, double wall, const std::vector<SweepRow>& rows) {
  const std::size_t runs = rows.size();
  std::string text =
      std::to_string(runs) + (runs == 1 ? " run: " : " runs: ") + std::to_string(all.done + all.already) + " done";
  if (all.already > 0) text += " (" + std::to_string(all.already) + " before)";
  if (all.failed > 0) text += ", " + std::to_string(all.failed) + " failed";
  if (all.stopped > 0) text += ", " + std::to_string(all.stopped) + " stopped";
  if (all.elsewhere > 0) text += ", " + std::to_string(all.elsewhere) + " in another process";
  return text + "\n  simulated " + number_text(all.time, 10) + " s in " + fixed_text(wall, 2) + " s, " +
         fixed_text(wall > 0.0 ? all.time / wall : 0.0, 1) + " x real time\n" + verdicts_text(rows);
}

std::string count_json(const Count& all, double wall, const std::vector<SweepRow>& rows) {
  const Json object = {{"done", all.done + all.already},
                       {"done_before", all.already},
                       {"failed", all.failed},
                       {"stopped", all.stopped},
                       {"elsewhere", all.elsewhere},
                       {"time_s", all.time},
                       {"wall_time_s", wall},
                       {"good", with_verdict(rows, grade_name(Grade::good))},
                       {"doubtful", with_verdict(rows, grade_name(Grade::doubtful))},
                       {"bad", with_verdict(rows, grade_name(Grade::bad))},
                       {"runs", json_of(rows)}};
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Throws Error(numerical_stop) if a run is bad.
void refuse_bad(const std::vector<SweepRow>& rows, const std::string& folder) {
  const std::size_t bad = with_verdict(rows, grade_name(Grade::bad));
  if (bad == 0) return;
  throw Error(ExitCode::numerical_stop, std::to_string(bad) + " of " + std::to_string(rows.size()) +
                                            (rows.size() == 1 ? " run is" : " runs are") +
                                            " bad (by the verdict); see gem sweep status " + shown(folder) +
                                            ", and gem info of each for the reasons");
}

void make_folder(const std::string& folder) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault)
    throw Error(ExitCode::file_system,
                "cannot make the folder " + shown(folder) + " (" + fault.message() + "); choose another --out");
  check_output_path(folder + "/manifest.json", true);
}

}  // namespace

int run_sweep(const SweepRunChoice& choice) {
  RunLog log({progress_mode(choice.progress), choice.quiet, choice.log_format == "json"});
  const SweepPlan plan = plan_sweep(choice, log);
  if (choice.dry_run) {
    print(choice.json ? plan_json(plan) : plan_text(plan));
    return 0;
  }
  make_folder(choice.folder);
  if (!choice.force) check_resources(plan.need, choice.folder + "/manifest.json");
  std::vector<SweepRow> all;
  for (const SweepMember& member : plan.members) all.push_back(row_of(member));
  const SweepLock share = enter_folder(choice.folder, all);
  for (const SweepRow& row : plan.rows)
    if (row.status == "done") finish_killed_end(run_path(choice.folder, row.name));
  for (const std::size_t i : plan.to_do)
    if (const SweepRow& row = plan.rows[i]; row.status == "stopped" || row.status == "failed")
      log.message("info", shown(row.name) + " is run again, from its last checkpoint if it has one: " + row.error);
  log.message("info", std::to_string(plan.to_do.size()) + " of " + std::to_string(plan.rows.size()) + " runs to do, " +
                          std::to_string(plan.jobs) + (plan.devices.empty() ? " at a time" : " batches at a time") +
                          " with " + std::to_string(plan.settings.engine.threads) + " threads, " +
                          std::to_string(plan.devices.size()) + " GPUs, engine " + choice.engine + ", to " +
                          shown(choice.folder));
  SweepRun run(plan, log);
  run.go();
  settle_manifest(choice.folder);
  const Count came_to = run.count();
  const std::vector<SweepRow> rows = rows_now(plan);
  if (!choice.quiet || choice.json)
    print_about_file(choice.json ? count_json(came_to, run.wall_time(), rows)
                                 : count_text(came_to, run.wall_time(), rows));
  if (run.exit_code() == 0 && choice.strict) refuse_bad(rows, choice.folder);
  return run.exit_code();
}

}  // namespace gem
