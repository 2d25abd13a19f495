// What creating and reopening a run file share.
#pragma once

#include <map>
#include <string>

#include "gem/record/hdf5/column_file.h"

namespace gem {

/// Now, as YYYY-MM-DDThh:mm:ssZ.
std::string utc_now();

inline constexpr std::size_t attribute_limit = 60000;  // other readers expect at most 64 kB per attribute

/// Times of the floe frames.
Column floe_time_column();

/// Whether the impulses on the sides of the platform are recorded.
bool records_sides(const SceneDef& scene);

/// Whether a row of the column has a value for each member of a dimension.
bool is_by(const Column& column, const std::string& dimension);

/// Length of a row of a column of part_columns().
hsize_t width_of_part(const Column& column, const std::map<std::string, hsize_t>& size);

/// Lengths of the dimensions that do not grow.
std::map<std::string, hsize_t> sizes_of(const SceneDef& scene, const Bodies& bodies);

}  // namespace gem
