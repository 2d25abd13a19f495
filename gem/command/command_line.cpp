// Parses the command line and returns the exit code.
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>

#include "gem/base/error.h"
#include "gem/command/command.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

/// A message as it is printed. It may quote a hostile file: control characters are escaped, but for the ends of lines,
/// and a long message is cut.
std::string printable(const std::string& message) {
  constexpr std::size_t bytes_maximum = 20000;
  std::string text;
  std::istringstream lines(message.substr(0, bytes_maximum));
  for (std::string line; std::getline(lines, line);) text += (text.empty() ? "" : "\n") + shown(line);
  return message.size() > bytes_maximum ? text + "..." : text;
}

/// Prints one line in the form of all other messages and returns the exit code.
int fault(const CLI::App& app, const Chosen& chosen, const std::string& text, ExitCode code) {
  const std::string message = printable(text);
  if (chosen.json_messages) {
    const nlohmann::ordered_json object = {
        {"level", "error"}, {"message", message}, {"exit_code", static_cast<int>(code)}};
    std::cerr << object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
  } else {
    std::cerr << app.get_name() << ": error: " << printable(message) << '\n';
  }
  return static_cast<int>(code);
}

std::string joined(std::string text, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) text += " " + shown(argv[i]);
  return text;
}

/// Parses the command line and runs the chosen command. Prints the help that was asked for.
int run_action(CLI::App& app, Chosen& chosen, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream help;
    const int code = app.exit(error, help, std::cerr) == 0 ? 0 : static_cast<int>(ExitCode::usage);
    print(help.str());
    return code;
  }
  if (chosen.action && chosen.in_child && !chosen.reading.files.empty())
    if (const std::optional<int> code = left_to_child(chosen.reading)) return *code;
  if (chosen.action) return chosen.action();
  std::cerr << app.help();
  return static_cast<int>(ExitCode::usage);
}

}  // namespace

int run_command_line(CLI::App& app, Chosen& chosen, int argc, char** argv) {
  chosen.command_line = joined(app.get_name(), argc, argv);
  try {
    return run_action(app, chosen, argc, argv);
  } catch (const Error& error) {
    return fault(app, chosen, error.what(), error.code());
  } catch (const std::bad_alloc&) {
    return fault(app, chosen, "out of memory (an allocation failed); use fewer floes or free memory",
                 ExitCode::resource_limit);
  } catch (const std::exception& error) {
    return fault(app, chosen, std::string("unexpected (") + error.what() + "); please report this",
                 ExitCode::resource_limit);
  }
}

}  // namespace gem
