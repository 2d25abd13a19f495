// The commands and options as data: manual page and completion are made from it, and so from the text of --help.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gem {

struct OptionText {
  std::vector<std::string> names;  // "-o", "--out"; of a positional argument its one name
  bool is_positional = false;
  bool takes_many = false;
  bool is_required = false;
  std::string argument;              // what it takes, e.g. "SECONDS"; empty: nothing
  std::vector<std::string> choices;  // the only values; empty: any
  std::string preset;                // default value; empty: none shown
  std::string meaning;
};

struct CommandText {
  std::string path;  // "run", "sweep list"; empty for the program itself
  std::string meaning;
  std::string footer;
  std::vector<OptionText> options;
  std::vector<CommandText> commands;
};

/// All that --help shows. Hidden commands and options (those without a group) are left out.
CommandText command_text(const CLI::App& app);

}  // namespace gem
