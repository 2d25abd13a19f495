// What another run may begin with: the floes and the platform of a run file, at its start or at a recorded frame.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gem/scene/scene_def.h"

namespace gem {

/// Asks for the last frame of a run file.
inline constexpr double last_frame = std::numeric_limits<double>::infinity();

/// The platform at a time. SI units.
struct PlatformStart {
  Vec2 position;
  double yaw = 0.0;  // within half a turn
  Vec2 velocity;
  double spin = 0.0;
};

/// The floes of a run at one time.
struct FloesStart {
  double time = 0.0;           // of the frame [s]
  std::vector<FloeDef> floes;  // without those that had left
  double overlap = 0.0;        // how deep they may overlap, see below [m]
};

/// The floes of the frame at `time` [s] (0: the start of the run, in full precision; last_frame). The file may be
/// incomplete. Frames are in single precision, and floes in contact overlap in a run. So the floes may overlap by
/// the deepest recorded overlap of the run, what closes in one time step after it was measured, and the rounding of two
/// places, but not by more than a metre. Throws Error(file_system) if there is no such frame.
FloesStart floes_of_run_file(const std::string& path, double time = 0.0);

/// The platform of the run at the same time, from the last sample not after it; empty if the run had none.
std::optional<PlatformStart> platform_of_run_file(const std::string& path, double time);

}  // namespace gem
