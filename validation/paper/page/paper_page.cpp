// Writes the page: tables in Markdown.
#include "validation/paper/page/paper_page.h"

#include <set>
#include <sstream>

#include "validation/paper/page/page_parts.h"

namespace gem {
namespace {

constexpr const char* kHowTo = R"(How a verdict comes about: every statement is one number with an interval and one rule
(`validation/paper/paper.json`: rule, tolerance and why). *Reproduced*: the whole interval obeys the rule. *Not
reproduced*: none of it does. *Undecidable*: a part of it does, or runs are missing; an average over one run without
an interval of its own decides nothing. A statement about an average is judged by the mean over the seeds and its 95 %
interval (Student's t of fewer than ten, the bootstrap over them from ten on). A share of pairs of runs has Wilson's
95 % interval, which takes the pairs as independent, though they share runs. A statement about each run is judged by
the share of seeds that obey it, with Wilson's 95 % interval: reproduced if that lies above one half (or the share
that its row in `paper.json` asks for), not reproduced if it lies below; fewer than four seeds decide nothing, even if
all obey. What the case or its generator sets (`alike` in `paper.json`: floes, durations, the swing without ice) is
the same for every seed, and one run decides it. *One seed* marks a verdict on a single run. A chance (p) that is not
small proves nothing and is undecidable; one near 1 over many runs says besides that the null model, whose damping is
taken from the same run, fits too well for the test to have power. Each row is judged for itself: of many rows at 95 %
a few near their bound will be wrong. The paper's figures survive as statements only, so no curve is compared with a curve.
`validation/paper/converged.md` judges run 1 and eleven other conditions again with converged contacts.
)";

std::string marked(Verdict verdict) {
  return verdict == Verdict::not_reproduced ? "**" + verdict_text(verdict) + "**" : verdict_text(verdict);
}

std::string head_text(const PaperFolder& folder, const Reproduction& result) {
  std::size_t runs = 0;
  std::set<std::string> builds, resolutions;
  for (const auto& [condition, list] : folder.conditions)
    for (const PaperRun& run : list) {
      ++runs;
      builds.insert(run.source);
      resolutions.insert(run.resolution + " on " + run.engine);
    }
  std::size_t counts[3] = {};
  for (const JudgedRow& row : result.statements) ++counts[static_cast<std::size_t>(row.verdict)];
  std::ostringstream text;
  text << "# The paper's runs and statements\n\nWritten by `scripts/paper_report.sh`; edit `paper.json`, not this "
          "page.\n\n"
       << runs << " runs of " << folder.conditions.size() << " conditions.";
  if (folder.repeated > 0) text << " " << folder.repeated << " of them were found twice, with one state hash.";
  for (const std::string& build : builds) text << " Made by " << build << ".";
  for (const std::string& resolution : resolutions) text << " " << resolution << ".";
  text << " Statements: " << counts[0] << " reproduced, " << counts[1] << " not reproduced, " << counts[2]
       << " undecidable.\n\n";
  for (const std::string& sentence : result.mixed) text << "**Not comparable: " << sentence << ".**\n\n";
  text << kHowTo << "\n";
  return text.str();
}

std::string statements_text(const Reproduction& result) {
  std::ostringstream text;
  text << "## Statements\n\n| | source | the paper | run | number | rule | result | verdict "
          "|\n|---|---|---|---|---|---|---|---|\n";
  for (const JudgedRow& row : result.statements)
    text << "| " << row.id << " | " << cell(row.source) << " | " << cell(row.says) << " | "
         << (row.condition.empty() ? "all" : cell(row.condition)) << " | `" << row.metric << "` | "
         << rule_text(row.rule) << " | " << cell(result_text(row.measured, row.note)) << " | " << marked(row.verdict)
         << (row.one_seed ? " (one seed)" : "") << " |\n";
  return text.str() + "\n";
}

std::string settings_text(const PaperFolder& folder, const Reproduction& result) {
  std::ostringstream text;
  text
      << "## Tables 1 and 2\n\nSettings compared with what the paper prints, and what the runs gave: mean over the "
         "runs, "
         "with the 95 % interval over several runs or within one, where it has one. Runs that share a GPU go on side "
         "by side: "
         "each counts the whole time from its start to its end, so that all together are faster than their `x real "
         "time` says.\n\n"
      << "| table | # | run | runs | settings | duration [s] | offset of x [mm] | deviation of x, y [mm] | largest "
         "excursion [mm] | period of x [s] | peak mooring [kN] | mean ice [kN] | deepest overlap [mm] | x real time |\n"
      << "|---|---|---|---:|---|---:|---|---|---|---|---|---|---|---:|\n";
  for (const JudgedSettings& settings : result.settings) {
    const TableRow& row = settings.row;
    text << "| " << row.table << " | " << row.number << " | " << row.run << " | " << settings.runs << " | ";
    if (settings.runs == 0) {
      text << "missing | | | | | | | | | |\n";
      continue;
    }
    text << (settings.differences.empty() ? "as printed" : "");
    for (const std::string& difference : settings.differences) text << "**" << difference << "** ";
    text << " | " << mean_text(folder, row.run, "duration_s") << " | " << mean_text(folder, row.run, "x_offset_m", 1e-3)
         << " | " << mean_text(folder, row.run, "x_deviation_m", 1e-3) << ", "
         << mean_text(folder, row.run, "y_deviation_m", 1e-3) << " | "
         << mean_text(folder, row.run, "orbit_largest_m", 1e-3) << " | "
         << mean_text(folder, row.run, "x_period_by_spectrum_s") << " | "
         << mean_text(folder, row.run, "mooring_peak_N", 1e3) << " | " << mean_text(folder, row.run, "ice_mean_N", 1e3)
         << " | " << mean_text(folder, row.run, "maximum_overlap_m", 1e-3) << " | "
         << mean_text(folder, row.run, "real_time_factor") << " |\n";
  }
  return text.str() + "\n";
}

std::string figures_text(const Reproduction& result, const std::filesystem::path& root) {
  std::ostringstream text;
  text
      << "## Figures\n\nEach beside its numbers (CSV) and script; the line at the top names conditions and commit.\n\n";
  for (const PaperFigure& figure : result.figures) {
    const std::string path = std::filesystem::relative(figure.path, root).generic_string();
    text << "### " << (figure.number == "-" ? "" : "Figure " + figure.number + ": ") << figure.title << "\n\n!["
         << figure.title << "](" << path << ".svg)\n\n";
  }
  return text.str();
}

std::string missing_text(const PaperFolder& folder) {
  if (folder.refused.empty()) return "";
  std::string text = "## Files that were not used\n\n";
  for (const std::string& reason : folder.refused) text += "- " + reason + "\n";
  return text + "\n";
}

}  // namespace

std::string page_text(const PaperFolder& folder, const Reproduction& result, const std::filesystem::path& root) {
  return head_text(folder, result) + statements_text(result) + settings_text(folder, result) +
         stationarity_text(result) + extremes_text(result) + days_text(folder, result) + period_text(result) +
         counting_text(folder) + choices_text(result) + divergence_text(result) + ice_text(result.ice) +
         chaos_text(folder) + unordered_text(result.unordered) + missing_text(folder) + figures_text(result, root);
}

}  // namespace gem
