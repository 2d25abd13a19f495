// Checks of single values of a floe file, with messages that say where they stand.
#pragma once

#include <string>

namespace gem {

/// Throws Error(scene_rejected): "where: text".
[[noreturn]] void refuse_floe(const std::string& where, const std::string& text);

/// The beginning of a field, for a message.
std::string shortened(const std::string& field);

/// The value, if it is in the range of places [m] or thicknesses [m]; otherwise throws.
double coordinate_of(double value, const std::string& where);
double thickness_of(double value, const std::string& where);

}  // namespace gem
