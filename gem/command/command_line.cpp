// Parses the command line and returns the exit code.
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>

#include "gem/base/error.h"
#include "gem/command/command.h"
#include "gem/record/output_path.h"

namespace gem {
namespace {

/// A message may quote a hostile file. What would steer a terminal is escaped; lists of problems keep their lines.
std::string printable(const std::string& message) {
  std::string text;
  std::size_t begin = 0;
  for (std::size_t end = message.find('\n'); end != std::string::npos; end = message.find('\n', begin)) {
    text += shown(message.substr(begin, end - begin)) + '\n';
    begin = end + 1;
  }
  return text + shown(message.substr(begin));
}

/// Prints one line in the form of all other messages and returns the exit code.
int fault(const CLI::App& app, const Chosen& chosen, const std::string& message, ExitCode code) {
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

}  // namespace

int run_command_line(CLI::App& app, Chosen& chosen, int argc, char** argv) {
  chosen.command_line = joined(app.get_name(), argc, argv);
  try {
    app.parse(argc, argv);
    if (chosen.action) return chosen.action();
    std::cerr << app.help();
    return static_cast<int>(ExitCode::usage);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
  } catch (const Error& error) {
    return fault(app, chosen, error.what(), error.code());
  } catch (const std::bad_alloc&) {
    return fault(app, chosen, "out of memory (an allocation failed) use fewer floes or free memory",
                 ExitCode::resource_limit);
  } catch (const std::exception& error) {
    return fault(app, chosen, std::string("unexpected (") + error.what() + ") please report this",
                 ExitCode::resource_limit);
  }
}

}  // namespace gem
