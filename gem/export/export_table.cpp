// A group of a run file as a CSV file.
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "gem/base/error.h"
#include "gem/export/contact_lines.h"
#include "gem/export/export_output.h"
#include "gem/export/export_run.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/record/schema.h"

namespace gem {
namespace {

struct TableColumn {
  std::string header;
  Stored stored;
  std::vector<double> values;
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

std::vector<Column> columns_of(const std::string& table) {
  if (table == "platform") return columns_of(platform_columns());
  if (table == "events") return columns_of(event_columns());
  if (table == "contacts") return columns_of(contact_columns());
  std::vector<Column> columns = columns_of(stats_columns());
  for (const Column& column : columns_of(crack_columns())) columns.push_back(column);
  return columns;
}

/// Body numbers become those of floes, as on the page of gem view.
void number_floes(const RunFile& file, const std::string& table, TableColumn& column) {
  if (column.header != "body_a" && column.header != "body_b") return;
  column.header = table == "events" ? "floe" : column.header == "body_a" ? "floe_a" : "floe_b";
  const double first = file.number_attribute("gem_first_floe_body");
  for (double& body : column.values) body = exported_body(body, first);
}

/// Columns of lines and thrusters: one with a value for each gives a column for each, numbered from 0 as in the case.
void add_parts(const RunFile& file, std::vector<TableColumn>& columns) {
  if (columns.empty()) return;
  const std::size_t rows = columns.front().values.size();
  for (const PartColumn& part : part_columns(stored_scene(file))) {
    const std::string dataset = part.column.group + "/" + part.column.name;
    if (!file.has(dataset)) continue;
    const std::vector<double> all = file.column(dataset);
    const std::size_t parts = rows == 0 ? 0 : all.size() / rows;
    if (parts * rows != all.size())
      throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (" + dataset +
                                             " does not fit the columns beside it) the file may be damaged");
    const bool several = part.column.dimensions.find(' ') != std::string::npos;
    for (std::size_t k = 0; k < parts; ++k) {
      const std::string number = several ? "_" + std::to_string(k) : "";
      columns.push_back({part.column.name + number + unit_suffix(part.column.units), part.column.stored, {}});
      for (std::size_t row = 0; row < rows; ++row) columns.back().values.push_back(all[row * parts + k]);
    }
  }
}

/// The columns of the schema that the file has; an older file has fewer.
std::vector<TableColumn> read_table(const RunFile& file, const std::string& table) {
  std::vector<TableColumn> columns;
  for (const Column& column : columns_of(table)) {
    const std::string dataset = column.group + "/" + column.name;
    if (!file.has(dataset)) continue;
    if (dataset == "events/body_a") continue;  // always the platform
    columns.push_back({column.name + unit_suffix(column.units), column.stored, file.column(dataset)});
    number_floes(file, table, columns.back());
    if (columns.back().values.size() != columns.front().values.size())
      throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (" + dataset +
                                             " is not as long as the columns beside it) the file may be damaged");
  }
  if (table == "platform") add_parts(file, columns);
  if (columns.empty())
    throw Error(ExitCode::usage, shown(file.path()) + ": no " + table +
                                     " (the run did not record them) choose another "
                                     "--table");
  return columns;
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

void write_rows(std::ostream& out, const std::vector<TableColumn>& columns) {
  for (std::size_t c = 0; c < columns.size(); ++c) out << (c > 0 ? "," : "") << columns[c].header;
  out << '\n';
  for (std::size_t row = 0; row < columns.front().values.size(); ++row) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      out << (c > 0 ? "," : "") << cell_text(columns[c].values[row], columns[c].stored);
    out << '\n';
  }
}

}  // namespace

ExportReport export_table(const ExportTarget& target, const std::string& table) {
  check_output_path(target.output, target.overwrite);
  const RunFile file(target.run_file, target.allow_incomplete);
  const std::vector<TableColumn> columns = read_table(file, table);
  write_export(target.output, [&](std::ostream& out) { write_rows(out, columns); });
  return shown(target.output) + ": " + table + ", " + std::to_string(columns.size()) + " columns, " +
         std::to_string(columns.front().values.size()) + " rows\n";
}

}  // namespace gem
