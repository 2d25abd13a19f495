// Values as TOML text, in any locale: the shortest digits that read back to the same bits.
#pragma once

#include <string>
#include <vector>

#include "gem/base/vec2.h"

namespace gem {

/// A TOML float: always with a point or an exponent.
std::string toml_number_text(double value);

/// A number for people: the shortest digits, whole numbers without ".0".
std::string plain_number_text(double value);

/// "[x, y]".
std::string pair_text(Vec2 value);

/// "[[x, y], ...]".
std::string outline_text(const std::vector<Vec2>& outline);

/// "[[a, b, ...], ...]".
std::string rows_text(const std::vector<std::vector<double>>& rows);

/// A TOML basic string: quoted, with control characters escaped.
std::string quoted_text(const std::string& text);

}  // namespace gem
