// gem report: pictures and tables of a run file.
#include <filesystem>
#include <memory>

#include "gem/command/command.h"
#include "gem/report/report.h"

namespace gem {

void add_report_command(CLI::App& app, Chosen& chosen) {
  struct Options {
    std::string path;
    std::string out;
    bool allow_incomplete = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("report", "write the report of a run file: one page with its figures");
  command->add_option("file", options->path, "run file")->required();
  command->add_option("-o,--out", options->out, "folder of the report; default: NAME_report beside NAME.h5")
      ->check(not_empty());
  command->add_flag("--allow-incomplete", options->allow_incomplete, "report an incomplete run");
  command->callback([options, &chosen] {
    chosen.action = [options] {
      std::string out = options->out;
      if (out.empty()) {
        std::filesystem::path stem(options->path);
        if (stem.extension() == ".h5") stem.replace_extension();
        out = stem.string() + "_report";
      }
      write_report(options->path, out, options->allow_incomplete);
      print(out + "/index.html\n");
      return 0;
    };
  });
}

}  // namespace gem
