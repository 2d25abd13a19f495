// gem sweep: its subcommands.
#include <memory>

#include "gem/base/error.h"
#include "gem/command/command.h"
#include "gem/command/run/run_choice.h"
#include "gem/command/sweep/sweep_collect.h"
#include "gem/command/sweep/sweep_run.h"
#include "gem/command/sweep/sweep_sensitivity.h"
#include "gem/command/sweep/sweep_status.h"
#include "gem/scene/sweep/sweep.h"
#include "gem/scene/toml/case_text.h"

namespace gem {
namespace {

void add_overrides(CLI::App& command, std::vector<std::string>& overrides) {
  command.add_option("--set", overrides, "override an option: key.path=value, repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_list(CLI::App& group, Chosen& chosen) {
  struct Options {
    std::string path;
    std::vector<std::string> overrides;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* list = group.add_subcommand("list", "list the runs of a sweep file");
  list->add_option("file", options->path, "sweep file (TOML)")->required();
  add_overrides(*list, options->overrides);
  list->add_flag("--json", options->json, "as JSON");
  list->callback([options, &chosen] {
    chosen.action = [options] {
      const std::vector<SweepMember> members = read_sweep(options->path, options->overrides);
      print(options->json ? sweep_list_json(members) : sweep_list_text(members));
      return 0;
    };
  });
}

void add_run(CLI::App& group, Chosen& chosen) {
  const auto choice = std::make_shared<SweepRunChoice>();
  CLI::App* run = group.add_subcommand(
      "run",
      "make the runs that are not done yet, each into DIR/NAME.h5; call it again to continue after an interruption");
  run->add_option("file", choice->path, "sweep file (TOML)")->required();
  run->add_option("-o,--out", choice->folder, "folder of the run files and of manifest.json; created if missing")
      ->type_name("DIR")
      ->check(not_empty())
      ->required();
  add_overrides(*run, choice->overrides);
  run->add_option("--index", choice->index, "only these runs, counted from 1: 3 or 1-4,7; see `gem sweep list`")
      ->type_name("LIST");
  run->add_option("--engine", choice->engine, "engine; auto: cuda if a GPU can take the run, else cpu")
      ->check(CLI::IsMember(engine_choices()))
      ->capture_default_str();
  run->add_option("-j,--jobs", choice->jobs,
                  "processes at a time, each with one run or with a batch of runs on a GPU; default: one per GPU, or "
                  "without GPUs "
                  "one per processor")
      ->type_name("J");
  run->add_option(
         "--threads", choice->threads,
         "threads of each run; for a batch on a GPU the threads that record; default: processors divided by --jobs")
      ->type_name("T");
  run->add_flag("--overwrite", choice->overwrite, "run again what is done, and replace files of other cases");
  run->add_option("--checkpoint-every", choice->checkpoint_interval_s,
                  "wall time between two checkpoints of a run, from which a later call goes on; 0: none at all")
      ->type_name("SECONDS")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
  add_flush_option(*run, choice->flush_interval_s);
  run->add_flag("--dry-run", choice->dry_run,
                "print which runs would be made and what they need, without running or writing anything");
  run->add_flag("--strict", choice->strict, "exit code 6 if the verdict on a chosen run is bad");
  run->add_flag("--force", choice->force, "run even if memory or disk seem too small");
  run->add_option("--progress", choice->progress, "progress on standard error")
      ->check(CLI::IsMember({"auto", "none", "line", "json"}))
      ->capture_default_str();
  run->add_flag("-q,--quiet", choice->quiet, "errors only");
  run->add_option("--log-format", choice->log_format, "messages on standard error")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  run->add_flag("--json", choice->json, "summary as JSON");
  run->footer(
      "A run that stopped or was killed goes on from its last checkpoint, to the same bits.\n"
      "Several calls may share one DIR, on one machine or many: each takes runs that no other call has taken.\n"
      "Exit code 8: some runs failed, all others were made. A single chosen run returns its own code.\n"
      "Exit code 6 with --strict: all runs were made, and some are bad, also those that were done before.");
  run->callback([choice, &chosen] {
    choice->command_line = chosen.command_line;
    chosen.json_messages = choice->log_format == "json";
    chosen.action = [choice] { return run_sweep(*choice); };
  });
}

void add_status(CLI::App& group, Chosen& chosen) {
  const auto choice = std::make_shared<SweepStatusChoice>();
  CLI::App* status = group.add_subcommand("status", "show which runs are done, running, stopped, failed or missing");
  status->add_option("path", choice->path, "folder of a sweep, or a sweep file together with --out")->required();
  status->add_option("-o,--out", choice->folder, "folder of the sweep file's runs")
      ->type_name("DIR")
      ->check(not_empty());
  add_overrides(*status, choice->overrides);
  status->add_flag("--json", choice->json, "as JSON");
  status->callback([choice, &chosen] { chosen.action = [choice] { return sweep_status(*choice); }; });
}

void add_collect(CLI::App& group, Chosen& chosen) {
  const auto choice = std::make_shared<SweepCollectChoice>();
  CLI::App* collect = group.add_subcommand(
      "collect", "settings, findings and displacement of all runs as one HDF5 file that xarray opens");
  add_collect_options(*collect, *choice);
  collect->add_option("--from", choice->from_s, "leave earlier times out of the findings [s]");
  collect->callback([choice, &chosen] {
    choice->command_line = chosen.command_line;
    chosen.action = [choice] { return collect_sweep(*choice); };
  });
}

void add_sensitivity(CLI::App& group, Chosen& chosen) {
  const auto choice = std::make_shared<SweepSensitivityChoice>();
  CLI::App* command = group.add_subcommand(
      "sensitivity", "how much of the scatter of the loads each drawn input makes: shares with intervals, and a page");
  command->add_option("folder", choice->folder, "folder of a sweep with [sweep.draw]")->type_name("DIR")->required();
  command->add_option("-o,--out", choice->output, "folder of the page; default: DIR_sensitivity")->check(not_empty());
  command
      ->add_option("--measure", choice->measures,
                   "result to look at, as `gem analyse` names it, repeatable; default: mean and largest loads")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command->add_option("--from", choice->from_s, "leave earlier times out [s]");
  command->add_flag("--partial", choice->partial, "use the runs that are done even if others are missing");
  command->add_option("--table", choice->table, "write no page, only this CSV file of the runs; needs no gnuplot")
      ->type_name("FILE")
      ->check(not_empty());
  command->add_flag("--json", choice->json, "the shares as JSON");
  command->callback([choice, &chosen] {
    chosen.reading = {{choice->folder}};
    chosen.action = [choice] { return sweep_sensitivity(*choice); };
  });
}

}  // namespace

void add_collect_options(CLI::App& command, SweepCollectChoice& choice) {
  command.add_option("folder", choice.folder, "folder of a sweep")->type_name("DIR")->required();
  command.add_option("-o,--out", choice.output, "summary file, one row per run")
      ->type_name("FILE")
      ->check(not_empty())
      ->required();
  command.add_option("--index", choice.index, "only these runs, counted from 1: 3 or 1-4,7")->type_name("LIST");
  command.add_option("--series", choice.interval_s, "interval of the displacement [s]; 0: none")->capture_default_str();
  command.add_flag("--exact", choice.exact, "displacement and velocity in double precision, to compare diverging runs");
  command.add_flag("--partial", choice.partial, "collect the runs that are done even if others are missing");
  command.add_flag("--overwrite", choice.overwrite, "replace an existing summary");
}

void add_sweep_command(CLI::App& app, Chosen& chosen) {
  CLI::App* group = app.add_subcommand("sweep", "run, watch and collect the runs of a sweep file");
  group->require_subcommand(1);
  add_list(*group, chosen);
  add_run(*group, chosen);
  add_status(*group, chosen);
  add_collect(*group, chosen);
  add_sensitivity(*group, chosen);
}

}  // namespace gem
