// Checks of single values of a floe file.
#include "gem/field/files/floe_values.h"

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/scene/schema/schema.h"

namespace gem {

void refuse_floe(const std::string& where, const std::string& text) {
  throw Error(ExitCode::scene_rejected, where + ": " + text);
}

/// The beginning of a field, for a message.
std::string shortened(const std::string& field) { return field.size() <= 60 ? field : field.substr(0, 60) + "..."; }

double coordinate_of(double value, const std::string& where) {
  if (!place_range.contains(value))
    refuse_floe(where, "a coordinate is out of range (value " + number_text(value) + ", allowed " +
                           range_text(place_range, "m") + "); give it in m");
  return value;
}

double thickness_of(double value, const std::string& where) {
  if (!(value > 0.0)) refuse_floe(where, "thickness must be positive (it is in m); correct it or leave the column out");
  return value;
}

}  // namespace gem
