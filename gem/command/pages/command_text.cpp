// Reads the texts out of the parser of the command line.
#include "gem/command/pages/command_text.h"

#include <sstream>

namespace gem {
namespace {

/// The values of a type name such as "TEXT:{auto,cpu}".
std::vector<std::string> choices_in(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  std::vector<std::string> choices;
  if (open == std::string::npos || close == std::string::npos) return choices;
  std::istringstream text(type.substr(open + 1, close - open - 1));
  for (std::string choice; std::getline(text, choice, ',');) choices.push_back(choice);
  return choices;
}

OptionText option_text(const CLI::Option& option) {
  OptionText text;
  text.is_positional = option.get_positional();
  if (text.is_positional) {
    text.names = {option.get_name(true)};
  } else {
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  }
  text.takes_many = option.get_expected_max() > 1;
  text.is_required = option.get_required();
  const std::string type = option.get_type_size_max() == 0 ? "" : option.get_type_name();
  text.argument = type.substr(0, type.find(':'));
  text.choices = choices_in(type);
  text.preset = option.get_default_str();
  text.meaning = option.get_description();
  return text;
}

CommandText text_at(const CLI::App& app, const std::string& path) {
  CommandText text{path, app.get_description(), app.get_footer(), {}, {}};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) text.options.push_back(option_text(*option));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!command->get_group().empty())
      text.commands.push_back(text_at(*command, path + (path.empty() ? "" : " ") + command->get_name()));
  return text;
}

}  // namespace

CommandText command_text(const CLI::App& app) { return text_at(app, ""); }

}  // namespace gem
