// A group of a run file as a CSV file.
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>

#include "gem/base/error.h"
#include "gem/export/contact_lines.h"
#include "gem/export/export_output.h"
#include "gem/export/export_run.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/column_pieces.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/record/schema.h"

namespace gem {
namespace {

/// A column of the table: values `part`, `part + width`, ... of a dataset with `width` values in each row.
struct TableColumn {
  std::string header;
  Stored stored;
  std::size_t dataset;  // index in Table::datasets
  std::size_t part = 0, width = 1;
  std::optional<double> first_floe = {};  // of body numbers, which become those of floes
};

struct Table {
  std::vector<std::string> datasets;
  std::vector<TableColumn> columns;
};

/// "m s-1" as "_m_per_s"; nothing for a number without unit.
std::string unit_suffix(const std::string& units) {
  if (units == "1") return "";
  std::istringstream words(units);
  std::string suffix;
  for (std::string word; words >> word;) {
    const bool below = word.find('-') != std::string::npos;
    suffix += below ? "_per_" + word.substr(0, word.find('-')) : "_" + word;
  }
  return suffix;
}

template <class Row>
std::vector<Column> columns_of(const std::vector<RowColumn<Row>>& rows) {
  std::vector<Column> columns;
  for (const RowColumn<Row>& row : rows) columns.push_back(row.column);
  return columns;
}

std::vector<Column> joined(std::vector<Column> columns, const std::vector<Column>& more) {
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

std::vector<Column> columns_of(const std::string& table) {
  if (table == "platform") return columns_of(platform_columns());
  if (table == "events") return joined(columns_of(event_columns()), columns_of(compliant_event_columns()));
  if (table == "contacts") return columns_of(contact_columns());
  return joined(joined(columns_of(stats_columns()), columns_of(crack_columns())),
                columns_of(compliant_stats_columns()));
}

/// Body numbers become those of floes, as on the page of gem view.
void number_floes(const RunFile& file, const std::string& table, TableColumn& column) {
  if (column.header != "body_a" && column.header != "body_b") return;
  column.header = table == "events" ? "floe" : column.header == "body_a" ? "floe_a" : "floe_b";
  column.first_floe = file.number_attribute("gem_first_floe_body");
}

/// Columns of lines and thrusters: one with a value for each gives a column for each, numbered from 0 as in the case.
void add_parts(const RunFile& file, Table& table) {
  for (const PartColumn& part : part_columns(stored_scene(file))) {
    const std::string dataset = part.column.group + "/" + part.column.name;
    if (!file.has(dataset)) continue;
    const std::vector<std::size_t> shape = file.shape(dataset);
    const std::size_t parts = shape.size() > 1 ? shape[1] : 1;
    const bool several = part.column.dimensions.find(' ') != std::string::npos;
    for (std::size_t k = 0; k < parts; ++k) {
      const std::string number = several ? "_" + std::to_string(k) : "";
      table.columns.push_back({part.column.name + number + unit_suffix(part.column.units), part.column.stored,
                               table.datasets.size(), k, parts});
    }
    table.datasets.push_back(dataset);
  }
}

/// The columns of the schema that the file has; an older file has fewer.
Table table_of(const RunFile& file, const std::string& name) {
  Table table;
  for (const Column& column : columns_of(name)) {
    const std::string dataset = column.group + "/" + column.name;
    if (!file.has(dataset)) continue;
    if (dataset == "events/body_a") continue;  // always the platform
    table.columns.push_back({column.name + unit_suffix(column.units), column.stored, table.datasets.size()});
    number_floes(file, name, table.columns.back());
    table.datasets.push_back(dataset);
  }
  if (name == "platform" && !table.columns.empty()) add_parts(file, table);
  if (table.columns.empty())
    throw Error(ExitCode::usage, shown(file.path()) + ": no " + name +
                                     " (the run did not record them); choose another "
                                     "--table");
  return table;
}

/// Shortest text that reads back as the stored number.
std::string cell_text(double value, Stored stored) {
  if (!std::isfinite(value)) return "";
  std::array<char, 40> text{};
  char* last = text.data() + text.size();
  const auto end = stored == Stored::f4 ? std::to_chars(text.data(), last, static_cast<float>(value)).ptr
                                        : std::to_chars(text.data(), last, value).ptr;
  return {text.data(), end};
}

void check_widths(const RunFile& file, const Table& table, const ColumnPiece& piece) {
  for (const TableColumn& column : table.columns)
    if (piece.values[column.dataset].size() != piece.rows * column.width)
      throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (" + table.datasets[column.dataset] +
                                             " does not fit the columns beside it); the file may be damaged");
}

void write_rows(std::ostream& out, const RunFile& file, const Table& table) {
  for (std::size_t c = 0; c < table.columns.size(); ++c) out << (c > 0 ? "," : "") << table.columns[c].header;
  out << '\n';
  for_each_piece(file, table.datasets, [&](const ColumnPiece& piece) {
    check_widths(file, table, piece);
    for (std::size_t row = 0; row < piece.rows; ++row) {
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const TableColumn& column = table.columns[c];
        const double value = piece.values[column.dataset][row * column.width + column.part];
        out << (c > 0 ? "," : "")
            << cell_text(column.first_floe ? exported_body(value, *column.first_floe) : value, column.stored);
      }
      out << '\n';
    }
  });
}

}  // namespace

ExportReport export_table(const ExportTarget& target, const std::string& table) {
  check_output_path(target.output, target.overwrite);
  const RunFile file(target.run_file, target.allow_incomplete);
  const Table chosen = table_of(file, table);
  write_export(target.output, [&](std::ostream& out) { write_rows(out, file, chosen); });
  return shown(target.output) + ": " + table + ", " + std::to_string(chosen.columns.size()) + " columns, " +
         std::to_string(file.rows(chosen.datasets.front())) + " rows\n";
}

}  // namespace gem
