// Reads floes from the text of a GeoJSON file.
#pragma once

#include <string>
#include <vector>

#include "gem/field/files/floe_outlines.h"

namespace gem {

/// Every polygon of a FeatureCollection: one of a Polygon feature, several of a MultiPolygon feature, which share the
/// optional property `thickness` [m]. Outlines are not checked. Throws Error(scene_rejected) with the feature for
/// anything else, such as holes. `path` is for messages.
std::vector<FoundFloe> floes_of_geojson(const std::string& path, const std::string& text);

}  // namespace gem
