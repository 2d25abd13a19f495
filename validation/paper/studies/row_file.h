// Files of rows that study programs write for the page.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "gem/base/error.h"
#include "gem/base/number_text.h"

namespace gem {

/// Reads a file of comma-separated rows one by one. A mistake throws Error(file_system) with file and line, and with
/// the script that writes the file.
class RowFile {
 public:
  RowFile(const std::filesystem::path& path, const std::string& maker)
      : path_(path.string()), maker_(maker), file_(path) {
    if (!file_) throw fault("it does not open");
  }
  /// The fields of the next row; false at the end.
  bool next(std::vector<std::string>& fields) {
    std::string line;
    if (!std::getline(file_, line)) return false;
    ++line_;
    fields.clear();
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    return true;
  }
  Error fault(const std::string& why) const {
    return Error(ExitCode::file_system, "cannot read " + path_ + " (" + why + " in line " + std::to_string(line_) +
                                            "); make it again by " + maker_);
  }
  double number(const std::string& field) const {
    const auto value = parse_number(field);
    if (!value || !std::isfinite(*value)) throw fault("'" + field + "' is no number");
    return *value;
  }

 private:
  std::string path_, maker_;
  std::ifstream file_;
  int line_ = 0;
};

}  // namespace gem
