// gem manual and gem completion: pages made from the commands themselves.
#include "gem/command/command.h"
#include "gem/command/pages/completion.h"
#include "gem/command/pages/manual_page.h"
#include "gem/record/build_identity.h"
#include "gem/scene/schema/schema.h"

namespace gem {
namespace {

std::string completion_text(const CLI::App& app) {
  std::vector<std::string> keys, topics;
  for (const auto& option : scene_options()) {
    const std::string section = option.path.substr(0, option.path.find('.'));
    if (topics.empty() || topics.back().substr(0, topics.back().find('.')) != section) topics.push_back(section);
    topics.push_back(option.path);
    keys.push_back(option.path);
  }
  return bash_completion(command_text(app), keys, topics);
}

}  // namespace

void add_pages_commands(CLI::App& app, Chosen& chosen) {
  CLI::App* manual = app.add_subcommand("manual", "print the manual page: `gem manual | man -l -`");
  manual->callback([&app, &chosen] {
    chosen.action = [&app] {
      print(manual_page(command_text(app), build_identity().version));
      return 0;
    };
  });
  CLI::App* completion = app.add_subcommand("completion", "print the completion for bash: `source <(gem completion)`");
  completion->callback([&app, &chosen] {
    chosen.action = [&app] {
      print(completion_text(app));
      return 0;
    };
  });
}

}  // namespace gem
