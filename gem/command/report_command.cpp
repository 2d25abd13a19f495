// gem report: pictures and tables of a run file or of the folder of a sweep.
#include <filesystem>
#include <memory>

#include "gem/base/error.h"
#include "gem/command/command.h"
#include "gem/command/sweep/folder/sweep_folder.h"
#include "gem/command/sweep/folder/sweep_manifest.h"
#include "gem/command/time_option.h"
#include "gem/record/output/output_path.h"
#include "gem/report/report.h"
#include "gem/report/sweep/sweep_report.h"

namespace gem {

namespace {

/// The runs of a sweep's folder; those that are not done only if incomplete runs are allowed.
std::vector<SweepPageRun> runs_of_sweep(const std::string& folder, bool allow_incomplete) {
  const std::vector<SweepRow> rows = read_manifest(folder);
  if (rows.empty())
    throw Error(ExitCode::file_system, shown(folder) +
                                           " is not the folder of a sweep (it has no manifest.json); name a "
                                           "run file, or the --out folder of `gem sweep run`");
  std::vector<SweepPageRun> runs;
  for (const SweepRow& row : rows) {
    const SweepRow now = look_at_run(folder, row);
    const bool shows = now.status == "done" || (now.status == "stopped" && allow_incomplete);
    runs.push_back({now.name, shows ? run_path(folder, now.name) : "", now.status});
  }
  return runs;
}

/// The name of the report: that of its source with _report.
std::string report_folder(const std::string& source) {
  std::filesystem::path stem(source);
  if (!stem.has_filename()) stem = stem.parent_path();
  if (stem.extension() == ".h5") stem.replace_extension();
  return stem.string() + "_report";
}

}  // namespace

void add_report_command(CLI::App& app, Chosen& chosen) {
  struct Options {
    std::string path;
    std::string out;
    std::string at;
    bool allow_incomplete = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("report", "write the report of a run, or of a sweep: one page with its figures");
  command->add_option("file", options->path, "run file, or the folder of a sweep")->required()->type_name("RUNFILE");
  command->add_option("-o,--out", options->out, "folder of the report; default: NAME_report beside NAME.h5")
      ->check(not_empty());
  command
      ->add_option("--at", options->at,
                   "time of the field and of the zoom of the forces, e.g. 1.3h; default: the middle of the run, and "
                   "where most impacts are")
      ->type_name("TIME");
  command->add_flag("--allow-incomplete", options->allow_incomplete, "report an incomplete run");
  command->callback([options, &chosen] {
    chosen.reading = {{options->path}};
    chosen.action = [options] {
      const std::string out = options->out.empty() ? report_folder(options->path) : options->out;
      const auto at_s = options->at.empty() ? std::nullopt : std::optional(time_of_option("--at", options->at));
      std::error_code ignored;
      if (std::filesystem::is_directory(options->path, ignored)) {
        const std::filesystem::path folder = std::filesystem::weakly_canonical(options->path);
        write_sweep_report(folder.filename().string(), runs_of_sweep(options->path, options->allow_incomplete), out,
                           at_s);
      } else {
        write_report(options->path, out, options->allow_incomplete, at_s);
      }
      print_about_file(out + "/index.html\n");
      return 0;
    };
  });
}

}  // namespace gem
