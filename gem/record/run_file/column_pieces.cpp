// Chooses how many rows to read at a time.
#include "gem/record/run_file/column_pieces.h"

#include <algorithm>
#include <optional>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

constexpr std::size_t piece_values = std::size_t{1} << 20;  // 8 MB
constexpr std::size_t chunk_rows = 1024;                    // the longest chunk of a run file: none is read twice

[[noreturn]] void refuse(const RunFile& file, const std::string& why) {
  throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (" + why + "); the file may be damaged");
}

}  // namespace

void for_each_piece(const RunFile& file, const std::vector<std::string>& datasets,
                    const std::function<void(const ColumnPiece&)>& visit) {
  std::size_t rows = 0, width = 0;
  for (const std::string& dataset : datasets) {
    const std::vector<std::size_t> shape = file.shape(dataset);
    if (width > 0 && shape[0] != rows)
      refuse(file, dataset + " has " + std::to_string(shape[0]) + " rows, " + datasets.front() + " has " +
                       std::to_string(rows));
    rows = shape[0];
    width += shape.size() > 1 ? std::max<std::size_t>(shape[1], 1) : 1;
  }
  if (width == 0) return;
  const std::size_t fitting = std::max<std::size_t>(piece_values / width, 1);
  const std::size_t most = fitting > chunk_rows ? fitting - fitting % chunk_rows : fitting;
  ColumnPiece piece;
  for (; piece.first < rows; piece.first += piece.rows) {
    piece.rows = std::min(most, rows - piece.first);
    piece.values.clear();
    for (const std::string& dataset : datasets)
      piece.values.push_back(file.column_rows(dataset, piece.first, piece.rows));
    visit(piece);
  }
}

double largest_value(const RunFile& file, const std::string& dataset) {
  std::optional<double> largest;
  if (!file.has(dataset)) return 0.0;
  for_each_piece(file, {dataset}, [&](const ColumnPiece& piece) {
    for (const double value : piece.values[0]) largest = std::max(largest.value_or(value), value);
  });
  return largest.value_or(0.0);
}

double last_value(const RunFile& file, const std::string& dataset) {
  const std::size_t rows = file.has(dataset) ? file.rows(dataset) : 0;
  if (rows == 0) return 0.0;
  const std::vector<double> row = file.column_rows(dataset, rows - 1, 1);
  if (row.empty()) refuse(file, dataset + " has rows without values");
  return row.front();
}

OverlapCount overlaps_of(const RunFile& file, const std::string& dataset) {
  OverlapCount sum;
  if (!file.has(dataset)) return sum;
  constexpr double count_maximum = 9007199254740992.0;  // whole numbers up to this are exact
  for_each_piece(file, {dataset}, [&](const ColumnPiece& piece) {
    const std::vector<double>& values = piece.values[0];
    const std::size_t first = piece.first * (values.size() / piece.rows);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!(values[i] >= 0.0 && values[i] <= count_maximum)) refuse(file, dataset + " holds a value that is no count");
      sum.count[(first + i) % OverlapCount::classes] += static_cast<std::int64_t>(values[i]);
    }
  });
  return sum;
}

}  // namespace gem
