// Reads floes from CSV and GeoJSON files.
#include "gem/field/floe_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <system_error>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/field/check_outline.h"
#include "gem/scene/problems.h"
#include "gem/scene/schema/schema.h"

namespace gem {
namespace {

[[noreturn]] void refuse(const std::string& where, const std::string& text) {
  throw Error(ExitCode::scene_rejected, where + ": " + text);
}

// Enough for 250,000 floes. A parsed GeoJSON file takes about 20 times its size in memory.
constexpr std::size_t floe_bytes_maximum = std::size_t{64} << 20;
constexpr int json_depth_maximum = 16;

/// The beginning of a field, for a message.
std::string shortened(const std::string& field) { return field.size() <= 60 ? field : field.substr(0, 60) + "..."; }

std::string read_floes_text(const std::string& path) {
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  if (!file.is_open() || std::filesystem::is_directory(path, ignored))
    throw Error(ExitCode::file_system,
                path + ": cannot read the floes (missing, a folder or no permission) check the path");
  std::string text;
  std::array<char, 65536> block{};
  while (text.size() <= floe_bytes_maximum && (file.read(block.data(), block.size()), file.gcount() > 0))
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
  if (text.size() > floe_bytes_maximum)
    refuse(path, "the file is too large (allowed " + std::to_string(floe_bytes_maximum) + " bytes) use fewer floes");
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
    refuse(where, std::string(column) + " \"" + shortened(field) +
                      "\" is not a finite number (a decimal point is needed, no unit) correct it");
  return value;
}

double coordinate_of(double value, const std::string& where) {
  if (!place_range.contains(value))
    refuse(where, "a coordinate is out of range (value " + number_text(value) + ", allowed " +
                      range_text(place_range, "m") + ") give it in m");
  return value;
}

double thickness_of(double value, const std::string& where) {
  if (!(value > 0.0)) refuse(where, "thickness must be positive (it is in m) correct it or leave the column out");
  return value;
}

/// Collects the rows of a CSV file into floes.
class CsvReader {
 public:
  explicit CsvReader(const std::string& path) : path_(path) {}

  std::vector<FloeDef> read(const std::string& text) {
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
    if (columns_ == 0) refuse(path_, "no header line (the file is empty) write floe,x,y or floe,x,y,thickness");
    check_outlines();
    return floes_;
  }

 private:
  std::string where() const { return path_ + ":" + std::to_string(line_); }

  void read_header(std::vector<std::string> fields) {
    if (fields[0].rfind("\xEF\xBB\xBF", 0) == 0) fields[0].erase(0, 3);
    const std::vector<std::string> plain = {"floe", "x", "y"};
    const std::vector<std::string> thick = {"floe", "x", "y", "thickness"};
    if (fields != plain && fields != thick)
      refuse(where(), "unknown header (the columns are floe,x,y or floe,x,y,thickness) correct the first line");
    columns_ = fields.size();
  }

  void read_row(const std::vector<std::string>& fields) {
    if (fields.size() != columns_)
      refuse(where(), std::to_string(fields.size()) + " fields (the header has " + std::to_string(columns_) +
                          ") correct the row");
    if (fields[0].empty()) refuse(where(), "no floe name (the first column is empty) number the floes");
    if (floes_.empty() || fields[0] != name_) start(fields[0]);
    const double x = coordinate_of(number_of(fields[1], where(), "x"), where());
    const double y = coordinate_of(number_of(fields[2], where(), "y"), where());
    floes_.back().outline_m.push_back({x, y});
    if (columns_ == 4) set_thickness(thickness_of(number_of(fields[3], where(), "thickness"), where()));
  }

  void start(const std::string& name) {
    if (!names_.insert(name).second)
      refuse(where(), "floe " + shortened(name) +
                          " comes a second time (the rows of a floe must be together) rename or move it");
    name_ = name;
    places_.push_back(where() + ": floe " + shortened(name));
    floes_.emplace_back();
    floes_.back().thickness_m = 0.0;
  }

  void set_thickness(double thickness) {
    FloeDef& floe = floes_.back();
    if (floe.outline_m.size() > 1 && floe.thickness_m != thickness)
      refuse(where(),
             "thickness differs from the rows above (floe " + shortened(name_) + " has one thickness) make them equal");
    floe.thickness_m = thickness;
  }

  /// Called after all rows: if the rows of floes are interleaved, the rows are wrong, not the outlines.
  void check_outlines() const {
    for (std::size_t i = 0; i < floes_.size(); ++i) check_outline(floes_[i].outline_m, places_[i]);
  }

  std::string path_;
  std::size_t line_ = 0;
  std::size_t columns_ = 0;
  std::string name_;
  std::set<std::string> names_;
  std::vector<FloeDef> floes_;
  std::vector<std::string> places_;  // of each floe, for messages
};

using Json = nlohmann::json;

Vec2 point_of(const Json& point, const std::string& where) {
  if (!point.is_array() || point.size() < 2 || !point[0].is_number() || !point[1].is_number())
    refuse(where, "a position is not [x, y] (two numbers in m are needed) correct it");
  return {coordinate_of(point[0].get<double>(), where), coordinate_of(point[1].get<double>(), where)};
}

/// Reads a ring, which GeoJSON closes by repeating the first corner; the repeated corner is dropped.
std::vector<Vec2> ring_of(const Json& feature, const std::string& where) {
  const Json geometry = feature.is_object() && feature.contains("geometry") ? feature["geometry"] : Json();
  if (!geometry.is_object() || geometry.value("type", Json()) != "Polygon" || !geometry.contains("coordinates"))
    refuse(where, "not a Polygon (each floe is one polygon) convert or remove it");
  const Json& rings = geometry["coordinates"];
  if (!rings.is_array() || rings.size() != 1 || !rings[0].is_array())
    refuse(where, "not exactly one ring (a floe has no holes) remove the inner rings");
  std::vector<Vec2> outline;
  for (const Json& point : rings[0]) outline.push_back(point_of(point, where));
  if (outline.size() < 2 || outline.front().x != outline.back().x || outline.front().y != outline.back().y)
    refuse(where, "the ring is not closed (the last position repeats the first) close it");
  outline.pop_back();
  return outline;
}

/// A file may have any properties. One whose name looks like thickness must be that, or the ice would get another one.
void check_property_name(const std::string& name, const std::string& where) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool alike = lower.find("thick") != std::string::npos || !nearest_name(lower, {"thickness"}).empty();
  if (name != "thickness" && alike)
    refuse(where, "unknown property \"" + shortened(name) +
                      "\" (the thickness in m is called thickness) did you mean `thickness`?");
}

double feature_thickness(const Json& feature, const std::string& where) {
  if (!feature.contains("properties") || !feature["properties"].is_object()) return 0.0;
  const Json& properties = feature["properties"];
  for (const auto& property : properties.items()) check_property_name(property.key(), where);
  if (!properties.contains("thickness")) return 0.0;
  if (!properties["thickness"].is_number()) refuse(where, "thickness is not a number (it is in m) correct it");
  return thickness_of(properties["thickness"].get<double>(), where);
}

std::vector<FloeDef> read_geojson(const std::string& path, const std::string& text) {
  Json json;
  try {
    json = Json::parse(text, [&path](int depth, Json::parse_event_t, const Json&) {
      if (depth > json_depth_maximum)
        refuse(path, "values are nested too deep (allowed " + std::to_string(json_depth_maximum) + " levels)");
      return true;
    });
  } catch (const Json::exception& fault) {
    std::string why = fault.what();
    for (char& c : why)
      if (c == '\n') c = ' ';
    refuse(path, "not valid JSON (" + why.substr(0, 300) + ") correct the file");
  }
  if (!json.is_object() || json.value("type", Json()) != "FeatureCollection" || !json.contains("features") ||
      !json["features"].is_array())
    refuse(path, "not a FeatureCollection (floes are Polygon features) export it as one");
  std::vector<FloeDef> floes;
  for (const Json& feature : json["features"]) {
    const std::string where = path + ": feature " + std::to_string(floes.size());
    FloeDef floe;
    floe.outline_m = ring_of(feature, where);
    floe.thickness_m = feature_thickness(feature, where);
    check_outline(floe.outline_m, where);
    floes.push_back(floe);
  }
  return floes;
}

bool ends_with(const std::string& path, const std::string& ending) {
  return path.size() >= ending.size() && path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace

std::vector<FloeDef> read_floe_file(const std::string& path) {
  std::vector<FloeDef> floes;
  if (ends_with(path, ".csv")) {
    floes = CsvReader(path).read(read_floes_text(path));
  } else if (ends_with(path, ".geojson")) {
    floes = read_geojson(path, read_floes_text(path));
  } else {
    refuse(path, "unknown kind of floe file (allowed are .csv, .geojson and run files) convert it");
  }
  if (floes.empty())
    refuse(path, "no floes (the file has no rows after the header) add some or set floes.source = \"listed\"");
  return floes;
}

}  // namespace gem
