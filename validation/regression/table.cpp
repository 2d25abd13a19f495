// Reads, writes and compares golden tables.
#include "validation/regression/table.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "gem/base/number_text.h"

namespace gem::regression {
namespace {

std::vector<std::string> parts_of(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream text(line);
  for (std::string part; std::getline(text, part, ',');) parts.push_back(part);
  return parts;
}

/// Text of a cell of a row, or "-" if the row does not have the column.
std::string cell_text(const Row& row, const std::string& column) {
  for (const Cell& cell : row.cells)
    if (cell.column == column) return cell.text;
  return "-";
}

/// The columns of both rows, those of `now` first.
std::vector<std::string> columns_of(const Row& now, const Row& golden) {
  std::vector<std::string> columns;
  for (const Row* row : {&now, &golden})
    for (const Cell& cell : row->cells)
      if (std::find(columns.begin(), columns.end(), cell.column) == columns.end()) columns.push_back(cell.column);
  return columns;
}

/// Relative change from `golden` to `now`; a word if they are not numbers.
std::string change_text(const std::string& golden, const std::string& now) {
  if (golden == now) return "same";
  const auto before = parse_number(golden), after = parse_number(now);
  if (!before || !after || *before == 0.0) return "changed";
  std::string text = number_text((*after - *before) / std::abs(*before), 3);
  return text[0] == '-' ? text : "+" + text;
}

}  // namespace

std::string folder() { return std::string(GEM_SOURCE_DIR) + "/validation/regression"; }

std::string table_path() { return folder() + "/golden.csv"; }

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + " cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path + " cannot be written");
}

std::vector<Row> parse_table(const std::string& text, const std::string& origin) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> head = parts_of(line);
  if (head.size() < 2 || head[0] != "run") throw std::runtime_error(origin + ":1: the head is `run,COLUMN,...`");
  std::vector<Row> rows;
  for (int number = 2; std::getline(lines, line); ++number) {
    const std::vector<std::string> parts = parts_of(line);
    if (parts.size() != head.size())
      throw std::runtime_error(origin + ":" + std::to_string(number) + ": " + std::to_string(parts.size()) +
                               " cells, the head has " + std::to_string(head.size()));
    Row row{parts[0], {}};
    for (std::size_t i = 1; i < parts.size(); ++i) row.cells.push_back({head[i], parts[i]});
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string table_text(const std::vector<Row>& rows) {
  std::string text = "run";
  if (!rows.empty())
    for (const Cell& cell : rows.front().cells) text += "," + cell.column;
  text += "\n";
  for (const Row& row : rows) {
    text += row.run;
    for (const Cell& cell : row.cells) text += "," + cell.text;
    text += "\n";
  }
  return text;
}

std::string difference(const Row& golden, const Row& now) {
  bool same = true;
  std::ostringstream table;
  const auto line = [&](const std::string& column, const std::string& a, const std::string& b, const std::string& c) {
    table << "  " << std::left << std::setw(24) << column << std::right << std::setw(18) << a << std::setw(18) << b
          << std::setw(12) << c << "\n";
  };
  line(now.run, "golden", "now", "change");
  for (const std::string& column : columns_of(now, golden)) {
    const std::string before = cell_text(golden, column), after = cell_text(now, column);
    same = same && before == after;
    line(column, before, after, change_text(before, after));
  }
  return same ? "" : table.str();
}

const Row* row_of(const std::vector<Row>& rows, const std::string& run) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.run == run; });
  return found == rows.end() ? nullptr : &*found;
}

}  // namespace gem::regression
