// gem view: a run file in the browser, from a server of this process or as one page file.
#include <chrono>
#include <memory>
#include <optional>
#include <thread>

#include "gem/base/error.h"
#include "gem/command/command.h"
#include "gem/run/run_signals.h"
#include "gem/view/server/gate.h"
#include "gem/view/server/open_browser.h"
#include "gem/view/server/view_server.h"
#include "gem/view/view_run.h"

namespace gem {

namespace {

struct ViewChoice {
  std::string path;
  std::string out;
  bool allow_incomplete = false;
  bool overwrite = false;
  bool no_browser = false;
};

/// Serves the page until a signal comes.
int serve_page(const ViewChoice& choice) {
  const RunFile readable(choice.path, choice.allow_incomplete);  // a file that cannot be shown is refused here
  view::Site site(choice.path, choice.allow_incomplete, nullptr);
  const StopSignals signals;
  const view::ViewServer server(site, view::new_token());
  std::optional<view::OpenedBrowser> browser;
  if (!choice.no_browser) browser.emplace(server.address());
  // without a browser the page can be found by its address alone
  if (browser && browser->is_open())
    print_about_file(server.address() + "\n");
  else
    print_needed(server.address() + "\n");
  while (StopSignals::received() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return 0;
}

}  // namespace

void add_view_command(CLI::App& app, Chosen& chosen) {
  const auto choice = std::make_shared<ViewChoice>();
  CLI::App* command = app.add_subcommand("view", "show a run file in the browser: the field that plays, loads, hits");
  command->add_option("file", choice->path, "run file")->required();
  CLI::Option* out =
      command->add_option("-o,--out", choice->out, "write one page with everything in it, which works offline")
          ->check(not_empty());
  command->add_flag("--overwrite", choice->overwrite, "with --out: replace a file that is no page of this case")
      ->needs(out);
  command->add_flag("--allow-incomplete", choice->allow_incomplete, "show an incomplete run");
  command->add_flag("--no-browser", choice->no_browser, "print the address and open nothing")->excludes(out);
  command->footer("Without --out the page is served to this machine alone, until Ctrl-C.");
  command->callback([choice, &chosen] {
    chosen.reading = {{choice->path}, !choice->out.empty()};
    chosen.action = [choice] {
      if (choice->out.empty()) return serve_page(*choice);
      view::write_page(choice->path, choice->out, choice->allow_incomplete, choice->overwrite);
      print_about_file(choice->out + "\n");
      return 0;
    };
  });
}

}  // namespace gem
