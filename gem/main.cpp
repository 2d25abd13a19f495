// The program gem: its commands.
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <new>

#include "baseline_box2d/register_box2d.h"
#include "gem/base/error.h"
#include "gem/base/standard_streams.h"
#include "gem/command/command.h"
#include "gem/run/run_signals.h"

namespace {

/// Ends a process that has no memory where no exception can pass, as before main().
[[noreturn]] void end_in_order() {
  try {
    if (std::current_exception()) std::rethrow_exception(std::current_exception());
  } catch (const std::bad_alloc&) {
    constexpr char text[] = "gem: error: out of memory (nothing more can be done); use a machine with more\n";
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0) std::abort();
    _exit(static_cast<int>(gem::ExitCode::resource_limit));
  } catch (...) {
  }
  std::abort();
}

[[gnu::constructor(101)]] void end_in_order_from_the_start() { std::set_terminate(end_in_order); }

/// Earlier versions of gem had this command. It is now the program gem_paper.
void add_moved_paper_command(CLI::App& app, gem::Chosen& chosen) {
  CLI::App* command = app.add_subcommand("paper", "")->group("")->prefix_command();
  command->callback([&chosen] {
    chosen.action = []() -> int {
      throw gem::Error(gem::ExitCode::usage,
                       "the command paper has moved (to the program gem_paper); call `gem_paper judge`");
    };
  });
}

}  // namespace

int main(int argc, char** argv) {
  gem::open_standard_streams();
  gem::ignore_write_signals();
  gem::baseline::register_box2d();
  gem::Chosen chosen;
  CLI::App app("Loads of drifting pack ice on a moored platform, by event mechanics.", "gem");
  gem::add_version_option(app, chosen);
  app.footer(
      "Exit codes: 0 done; 2 usage; 3 the case is rejected; 4 file system; 5 device; 6 numerical stop, or with "
      "--strict "
      "a bad verdict; 7 memory or disk; 8 some of several runs failed; 129, 130, 143 stopped by SIGHUP, SIGINT, "
      "SIGTERM.");
  app.require_subcommand(0, 1);  // not required here: the program itself names an unknown command
  gem::add_run_command(app, chosen);
  gem::add_case_command(app, chosen);
  gem::add_sweep_command(app, chosen);
  gem::add_info_command(app, chosen);
  gem::add_report_command(app, chosen);
  gem::add_compare_command(app, chosen);
  gem::add_view_command(app, chosen);
  gem::add_export_command(app, chosen);
  gem::add_film_command(app, chosen);
  gem::add_repair_command(app, chosen);
  gem::add_analyse_command(app, chosen);
  gem::add_devices_command(app, chosen);
  gem::add_pages_commands(app, chosen);
  add_moved_paper_command(app, chosen);
  return gem::run_command_line(app, chosen, argc, argv);
}
