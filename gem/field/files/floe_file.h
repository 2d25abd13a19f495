// Reads floes from files: outlines traced from a photograph or made by another program.
#pragma once

#include <string>

#include "gem/field/files/floe_outlines.h"

namespace gem {

/// Reads .csv (header `floe,x,y` or `floe,x,y,thickness`; one row per corner in m; the rows of a floe together; the
/// first corner not repeated) or .geojson (FeatureCollection of Polygon and MultiPolygon features without holes;
/// coordinates in m; optional property `thickness`). Outlines are in world coordinates, in either direction; those that
/// are not convex are treated as `concave` says. A floe without thickness gets thickness_m = 0, and the ice classes
/// decide. Throws Error(file_system) if the file cannot be read, and Error(scene_rejected) with file and line or
/// feature for any error in it or if it has no floes.
ReadFloes read_floe_file(const std::string& path, ConcaveFloes concave = ConcaveFloes::refuse);

/// What was done to the floes of scene.floes.path that are not convex; empty without such a file.
std::string concave_floes_text(const SceneDef& scene);

/// "3 outlines cut into 8 convex floes, which are not bonded to each other"; empty if all outlines were convex.
std::string concave_text(const ReadFloes& read, ConcaveFloes concave);

}  // namespace gem
