// gem export: a run file in the formats of other programs.
#include "gem/export/export_run.h"

#include <filesystem>
#include <memory>

#include "gem/base/error.h"
#include "gem/command/command.h"
#include "gem/command/time_option.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

struct ExportOptions {
  ExportTarget target;
  std::string at, every, table;
};

/// Refuses an option of another kind of output.
void check_export_option(const std::string& flag, const std::string& value, bool fits, const std::string& ending) {
  if (value.empty() || fits) return;
  throw Error(ExitCode::usage, flag + " has no effect on " + ending +
                                   " (see `gem export --help`); leave it out, or choose another ending");
}

int export_chosen(const ExportOptions& options) {
  const ExportTarget& target = options.target;
  const std::string ending = std::filesystem::path(target.output).extension().string();
  const bool film = ending == ".pvd", map = ending == ".geojson", table = ending == ".csv";
  if (!film && !map && !table)
    throw Error(ExitCode::usage, "cannot write " + shown(target.output) +
                                     " (its ending names no format); allowed are .pvd, .geojson and .csv");
  check_export_option("--at", options.at, map, ending);
  check_export_option("--every", options.every, film, ending);
  check_export_option("--table", options.table, table, ending);
  if (map) {
    print_about_file(export_geojson(target, options.at.empty() ? -1.0 : time_of_option("--at", options.at)));
  } else if (table) {
    print_about_file(export_table(target, options.table.empty() ? "platform" : options.table));
  } else {
    print_about_file(export_paraview(target, options.every.empty() ? 0.0 : time_of_option("--every", options.every)));
  }
  return 0;
}

}  // namespace

void add_export_command(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand("export", "write a run file for ParaView, as GeoJSON or as CSV");
  command->add_option("file", options->target.run_file, "run file")->required()->type_name("RUNFILE");
  command
      ->add_option("out", options->target.output,
                   "NAME.pvd: all frames for ParaView, with the folder NAME_vtp; NAME.geojson: the floes of one frame, "
                   "which is a floe file again; NAME.csv: a table")
      ->required()
      ->check(not_empty());
  command->add_option("--at", options->at, "of .geojson: time of the frame, e.g. 1.3h; default: the end of the record")
      ->type_name("TIME");
  command->add_option("--every", options->every, "of .pvd: time between two frames; default: every frame")
      ->type_name("TIME");
  command->add_option("--table", options->table, "of .csv: which one; default: platform")
      ->check(CLI::IsMember({"platform", "events", "stats", "contacts"}));
  command->add_flag("--overwrite", options->target.overwrite, "replace an earlier export");
  command->add_flag("--allow-incomplete", options->target.allow_incomplete, "export an incomplete run");
  command->callback([options, &chosen] {
    chosen.reading = {{options->target.run_file}};
    chosen.action = [options] { return export_chosen(*options); };
  });
}

}  // namespace gem
