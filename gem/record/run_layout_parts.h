// What creating and reopening a run file share.
#pragma once

#include <map>
#include <string>

#include "gem/record/column_file.h"

namespace gem {

/// Now, as YYYY-MM-DDThh:mm:ssZ.
std::string utc_now();

/// Path of a column in the file.
inline std::string path_of(const Column& column) { return "/" + column.group + "/" + column.name; }

/// Times of the floe frames.
Column floe_time_column();

/// Lengths of the dimensions that do not grow.
std::map<std::string, hsize_t> sizes_of(const SceneDef& scene, const Bodies& bodies);

}  // namespace gem
