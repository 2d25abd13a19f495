// gem paper: the reproduction report of the paper from run files and summaries.
#include <memory>

#include "gem/command/command.h"
#include "gem/report/paper/paper_report.h"

namespace gem {

void add_paper_command(CLI::App& app, Chosen& chosen) {
  struct Options {
    std::vector<std::string> runs;
    std::string out;
    std::string statements;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "paper", "judge the statements of the ICETECH 2014 paper by run files and summaries: page, rows and figures");
  command
      ->add_option("folders", options->runs,
                   "folders or files: run files of cases/table1.toml and the other sweeps, or what `gem sweep collect` "
                   "made of them")
      ->required();
  command->add_option("-o,--out", options->out, "folder of the report")->required();
  command
      ->add_option(
          "--statements", options->statements,
          "the paper's tables and statements (JSON); rows of build/unordered_sums are read from the same folder")
      ->default_val("validation/paper/paper.json");
  command->callback([options, &chosen] {
    chosen.action = [options] {
      const PaperReportSummary summary = write_paper_report(options->runs, options->out, options->statements);
      print(options->out + "/README.md: " + std::to_string(summary.runs) + " runs, " + std::to_string(summary.refused) +
            " files refused; statements reproduced " + std::to_string(summary.reproduced) + ", not reproduced " +
            std::to_string(summary.not_reproduced) + ", undecidable " + std::to_string(summary.undecidable) + "\n");
      return 0;
    };
  });
}

}  // namespace gem
