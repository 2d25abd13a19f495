// Numbers for display, independent of the locale.
#pragma once

#include <string>

namespace gem {

/// `value` with `digits` significant digits and no exponent between 1e-4 and 1e7; "-" if it is not finite.
std::string rounded_text(double value, int digits = 3);

/// `value` with `decimals` digits after the point.
std::string decimal_text(double value, int decimals);

/// Two digits and a power of ten, for residuals: "3.1e-14".
std::string exponent_text(double value);

/// A unit in which the numbers of one figure lie between about 1 and 1000.
struct Unit {
  std::string name;
  double size = 1.0;  // SI value of the unit; divide by it
};
Unit length_unit(double largest);   // m or mm
Unit force_unit(double largest);    // N, kN or MN
Unit impulse_unit(double largest);  // N s, kN s or MN s
Unit time_unit(double duration_s);  // s, or h from one hour on

/// "1.3 h" or "90 s", with up to four digits.
std::string time_text(double time_s);

/// "12.3 kN": the value in the given unit.
std::string with_unit(double value, const Unit& unit, int digits = 3);

}  // namespace gem
