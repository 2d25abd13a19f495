// The golden table: one row a run, a state hash and physical numbers, as text.
#pragma once

#include <string>
#include <vector>

namespace gem::regression {

/// One number of a row, as the table shows it. The column's name carries the unit.
struct Cell {
  std::string column;
  std::string text;
};

/// What a run came to. The first cell is the state hash.
struct Row {
  std::string run;
  std::vector<Cell> cells;
};

/// The folder of the run list and the golden table.
std::string folder();

/// The file of the golden table.
std::string table_path();

/// A whole text file. Throws std::runtime_error if it cannot be read.
std::string text_of(const std::string& path);

/// Rows from CSV: a head line `run,COLUMN,...` and one line a run. Throws std::runtime_error with the line of a fault.
std::vector<Row> parse_table(const std::string& text, const std::string& origin);

/// Rows as CSV. All rows have the same columns.
std::string table_text(const std::vector<Row>& rows);

/// Golden against new numbers, a line for each, with the relative change; empty if every cell has the same text.
std::string difference(const Row& golden, const Row& now);

/// The row of a run; null if there is none.
const Row* row_of(const std::vector<Row>& rows, const std::string& run);

}  // namespace gem::regression
