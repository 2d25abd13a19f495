// Reads floes from GeoJSON: Polygon and MultiPolygon features.
#include "gem/field/files/floe_geojson.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <utility>

#include "gem/field/files/floe_values.h"
#include "gem/scene/problems.h"

namespace gem {
namespace {

constexpr int json_depth_maximum = 16;

using Json = nlohmann::json;

Vec2 point_of(const Json& point, const std::string& where) {
  if (!point.is_array() || point.size() < 2 || !point[0].is_number() || !point[1].is_number())
    refuse_floe(where, "a position is not [x, y] (two numbers in m are needed); correct it");
  return {coordinate_of(point[0].get<double>(), where), coordinate_of(point[1].get<double>(), where)};
}

/// A ring without its last position, with which GeoJSON repeats the first.
std::vector<Vec2> ring_of(const Json& rings, const std::string& where) {
  if (!rings.is_array() || rings.empty() || !rings[0].is_array())
    refuse_floe(where, "no ring of positions (a polygon is a list of rings); correct it");
  if (rings.size() > 1)
    refuse_floe(where,
                "a hole (" + std::to_string(rings.size() - 1) +
                    " inner ring(s); a floe is one piece of ice without openings); remove the inner rings or cut " +
                    "the polygon through them");
  std::vector<Vec2> outline;
  for (const Json& point : rings[0]) outline.push_back(point_of(point, where));
  if (outline.size() < 2 || outline.front().x != outline.back().x || outline.front().y != outline.back().y)
    refuse_floe(where, "the ring is not closed (the last position repeats the first); close it");
  outline.pop_back();
  return outline;
}

/// The outlines of a feature with their places in the file: one of a Polygon, several of a MultiPolygon.
std::vector<std::pair<std::vector<Vec2>, std::string>> outlines_of(const Json& feature, const std::string& where) {
  const Json geometry = feature.is_object() && feature.contains("geometry") ? feature["geometry"] : Json();
  const Json type = geometry.is_object() ? geometry.value("type", Json()) : Json();
  if ((type != "Polygon" && type != "MultiPolygon") || !geometry.contains("coordinates"))
    refuse_floe(where, "not a Polygon or MultiPolygon (floes are polygons); convert or remove it");
  const Json& coordinates = geometry["coordinates"];
  if (type == "Polygon") return {{ring_of(coordinates, where), where}};
  if (!coordinates.is_array() || coordinates.empty())
    refuse_floe(where, "no polygons (the coordinates of a MultiPolygon are a list of polygons); correct it");
  std::vector<std::pair<std::vector<Vec2>, std::string>> outlines;
  for (const Json& polygon : coordinates) {
    const std::string part = where + ", polygon " + std::to_string(outlines.size());
    outlines.emplace_back(ring_of(polygon, part), part);
  }
  return outlines;
}

/// A file may have any properties. One whose name looks like thickness must be that, or the ice would get another one.
void check_property_name(const std::string& name, const std::string& where) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool alike = lower.find("thick") != std::string::npos || !nearest_name(lower, {"thickness"}).empty();
  if (name != "thickness" && alike)
    refuse_floe(where, "unknown property \"" + shortened(name) +
                           "\" (the thickness in m is called thickness); did you mean `thickness`?");
}

double feature_thickness(const Json& feature, const std::string& where) {
  if (!feature.contains("properties") || !feature["properties"].is_object()) return 0.0;
  const Json& properties = feature["properties"];
  for (const auto& property : properties.items()) check_property_name(property.key(), where);
  if (!properties.contains("thickness")) return 0.0;
  if (!properties["thickness"].is_number()) refuse_floe(where, "thickness is not a number (it is in m); correct it");
  return thickness_of(properties["thickness"].get<double>(), where);
}

}  // namespace

std::vector<FoundFloe> floes_of_geojson(const std::string& path, const std::string& text) {
  Json json;
  try {
    json = Json::parse(text, [&path](int depth, Json::parse_event_t, const Json&) {
      if (depth > json_depth_maximum)
        refuse_floe(path, "values are nested too deep (allowed " + std::to_string(json_depth_maximum) + " levels)");
      return true;
    });
  } catch (const Json::exception& fault) {
    std::string why = fault.what();
    for (char& c : why)
      if (c == '\n') c = ' ';
    refuse_floe(path, "not valid JSON (" + why.substr(0, 300) + "); correct the file");
  }
  if (!json.is_object() || json.value("type", Json()) != "FeatureCollection" || !json.contains("features") ||
      !json["features"].is_array())
    refuse_floe(path, "not a FeatureCollection (floes are Polygon and MultiPolygon features); export it as one");
  std::vector<FoundFloe> floes;
  std::size_t number = 0;
  for (const Json& feature : json["features"]) {
    const std::string where = path + ": feature " + std::to_string(number++);
    const auto outlines = outlines_of(feature, where);
    FloeDef floe;
    floe.thickness_m = feature_thickness(feature, where);
    for (const auto& [outline, place] : outlines) {
      floe.outline_m = outline;
      floes.push_back({floe, place});
    }
  }
  return floes;
}

}  // namespace gem
