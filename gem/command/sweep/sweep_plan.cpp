// Plans a sweep: which runs remain, how many run at a time, and what they need.
#include "gem/command/sweep/sweep_plan.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <thread>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/command.h"
#include "gem/command/index_list.h"
#include "gem/command/sweep/case_difference.h"
#include "gem/command/sweep/folder/sweep_manifest.h"
#include "gem/command/sweep/folder/sweep_row_json.h"
#include "gem/command/sweep/process_pool.h"
#include "gem/engine/cuda/cuda_engine.h"
#include "gem/record/output/output_path.h"
#include "gem/scene/check_scene.h"

namespace gem {
namespace {

void check_files(const std::vector<SweepMember>& members) {
  std::map<std::string, std::string> owner;
  for (const SweepMember& member : members) {
    const auto [entry, is_new] = owner.insert({run_file_name(member.name), member.name});
    if (!is_new)
      throw Error(ExitCode::usage, "two runs would write one file (" + shown(entry->second) + " and " +
                                       shown(member.name) + " to " + shown(entry->first) + "); change a name");
  }
}

int choose_jobs(const std::string& asked) {
  int jobs = 0;
  const auto [end, fault] = std::from_chars(asked.data(), asked.data() + asked.size(), jobs);
  if (fault != std::errc{} || end != asked.data() + asked.size() || jobs < 1 || jobs > 4096)
    throw Error(ExitCode::usage, "--jobs " + asked + " is not a number of processes (1 to 4096); correct it");
  return jobs;
}

/// Divides the processors: first among processes, which scale best, then among the threads of each process.
void share_processors(const SweepRunChoice& choice, SweepPlan& plan, RunLog& log) {
  const int machine = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const std::size_t at_once = plan.devices.empty() ? plan.batches.size() : plan.devices.size();
  const int to_do = static_cast<int>(std::max<std::size_t>(1, std::min(plan.batches.size(), at_once)));
  int& threads = plan.settings.engine.threads;
  if (!choice.jobs.empty()) plan.jobs = std::min(choose_jobs(choice.jobs), to_do);
  const bool given = !choice.threads.empty() || std::getenv("OMP_NUM_THREADS") != nullptr;
  if (given) {
    std::string message;
    threads = choose_threads(choice.threads, message);
    if (!message.empty()) log.message("warning", message);
  }
  if (choice.jobs.empty()) plan.jobs = open_jobs(to_do, !plan.devices.empty(), machine, given ? threads : 0);
  if (!given) threads = std::max(1, machine / plan.jobs);
}

double sum_of_largest(std::vector<double> all, std::size_t count) {
  std::sort(all.rbegin(), all.rend());
  all.resize(std::min(all.size(), count));
  return std::accumulate(all.begin(), all.end(), 0.0);
}

Estimate need_of(const SweepPlan& plan) {
  std::vector<double> memory, checkpoints;
  Estimate need;
  for (const std::size_t i : plan.to_do) {
    const Estimate one = estimate(plan.members[plan.chosen[i]].scene, plan.settings.checkpoint_interval_s > 0.0);
    need.steps += one.steps;
    need.disk += one.disk - one.checkpoint_disk;
    need.platform_disk += one.platform_disk;
    memory.push_back(one.memory);
    checkpoints.push_back(one.checkpoint_disk);
  }
  std::size_t largest = 1;
  for (const auto& batch : plan.batches) largest = std::max(largest, batch.size());
  const std::size_t at_once = largest * static_cast<std::size_t>(plan.jobs);
  need.memory = sum_of_largest(memory, at_once);
  need.checkpoint_disk = sum_of_largest(checkpoints, at_once);
  need.disk += need.checkpoint_disk;
  return need;
}

void say_warnings(const SweepPlan& plan, RunLog& log) {
  std::map<std::string, std::vector<std::string>> runs;
  for (const std::size_t i : plan.to_do) {
    const SweepMember& member = plan.members[plan.chosen[i]];
    for (const std::string& warning : scene_warnings(member.scene)) runs[warning].push_back(member.name);
  }
  for (const auto& [warning, names] : runs) {
    const std::string more = names.size() > 1 ? " and " + std::to_string(names.size() - 1) + " more" : "";
    log.message("warning", shown(names.front()) + more + ": " + warning);
  }
}

void choose_what_to_do(const SweepRunChoice& choice, SweepPlan& plan) {
  for (std::size_t i = 0; i < plan.rows.size(); ++i) {
    const SweepRow& row = plan.rows[i];
    if (row.status == "other" && !choice.overwrite)
      throw Error(ExitCode::file_system,
                  shown(run_path(choice.folder, row.name)) + " does not belong to this sweep (" + row.error +
                      case_difference(run_path(choice.folder, row.name), plan.members[plan.chosen[i]].scene) +
                      "); use --overwrite or another --out");
    if (row.status != "done" || choice.overwrite) plan.to_do.push_back(i);
  }
}

}  // namespace

namespace {

constexpr int most_devices = 64;

/// Indices of the GPUs that can be used.
std::vector<int> gpus_that_answer() {
  SweepBoard answer(most_devices);
  ProcessPool probe;  // a process that has used a GPU cannot fork others that use one
  probe.start(0, [&answer] {
    std::string reason;
    for (const CudaDevice& device : cuda_devices(reason))
      if (device.fault.empty() && device.index < most_devices) answer[device.index].outcome = Outcome::done;
  });
  while (probe.running() > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    probe.reap([](std::size_t, ProcessEnd) {});
  }
  std::vector<int> devices;
  for (int index = 0; index < most_devices; ++index)
    if (answer[index].outcome == Outcome::done) devices.push_back(index);
  return devices;
}

void group(SweepPlan& plan) {
  const std::string& engine = plan.settings.engine.name;
  const bool all_on_gpu = std::all_of(plan.to_do.begin(), plan.to_do.end(), [&plan](std::size_t place) {
    return has_solver_on_gpu(plan.members[plan.chosen[place]].scene);
  });
  if (engine == "cuda" || (engine == "auto" && all_on_gpu)) plan.devices = gpus_that_answer();
  if (engine == "cuda" && plan.devices.empty())
    throw Error(ExitCode::device, "no GPU answers (`gem devices` says why); use --engine cpu");
  std::vector<std::int64_t> steps;
  for (const std::size_t place : plan.to_do) steps.push_back(steps_of(plan.members[plan.chosen[place]].scene));
  plan.batches = share_runs(steps, plan.devices.size());
}

}  // namespace

int open_jobs(int side_by_side, bool on_gpus, int processors, int threads) {
  if (on_gpus) return side_by_side;
  return std::clamp(processors / std::max(1, threads), 1, side_by_side);
}

std::vector<std::vector<std::size_t>> share_runs(const std::vector<std::int64_t>& steps, std::size_t devices) {
  constexpr std::size_t largest_batch = 66;  // runs; a large GPU cannot hold more side by side
  const std::size_t runs = steps.size();
  std::size_t count = runs;  // without a GPU each run is a batch of its own
  if (devices > 0) count = std::min(runs, std::max(devices, (runs + largest_batch - 1) / largest_batch));
  std::vector<std::size_t> longest_first(runs);
  std::iota(longest_first.begin(), longest_first.end(), std::size_t{0});
  if (devices > 0)
    std::stable_sort(longest_first.begin(), longest_first.end(),
                     [&](std::size_t i, std::size_t j) { return steps[i] > steps[j]; });
  std::vector<std::vector<std::size_t>> batches(count);
  for (std::size_t k = 0; k < runs; ++k) batches[k % count].push_back(longest_first[k]);
  for (auto& batch : batches) std::sort(batch.begin(), batch.end());
  return batches;
}

std::vector<SweepRow> known_rows(const std::string& folder, const std::vector<SweepMember>& members) {
  std::map<std::string, SweepRow> known;
  for (const SweepRow& row : read_manifest(folder)) known[row.name] = row;
  std::vector<SweepRow> rows;
  for (const SweepMember& member : members) {
    SweepRow row = row_of(member);
    const auto found = known.find(member.name);
    const bool same = found != known.end() && found->second.case_sha256 == row.case_sha256;
    rows.push_back(same ? found->second : row);
    rows.back().index = member.index;
    rows.back().draw = member.draw;
  }
  return rows;
}

SweepPlan plan_sweep(const SweepRunChoice& choice, RunLog& log) {
  SweepPlan plan;
  plan.members = read_sweep(choice.path, choice.overrides);
  check_files(plan.members);
  plan.chosen = parse_index_list(choice.index, plan.members.size());
  plan.settings.folder = choice.folder;
  plan.settings.overwrite = choice.overwrite;
  plan.settings.command_line = choice.command_line;
  plan.settings.checkpoint_interval_s = choice.checkpoint_interval_s;
  plan.settings.flush_interval_s = choice.flush_interval_s;
  plan.settings.engine.name = choice.engine;
  const std::vector<SweepRow> known = known_rows(choice.folder, plan.members);
  for (const std::size_t place : plan.chosen)
    plan.rows.push_back(look_at_run(choice.folder, known[place], choice.engine));
  choose_what_to_do(choice, plan);
  group(plan);
  share_processors(choice, plan, log);
  plan.need = need_of(plan);
  say_warnings(plan, log);
  return plan;
}

std::string plan_text(const SweepPlan& plan) {
  std::string text;
  for (std::size_t i = 0; i < plan.rows.size(); ++i) {
    const SweepRow& row = plan.rows[i];
    const bool to_do = std::find(plan.to_do.begin(), plan.to_do.end(), i) != plan.to_do.end();
    text += std::to_string(row.index) + "  " + shown(row.name) + "  " + row.status + (to_do ? ", to do" : "") +
            (row.error.empty() ? "" : " (" + row.error + ")") + "\n";
  }
  return text + "# dry run: nothing was computed\n# to do   " + std::to_string(plan.to_do.size()) + " of " +
         std::to_string(plan.rows.size()) + " runs, " + fixed_text(plan.need.steps, 0) + " time steps\n# at once " +
         std::to_string(plan.jobs) + " processes of " + std::to_string(plan.settings.engine.threads) + " threads, " +
         std::to_string(plan.devices.size()) + " GPUs, engine " + plan.settings.engine.name + "\n# memory  about " +
         size_text(plan.need.memory) + "\n# disk    about " + size_text(plan.need.disk) + " in " +
         shown(plan.settings.folder) + "\n";
}

std::string plan_json(const SweepPlan& plan) {
  const nlohmann::ordered_json object = {
      {"to_do", plan.to_do.size()},          {"jobs", plan.jobs},         {"threads", plan.settings.engine.threads},
      {"engine", plan.settings.engine.name}, {"steps", plan.need.steps},  {"memory_bytes", plan.need.memory},
      {"disk_bytes", plan.need.disk},        {"runs", json_of(plan.rows)}};
  return object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace gem
