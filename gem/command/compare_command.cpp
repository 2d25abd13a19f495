// gem compare: several run files side by side.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "gem/command/command.h"
#include "gem/command/time_option.h"
#include "gem/command/verdict_output.h"
#include "gem/record/output/output_path.h"
#include "gem/report/compare/compare_page.h"

namespace gem {
namespace {

using Json = nlohmann::ordered_json;

struct CompareOptions {
  std::vector<std::string> paths;
  std::string from = "0";
  std::string out;
  bool allow_incomplete = false;
  bool json = false;
};

Json json_of(const ComparedCell& cell) {
  if (!cell.text.empty()) return cell.text;
  if (!cell.value || !std::isfinite(*cell.value)) return nullptr;
  Json object = {{"value", *cell.value}};
  if (cell.interval) {
    object["low"] = cell.interval->low;
    object["high"] = cell.interval->high;
  }
  if (cell.not_converged) object["not_converged"] = true;
  return object;
}

Json json_of(const Comparison& comparison) {
  Json object = {{"from_s", comparison.from_s},
                 {"runs", Json::array()},
                 {"differences", Json::object()},
                 {"numbers", Json::object()}};
  for (const ComparedRun& run : comparison.runs)
    object["runs"].push_back({{"file", run.path},
                              {"name", run.data.identity.name},
                              {"label", run.label},
                              {"verdict", grade_name(run.data.verdict.grade)},
                              {"verdict_criteria", criteria_json(run.data.verdict)}});
  for (const CaseDifference& difference : comparison.differences)
    object["differences"][difference.key] = difference.values;
  if (const auto reasons = missing_intervals(comparison); !reasons.empty()) object["no_intervals"] = reasons;
  for (const ComparedRow& row : comparison.rows) {
    Json& entry = object["numbers"][row.name] = {{"meaning", row.meaning}, {"values", Json::array()}};
    for (const ComparedCell& cell : row.cells) entry["values"].push_back(json_of(cell));
    if (row.apart != Apart::unknown) entry["intervals_apart"] = row.apart == Apart::yes;
  }
  return object;
}

/// Rows of cells as columns of equal width.
class TextTable {
 public:
  void row(std::vector<std::string> cells) {
    width_.resize(std::max(width_.size(), cells.size()));
    for (std::size_t i = 0; i < cells.size(); ++i) width_[i] = std::max(width_[i], cells[i].size());
    rows_.push_back(std::move(cells));
  }
  std::string text() const {
    std::string all;
    for (const auto& cells : rows_) {
      std::string line = " ";
      for (std::size_t i = 0; i < cells.size(); ++i)
        line += " " + cells[i] + std::string(width_[i] - cells[i].size() + 1, ' ');
      line.erase(line.find_last_not_of(' ') + 1);
      all += line + "\n";
    }
    return all;
  }

 private:
  std::vector<std::size_t> width_;
  std::vector<std::vector<std::string>> rows_;
};

std::vector<std::string> with_labels(const std::string& first, const Comparison& comparison) {
  std::vector<std::string> cells = {first};
  for (const ComparedRun& run : comparison.runs) cells.push_back(shown(run.label));
  return cells;
}

std::string text_of(const Comparison& comparison) {
  TextTable keys, numbers;
  keys.row(with_labels("", comparison));
  for (const CaseDifference& difference : comparison.differences) {
    std::vector<std::string> cells = {shown(difference.key)};
    for (const std::string& value : difference.values) cells.push_back(shown(value));
    keys.row(cells);
  }
  numbers.row(with_labels("", comparison));
  for (const ComparedRow& row : comparison.rows) {
    std::vector<std::string> cells = {row.name};
    for (const ComparedCell& cell : row.cells) cells.push_back(shown(cell_text(row, cell)));
    if (row.apart == Apart::yes) cells.push_back("apart");
    numbers.row(cells);
  }
  std::string reasons;
  for (const std::string& sentence : missing_intervals(comparison)) reasons += sentence + "\n";
  return (comparison.differences.empty() ? "the cases have the same keys and values\n"
                                         : "what differs in the cases\n" + keys.text()) +
         "numbers, with 95 % intervals in brackets; apart: the intervals have no common part\n" + numbers.text() +
         reasons;
}

int compare(const CompareOptions& options) {
  const Comparison comparison =
      compare_runs(options.paths, time_of_option("--from", options.from), options.allow_incomplete);
  if (!options.out.empty()) write_comparison(comparison, options.out);
  if (options.json)
    print(json_of(comparison).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  else if (options.out.empty())
    print(text_of(comparison));
  else
    print_about_file(options.out + "/index.html\n");
  return 0;
}

}  // namespace

void add_compare_command(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand(
      "compare", "run files side by side: loads, motion, events, verdict, and what differs in their cases");
  command->add_option("files", options->paths, "run files, at least two")->required()->type_name("RUNFILE");
  command->add_option("--from", options->from, "ignore the records before this time, e.g. 5min")
      ->type_name("TIME")
      ->capture_default_str();
  command
      ->add_option("-o,--out", options->out,
                   "folder for a page with the table and overlaid figures; default: a table "
                   "on standard output")
      ->check(not_empty())
      ->type_name("FOLDER");
  command->add_flag("--allow-incomplete", options->allow_incomplete, "compare incomplete runs");
  command->add_flag("--json", options->json, "as JSON");
  command->callback([options, &chosen] {
    chosen.reading = {options->paths};
    chosen.action = [options] { return compare(*options); };
  });
}

}  // namespace gem
