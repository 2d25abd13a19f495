// gem_paper judges the statements of the ICETECH 2014 paper from run files and summaries of gem.
#include <memory>

#include "gem/base/standard_streams.h"
#include "gem/command/command.h"
#include "gem/command/sweep/sweep_collect.h"
#include "gem/record/run_file/run_writer.h"
#include "gem/run/run_signals.h"
#include "validation/paper/page/paper_report.h"
#include "validation/paper/runs/paper_summary.h"

namespace {

using gem::Chosen;

void add_judge_command(CLI::App& app, Chosen& chosen) {
  struct Options {
    std::vector<std::string> runs;
    std::string out;
    std::string statements;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("judge", "judge the statements: page, rows and figures");
  command
      ->add_option("folders", options->runs,
                   "folders or files: run files of cases/table1.toml and the other sweeps, or what `gem_paper collect` "
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
      const gem::PaperReportSummary summary = gem::write_paper_report(options->runs, options->out, options->statements);
      gem::print(options->out + "/README.md: " + std::to_string(summary.runs) + " runs, " +
                 std::to_string(summary.refused) + " files refused; statements reproduced " +
                 std::to_string(summary.reproduced) + ", not reproduced " + std::to_string(summary.not_reproduced) +
                 ", undecidable " + std::to_string(summary.undecidable) + "\n");
      return 0;
    };
  });
}

/// Writes the summary of `gem sweep collect` with the case and the paper's numbers of every run.
int collect(const gem::SweepCollectChoice& choice, gem::NullModel null_model) {
  std::vector<gem::PaperRun> runs;
  gem::SummaryPart part;
  part.look_at = [&](const gem::RunFile& records, const gem::RunData& data) {
    runs.push_back(paper_run(records, data, null_model));
  };
  part.add_columns = [&](gem::SummaryTable& table) { add_paper_part(table, runs); };
  return collect_sweep(choice, part);
}

void add_collect_command(CLI::App& app, Chosen& chosen) {
  struct Options {
    gem::SweepCollectChoice choice;
    bool null_model = true;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "collect", "the summary of `gem sweep collect` with all that judge needs of the runs, in place of their files");
  gem::add_collect_options(*command, options->choice);
  command->add_flag("!--no-null-model", options->null_model,
                    "leave out the tests against a linear oscillator hit at random, which take most of the time");
  command->callback([options, &chosen] {
    options->choice.command_line = chosen.command_line;
    chosen.action = [options] {
      return collect(options->choice, options->null_model ? gem::NullModel::compared : gem::NullModel::left_out);
    };
  });
}

}  // namespace

int main(int argc, char** argv) {
  gem::open_standard_streams();
  gem::ignore_write_signals();
  Chosen chosen;
  CLI::App app("Judges the statements of the ICETECH 2014 paper by runs of gem.", "gem_paper");
  app.set_version_flag("--version", gem::build_text());
  app.require_subcommand(0, 1);
  add_judge_command(app, chosen);
  add_collect_command(app, chosen);
  return gem::run_command_line(app, chosen, argc, argv);
}
