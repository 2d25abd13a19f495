// gem repair: mends a run file that was not closed.
#include <filesystem>
#include <memory>

#include "gem/command/command.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_repair.h"

namespace gem {

void add_repair_command(CLI::App& app, Chosen& chosen) {
  struct Options {
    std::string path;
    std::string out;
    bool overwrite = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("repair", "mend a run file that was not closed or has rows without data");
  command->add_option("file", options->path, "run file; it stays as it is")->required();
  command->add_option("-o,--out", options->out, "mended copy; default: NAME_repaired.h5 beside NAME.h5");
  command->add_flag("--overwrite", options->overwrite, "replace an existing mended copy");
  command->footer(
      "All datasets of a group get the length of the rows that they share, and zeros behind the last time are cut. A "
      "file "
      "with status running gets the status stopped:killed. A file in which nothing is wrong is not copied.");
  command->callback([options, &chosen] {
    chosen.reading = {{options->path}};
    chosen.action = [options] {
      std::string out = options->out;
      if (out.empty()) {
        std::filesystem::path stem(options->path);
        if (stem.extension() == ".h5") stem.replace_extension();
        out = stem.string() + "_repaired.h5";
      }
      const RepairReport report = repair_run_file(options->path, out, options->overwrite);
      std::string text = report.output.empty() ? shown(options->path) + ": nothing to mend\n" : shown(out) + "\n";
      for (const std::string& line : report.done) text += "  " + line + "\n";
      print_about_file(text);
      return 0;
    };
  });
}

}  // namespace gem
