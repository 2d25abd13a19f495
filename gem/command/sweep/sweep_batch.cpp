// Runs several members of a sweep in one process, as batches on a GPU.
#include <algorithm>
#include <atomic>
#include <exception>

#include "gem/command/command.h"
#include "gem/command/sweep/folder/sweep_manifest.h"
#include "gem/command/sweep/sweep_worker.h"
#include "gem/engine/cpu/thread_team.h"
#include "gem/field/field.h"
#include "gem/run/run_batch.h"

namespace gem {
namespace {

/// A run and its lock, which is released when the run's row is written. `listed` is the scene with explicit floes;
/// field and engine are made from it.
struct Held {
  SweepTask task;
  SweepRow row;
  SweepLock lock;
  SceneDef listed = {};
  Bodies field = {};
  std::optional<Resumable> found = {};  // a checkpoint to go on from
};

using Group = std::vector<Held>;

class SweepBatch {
 public:
  SweepBatch(const SweepSettings& settings, const std::atomic<int>& stop) : settings_(settings), stop_(stop) {}

  /// Locks the runs that are to be made, and makes their fields.
  Group hold(const std::vector<SweepTask>& tasks) {
    Group group;
    for (const SweepTask& task : tasks) {
      auto lock = SweepLock::try_run(settings_.folder, task.member->name);
      if (!lock) {
        task.entry->outcome = Outcome::elsewhere;
        continue;
      }
      Held held{task, row_of(*task.member), std::move(*lock)};
      try {
        if (const auto reason = reason_not_to(settings_, *task.entry, held.row)) {
          end(held, *reason);
          continue;
        }
        held.found = resumable_run(settings_, held.row);
        held.listed = held.found ? held.found->engine_scene : with_floes_of_run_file(task.member->scene);
        group.push_back(std::move(held));
      } catch (...) {
        end(held, failure_now(held.row, *task.entry));
      }
    }
    return with_fields(std::move(group));
  }

  void run(Group group) {
    if (group.empty()) return;
    std::unique_ptr<EngineBatch> batch;
    try {
      batch = make_engine_batch(scenes_of(group), gpu());
    } catch (const Error& error) {
      return run_otherwise(std::move(group), error);
    }
    std::vector<SceneDef> scenes;
    std::vector<RunOptions> options;
    std::vector<SweepRow> rows;
    for (Held& held : group) {
      note_running(*held.task.entry, held.row);
      rows.push_back(held.row);
      scenes.push_back(held.task.member->scene);
      options.push_back(options_of(*held.task.member, settings_, *held.task.entry, stop_));
      if (held.found)
        go_on(options.back(), *held.found);
      else if (scenes.back().floe.empty())
        options.back().floes_of_engine = held.listed.floe;
    }
    // One lock and one write for the whole batch.
    update_manifest(settings_.folder, rows);
    constexpr int useful_recorders = 16;
    const std::vector<BatchEnd> ends =
        run_batch(scenes, *batch, options, std::min(settings_.engine.threads, useful_recorders));
    std::vector<Outcome> outcomes;
    for (std::size_t k = 0; k < group.size(); ++k) {
      Held& held = group[k];
      outcomes.push_back(ends[k].fault.empty() ? outcome_of(ends[k].summary, held.row)
                                               : failure(held.row, *held.task.entry, ends[k].fault, ends[k].code));
      rows[k] = held.row;
    }
    update_manifest(settings_.folder, rows);
    for (std::size_t k = 0; k < group.size(); ++k) group[k].task.entry->outcome = outcomes[k];
  }

 private:
  /// Makes the fields, several at a time. A run whose field cannot be made has failed.
  Group with_fields(Group group) {
    std::vector<std::exception_ptr> faults(group.size());
    std::atomic<std::size_t> next = 0;
    const auto make = [&](int) {
      for (std::size_t k = next++; k < group.size(); k = next++) {
        try {
          const Held& held = group[k];
          group[k].field = held.found ? held.found->from->engine.bodies : make_field(held.listed);
        } catch (...) {
          faults[k] = std::current_exception();
        }
      }
    };
    try {
      ThreadTeam(std::clamp(settings_.engine.threads, 1, std::max(1, static_cast<int>(group.size())))).run(make);
    } catch (const Error&) {  // the system gives no more threads
      make(0);
    }
    Group made;
    for (std::size_t k = 0; k < group.size(); ++k) {
      if (faults[k])
        end(group[k], failure_of(faults[k], group[k]));
      else
        made.push_back(std::move(group[k]));
    }
    return made;
  }

  static Outcome failure_of(const std::exception_ptr& fault, Held& held) {
    try {
      std::rethrow_exception(fault);
    } catch (...) {
      return failure_now(held.row, *held.task.entry);
    }
  }

  EngineOptions gpu() const {
    EngineOptions options = settings_.engine;
    options.name = "cuda";
    return options;
  }

  static std::vector<BatchScene> scenes_of(const Group& group) {
    std::vector<BatchScene> scenes;
    for (const Held& held : group) scenes.push_back({held.listed, held.field});
    return scenes;
  }

  void end(Held& held, Outcome outcome) {
    update_manifest(settings_.folder, {held.row});
    held.task.entry->outcome = outcome;
  }

  /// If the memory is too small, each half of the runs is tried. Otherwise each run is made by itself if the engine is
  /// auto, and fails with `error` if not.
  void run_otherwise(Group group, const Error& error) {
    if (error.code() == ExitCode::resource_limit && group.size() > 1) {
      const auto middle = group.begin() + static_cast<std::ptrdiff_t>(group.size() / 2);
      Group second(std::make_move_iterator(middle), std::make_move_iterator(group.end()));
      group.erase(middle, group.end());
      run(std::move(group));
      return run(std::move(second));
    }
    for (Held& held : group) {
      if (settings_.engine.name != "auto") {
        end(held, failure(held.row, *held.task.entry, error.what(), error.code()));
        continue;
      }
      const SweepTask task = held.task;
      { const SweepLock released = std::move(held.lock); }
      run_sweep_member(task, settings_, stop_);
    }
  }

  const SweepSettings& settings_;
  const std::atomic<int>& stop_;
};

}  // namespace

void run_sweep_batch(const std::vector<SweepTask>& tasks, const SweepSettings& settings, const std::atomic<int>& stop) {
  try {
    SweepBatch batch(settings, stop);
    batch.run(batch.hold(tasks));
  } catch (...) {  // the folder itself fails, so nothing can be written any more
    for (const SweepTask& task : tasks) {
      SweepRow row = row_of(*task.member);
      if (task.entry->outcome == Outcome::waiting || task.entry->outcome == Outcome::running)
        task.entry->outcome = failure_now(row, *task.entry);
    }
  }
}

}  // namespace gem
