// Reads the runs, judges them, draws the figures and writes the page.
#include "validation/paper/page/paper_report.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "gem/base/error.h"
#include "validation/paper/page/paper_page.h"
#include "validation/paper/statements/settings_check.h"

namespace gem {
namespace {

constexpr double kPaperPeriod = 72.0;  // "approximately 72 seconds" [s]

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file)
    throw Error(ExitCode::file_system,
                "cannot write " + path.string() + " (disk full or no permission); choose another output folder");
}

/// Refuses a folder without runs: an empty report would replace a good one.
void check_runs(const PaperFolder& folder) {
  if (!folder.conditions.empty()) return;
  const std::string reason = folder.refused.empty() ? "no file *.h5 is there" : folder.refused.front();
  throw Error(ExitCode::file_system,
              "no run was read (" + reason + "); name folders of run files or of what `gem_paper collect` made");
}

void append(std::vector<PaperFigure>& all, std::vector<PaperFigure> more) {
  for (PaperFigure& figure : more) all.push_back(std::move(figure));
}

/// Conditions of the tables in their order, then those of cases/day.toml.
std::vector<std::string> of_tables_and_days(const PaperFolder& folder, const Catalogue& catalogue) {
  std::vector<std::string> names;
  for (const TableRow& row : catalogue.rows)
    if (std::find(names.begin(), names.end(), row.run) == names.end()) names.push_back(row.run);
  for (const auto& [condition, runs] : folder.conditions)
    if (condition.starts_with("day_")) names.push_back(condition);
  return names;
}

/// Removes pictures of an earlier report, which this report may not draw again.
void remove_pictures(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> old;
  std::error_code failed;
  for (std::filesystem::recursive_directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    const std::string kind = entry->path().extension().string();
    if (kind == ".svg" || kind == ".png" || kind == ".gp" || kind == ".csv") old.push_back(entry->path());
  }
  for (const std::filesystem::path& path : old) std::filesystem::remove(path, failed);
}

}  // namespace

PaperReportSummary write_paper_report(const std::vector<std::string>& runs, const std::string& out,
                                      const std::string& statements) {
  const Catalogue catalogue = read_catalogue(statements);
  const PaperFolder folder = read_paper_folders(runs);
  check_runs(folder);
  const std::filesystem::path root(out);
  const std::filesystem::path pictures = root / "figures";
  Reproduction result;
  result.mixed = mixed_settings(folder, catalogue.rows);
  result.divergence = divergence_study(folder);
  FolderNumbers numbers = folder_numbers(folder, catalogue);
  add_divergence_numbers(result.divergence, numbers);
  result.ice = read_ice_study(std::filesystem::path(statements).parent_path());
  add_ice_numbers(result.ice, numbers);
  result.unordered = read_unordered_study(std::filesystem::path(statements).parent_path());
  add_unordered_numbers(result.unordered, numbers);
  for (const Statement& statement : catalogue.statements)
    result.statements.push_back(evaluate(statement, folder, numbers));
  for (const TableRow& row : catalogue.rows) result.settings.push_back(compare_settings(row, folder));
  const std::vector<std::string> names = of_tables_and_days(folder, catalogue);
  result.stationarity = stationarity(folder, names);
  result.extremes = seed_extremes(folder, names);
  result.days = day_study(folder);
  result.period = period_candidates(folder, kPaperPeriod);
  result.choices = sensitivity(folder, catalogue);
  remove_pictures(pictures);
  append(result.figures, twin_figures(folder, pictures));
  append(result.figures, repeat_figures(folder, result.divergence, pictures));
  append(result.figures, ice_figures(result.ice, pictures));
  append(result.figures, unordered_figures(result.unordered, pictures));
  append(result.figures, excursion_figures(folder, catalogue.rows, pictures));
  append(result.figures, seed_figures(folder, pictures));
  append(result.figures, extra_figures(folder, pictures));
  std::error_code failed;
  std::filesystem::create_directories(root, failed);
  write(root / "README.md", page_text(folder, result, root));
  write(root / "rows.csv", rows_text(result));
  PaperReportSummary summary;
  for (const auto& [condition, list] : folder.conditions) summary.runs += list.size();
  summary.refused = folder.refused.size();
  for (const JudgedRow& row : result.statements) {
    if (row.verdict == Verdict::reproduced) ++summary.reproduced;
    if (row.verdict == Verdict::not_reproduced) ++summary.not_reproduced;
    if (row.verdict == Verdict::undecidable) ++summary.undecidable;
  }
  return summary;
}

}  // namespace gem
