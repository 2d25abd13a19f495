// gem --version, for people and as JSON.
#include <memory>
#include <nlohmann/json.hpp>

#include "gem/analysis/gsl_version.h"
#include "gem/command/command.h"
#include "gem/command/installed_files.h"
#include "gem/record/build_identity.h"
#include "gem/record/run_file/run_writer.h"

namespace gem {
namespace {

std::string version_json() {
  const BuildIdentity build = build_identity();
  nlohmann::ordered_json object = {{"program", "gem"},
                                   {"version", build.version},
                                   {"commit", build.commit},
                                   {"build_type", build.build_type},
                                   {"compiler", build.compiler},
                                   {"engines", engine_names()},
                                   {"baselines", baseline_names()},
                                   {"libraries", {{"GSL", gsl_library_version()}}},
                                   {"installed_files", nullptr}};
  if (build.has_cuda) object["engines"].push_back("cuda");
  for (const auto& [name, version] : build.libraries) object["libraries"][name] = version;
  if (const auto share = installed_share(); !share.empty()) object["installed_files"] = share.string();
  return object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

void add_version_option(CLI::App& app, Chosen& chosen) {
  struct Options {
    bool version = false;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::Option* version = app.add_flag("--version", options->version, "print version, commit and compiler");
  app.add_flag("--json", options->json, "with --version: also engines, libraries and the installed files, as JSON")
      ->needs(version);
  app.final_callback([options, &chosen] {
    if (!options->version) return;
    chosen.action = [options] {
      print(options->json ? version_json() : build_text() + "\n");
      return 0;
    };
  });
}

}  // namespace gem
