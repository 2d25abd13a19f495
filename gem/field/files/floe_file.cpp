// Reads floes from files: CSV here, GeoJSON in floe_geojson.cpp.
#include "gem/field/files/floe_file.h"

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <system_error>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/field/files/floe_geojson.h"
#include "gem/field/files/floe_values.h"

namespace gem {
namespace {

// Enough for 250,000 floes. A parsed GeoJSON file takes about 20 times its size in memory.
constexpr std::size_t floe_bytes_maximum = std::size_t{64} << 20;

std::string read_floes_text(const std::string& path) {
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  if (!file.is_open() || std::filesystem::is_directory(path, ignored))
    throw Error(ExitCode::file_system,
                path + ": cannot read the floes (missing, a folder or no permission); check the path");
  std::string text;
  std::array<char, 65536> block{};
  while (text.size() <= floe_bytes_maximum && (file.read(block.data(), block.size()), file.gcount() > 0))
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
  if (text.size() > floe_bytes_maximum)
    refuse_floe(path,
                "the file is too large (allowed " + std::to_string(floe_bytes_maximum) + " bytes); use fewer floes");
  return text;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else if (c != ' ' && c != '\t' && c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

double number_of(const std::string& field, const std::string& where, const char* column) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
    refuse_floe(where, std::string(column) + " \"" + shortened(field) +
                           "\" is not a finite number (a decimal point is needed, no unit); correct it");
  return value;
}

/// Collects the rows of a CSV file into floes.
class CsvReader {
 public:
  explicit CsvReader(const std::string& path) : path_(path) {}

  std::vector<FoundFloe> read(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    while (std::getline(lines, line)) {
      ++line_;
      const std::vector<std::string> fields = split(line);
      if (fields.size() == 1 && fields[0].empty()) continue;
      if (columns_ == 0) {
        read_header(fields);
      } else {
        read_row(fields);
      }
    }
    if (columns_ == 0) refuse_floe(path_, "no header line (the file is empty); write floe,x,y or floe,x,y,thickness");
    return floes_;
  }

 private:
  std::string where() const { return path_ + ":" + std::to_string(line_); }

  void read_header(std::vector<std::string> fields) {
    if (fields[0].rfind("\xEF\xBB\xBF", 0) == 0) fields[0].erase(0, 3);
    const std::vector<std::string> plain = {"floe", "x", "y"};
    const std::vector<std::string> thick = {"floe", "x", "y", "thickness"};
    if (fields != plain && fields != thick)
      refuse_floe(where(), "unknown header (the columns are floe,x,y or floe,x,y,thickness); correct the first line");
    columns_ = fields.size();
  }

  void read_row(const std::vector<std::string>& fields) {
    if (fields.size() != columns_)
      refuse_floe(where(), std::to_string(fields.size()) + " fields (the header has " + std::to_string(columns_) +
                               "); correct the row");
    if (fields[0].empty()) refuse_floe(where(), "no floe name (the first column is empty); number the floes");
    if (floes_.empty() || fields[0] != name_) start(fields[0]);
    const double x = coordinate_of(number_of(fields[1], where(), "x"), where());
    const double y = coordinate_of(number_of(fields[2], where(), "y"), where());
    floes_.back().floe.outline_m.push_back({x, y});
    if (columns_ == 4) set_thickness(thickness_of(number_of(fields[3], where(), "thickness"), where()));
  }

  void start(const std::string& name) {
    if (!names_.insert(name).second)
      refuse_floe(where(), "floe " + shortened(name) +
                               " comes a second time (the rows of a floe must be together); rename or move it");
    name_ = name;
    floes_.push_back({{}, where() + ": floe " + shortened(name)});
    floes_.back().floe.thickness_m = 0.0;
  }

  void set_thickness(double thickness) {
    FloeDef& floe = floes_.back().floe;
    if (floe.outline_m.size() > 1 && floe.thickness_m != thickness)
      refuse_floe(where(), "thickness differs from the rows above (floe " + shortened(name_) +
                               " has one thickness); make them equal");
    floe.thickness_m = thickness;
  }

  std::string path_;
  std::size_t line_ = 0;
  std::size_t columns_ = 0;
  std::string name_;
  std::set<std::string> names_;
  std::vector<FoundFloe> floes_;
};

bool ends_with(const std::string& path, const std::string& ending) {
  return path.size() >= ending.size() && path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace

ReadFloes read_floe_file(const std::string& path, ConcaveFloes concave) {
  std::vector<FoundFloe> floes;
  if (ends_with(path, ".csv")) {
    floes = CsvReader(path).read(read_floes_text(path));
  } else if (ends_with(path, ".geojson")) {
    floes = floes_of_geojson(path, read_floes_text(path));
  } else {
    refuse_floe(path, "unknown kind of floe file (allowed are .csv, .geojson and run files); convert it");
  }
  if (floes.empty())
    refuse_floe(path, "no floes (the file has no rows after the header); add some or set floes.source = \"listed\"");
  return convex_floes(floes, concave);
}

std::string concave_floes_text(const SceneDef& scene) {
  const FloesDef& floes = scene.floes;
  if (floes.source != FloeSource::file || floes.concave == ConcaveFloes::refuse) return "";
  return concave_text(read_floe_file(floes.path, floes.concave), floes.concave);
}

std::string concave_text(const ReadFloes& read, ConcaveFloes concave) {
  if (read.changed == 0) return "";
  const std::string count = std::to_string(read.changed) + (read.changed == 1 ? " outline" : " outlines");
  if (concave == ConcaveFloes::cut)
    return count + " cut into " + std::to_string(read.made) + " convex floes, which are not bonded to each other";
  return count + " replaced by the convex hull, which adds " + number_text(read.area_added, 4) + " m2 of ice";
}

}  // namespace gem
