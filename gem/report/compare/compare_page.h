// The page of a comparison.
#pragma once

#include <string>

#include "gem/report/compare/comparison.h"

namespace gem {

/// Writes out_dir/index.html with its figures in out_dir/figures. Throws Error(file_system) if gnuplot is missing or
/// something cannot be written, Error(usage) if the folder holds another page.
void write_comparison(const Comparison& comparison, const std::string& out_dir);

/// A number of a comparison with its unit, for tables: "12.3 kN", with its interval in brackets.
std::string cell_text(const ComparedRow& row, const ComparedCell& cell);

}  // namespace gem
