// gem analyse: periods, offset, orbit, contact and loads of one run; means and extremes over several.
#include <memory>

#include "gem/base/error.h"
#include "gem/command/analyse/analyse_output.h"
#include "gem/command/command.h"
#include "gem/command/time_option.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

using Json = nlohmann::ordered_json;

struct AnalyseOptions {
  std::vector<std::string> paths;
  std::string from = "0";
  bool allow_incomplete = false;
  bool json = false;
};

int analyse(const AnalyseOptions& options) {
  const double from_s = time_of_option("--from", options.from);
  std::vector<AnalysedRun> runs;
  for (const std::string& path : options.paths) runs.push_back(analysed(path, from_s, options.allow_incomplete));
  const auto say = [&options](const auto&... what) {
    print(options.json ? json_of(what...).dump(2, ' ', false, Json::error_handler_t::replace) + "\n"
                       : text_of(what...));
  };
  if (runs.size() == 1)
    say(runs.front());
  else
    say(runs, combined(runs));
  return 0;
}

}  // namespace

void add_analyse_command(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<AnalyseOptions>();
  CLI::App* command =
      app.add_subcommand("analyse", "periods, offset, orbit, contact and extremes of one or several run files");
  command->add_option("files", options->paths, "run files; several count as independent runs of one condition")
      ->required()
      ->type_name("RUNFILE");
  command
      ->add_option("--from", options->from,
                   "ignore the record before this time, e.g. until the ice arrives; in s, or with its unit, e.g. 5min")
      ->type_name("TIME");
  command->add_flag("--allow-incomplete", options->allow_incomplete, "analyse incomplete runs");
  command->add_flag("--json", options->json, "as JSON");
  command->callback([options, &chosen] {
    chosen.reading = {options->paths};
    chosen.action = [options] { return analyse(*options); };
  });
}

}  // namespace gem
