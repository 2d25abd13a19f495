// The elastic catenary of a mooring line, with or without a part on a level seabed.
//
//   V < w L   x = L - V / w + (H / w) asinh(V / H) + H L / EA,   z = (T - H) / w + V^2 / (2 EA w)
//   V >= w L  x = (H / w) (asinh(V / H) - asinh(Va / H)) + H L / EA,   z = (T - Ta) / w + (V L - w L^2 / 2) / EA
//
//   x, z  from the anchor to the fairlead: distance and height [m]     L   length without load [m]
//   H     horizontal tension [N]                                       w   weight in water over length [N/m]
//   V     vertical tension at the fairlead [N]                         EA  axial stiffness [N]
//   T     tension at the fairlead, sqrt(H^2 + V^2) [N]                 Va  V - w L, at the anchor; Ta likewise [N]
//
// Of the height, V follows for every H by Newton's method, kept between bounds; z rises with V. Then x rises with H, so
// the force over the distance is a table without a search over x. At H = 0 the line hangs straight down from the
// fairlead: at any smaller distance it is slack.
//
// Source: H. M. Irvine, Cable Structures, MIT Press, 1981; J. M. Jonkman, Dynamics Modeling and Loads Analysis of an
// Offshore Floating Wind Turbine, NREL/TP-500-41958, 2007, section 2.6, here without friction of the seabed.
// Range: static lines of one material, longer than the height. Neglected: current on the line, bending, clumps, buoys.
#pragma once

#include <vector>

#include "gem/events/platform/force_curve.h"

namespace gem {

struct LineProperties {
  double length = 0.0, weight = 0.0, stiffness = 0.0;  // L [m], w [N/m], EA [N]
  double height = 0.0;                                 // z [m]
};

/// Where a line with these tensions at its fairlead reaches to, with the derivatives.
struct LineShape {
  double x = 0.0, z = 0.0;            // [m]
  double x_of_h = 0.0, z_of_h = 0.0;  // over H [m/N]; z over H is x over V
  double z_of_v = 0.0;                // over V [m/N]
};

/// The closed form. `h` > 0.
LineShape line_shape(const LineProperties& line, double h, double v);

/// V at horizontal tension `h` >= 0 [N].
double vertical_tension(const LineProperties& line, double h);

/// Horizontal tension and tension at the fairlead over the distance, up to a horizontal tension of at least `most` [N].
/// Between the samples the smooth curve is off by less than 1e-6 of the tension. Beyond
/// them, where the line is taut and stretched by 5 %, the last slope is off by 1e-3 at three times the tension.
std::vector<CurveSample> line_samples(const LineProperties& line, double most);

}  // namespace gem
