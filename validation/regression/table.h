// The golden table: one row per run with its state hash and physical numbers, as text.
#pragma once

#include <string>
#include <vector>

namespace gem::regression {

/// One number of a row, as in the table. The unit is part of the column name.
struct Cell {
  std::string column;
  std::string text;
};

/// The results of a run. The first cell is the state hash.
struct Row {
  std::string run;
  std::vector<Cell> cells;
};

/// Folder of the run list and the golden table.
std::string folder();

/// Path of the golden table.
std::string table_path();

/// The contents of a text file. Throws std::runtime_error if it cannot be read.
std::string text_of(const std::string& path);

/// Writes a text file. Throws std::runtime_error if it cannot be written whole.
void write_text(const std::string& path, const std::string& text);

/// Rows from CSV: a header `run,COLUMN,...` and one line per run. Throws std::runtime_error with the line of a mistake.
std::vector<Row> parse_table(const std::string& text, const std::string& origin);

/// Rows as CSV. All rows must have the same columns.
std::string table_text(const std::vector<Row>& rows);

/// Differences between golden and new numbers, one line each, with the relative change. Empty if all cells have equal
/// text.
std::string difference(const Row& golden, const Row& now);

/// The row of a run; null if there is none.
const Row* row_of(const std::vector<Row>& rows, const std::string& run);

}  // namespace gem::regression
