// The command line: parses, runs the chosen command, and turns every fault into one line and an exit code.
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>

#include "baseline_box2d/register_box2d.h"
#include "gem/base/error.h"
#include "gem/command/command.h"
#include "gem/record/output_path.h"
#include "gem/record/run_writer.h"
#include "gem/run/run_signals.h"

namespace {

/// One line, in the form of the command's other messages.
int fault(const gem::Chosen& chosen, const std::string& message, gem::ExitCode code) {
  if (chosen.json_messages) {
    const nlohmann::ordered_json object = {
        {"level", "error"}, {"message", message}, {"exit_code", static_cast<int>(code)}};
    std::cerr << object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
  } else {
    std::cerr << "gem: error: " << message << '\n';
  }
  return static_cast<int>(code);
}

std::string joined(int argc, char** argv) {
  std::string text = "gem";
  for (int i = 1; i < argc; ++i) text += " " + gem::shown(argv[i]);
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  gem::ignore_write_signals();
  gem::baseline::register_box2d();
  gem::Chosen chosen;
  chosen.command_line = joined(argc, argv);
  CLI::App app("Loads of drifting pack ice on a moored platform, by event mechanics.", "gem");
  app.set_version_flag("--version", gem::build_text());
  app.require_subcommand(0, 1);  // so that an unknown command is named
  gem::add_run_command(app, chosen);
  gem::add_case_command(app, chosen);
  gem::add_sweep_command(app, chosen);
  gem::add_info_command(app, chosen);
  gem::add_report_command(app, chosen);
  gem::add_analyse_command(app, chosen);
  gem::add_paper_command(app, chosen);
  gem::add_devices_command(app, chosen);
  try {
    app.parse(argc, argv);
    if (chosen.action) return chosen.action();
    std::cerr << app.help();
    return static_cast<int>(gem::ExitCode::usage);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(gem::ExitCode::usage);
  } catch (const gem::Error& error) {
    return fault(chosen, error.what(), error.code());
  } catch (const std::bad_alloc&) {
    return fault(chosen, "out of memory (an allocation failed) use fewer floes or free memory",
                 gem::ExitCode::resource_limit);
  } catch (const std::exception& error) {
    return fault(chosen, std::string("unexpected (") + error.what() + ") please report this",
                 gem::ExitCode::resource_limit);
  }
}
