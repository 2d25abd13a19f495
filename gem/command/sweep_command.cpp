// gem sweep: the runs of a sweep file.
#include <memory>

#include "gem/base/error.h"
#include "gem/command/command.h"
#include "gem/scene/case_text.h"
#include "gem/scene/sweep.h"

namespace gem {

void add_sweep_command(CLI::App& app, Chosen& chosen) {
  struct Options {
    std::string path;
    std::vector<std::string> overrides;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* group = app.add_subcommand("sweep", "sweep files: one file, many runs");
  group->require_subcommand(1);
  CLI::App* list = group->add_subcommand("list", "list the runs of a sweep file");
  list->add_option("file", options->path, "sweep file (TOML)")->required();
  list->add_option("--set", options->overrides, "override an option: key.path=value, repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  list->add_flag("--json", options->json, "as JSON");
  list->callback([options, &chosen] {
    chosen.action = [options] {
      const std::vector<SweepMember> members = expand_sweep(options->path, options->overrides);
      print(options->json ? sweep_list_json(members) : sweep_list_text(members));
      return 0;
    };
  });
}

}  // namespace gem
