// Reads floes from files: outlines traced from a photograph or made by another program.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/scene_def.h"

namespace gem {

/// Reads .csv (header `floe,x,y` or `floe,x,y,thickness`; one row per corner in m; the rows of a floe together; the
/// first corner not repeated) or .geojson (FeatureCollection of Polygon features without holes; coordinates in m;
/// optional property `thickness`). Outlines are in world coordinates, in either direction. A floe without thickness
/// gets thickness_m = 0, and the ice classes decide. Throws Error(file_system) if the file cannot be read, and
/// Error(scene_rejected) with file and line or feature for any error in it or if it has no floes.
std::vector<FloeDef> read_floe_file(const std::string& path);

}  // namespace gem
