// Frames of the floes as a packet for the page.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gem/record/run_file/run_file.h"
#include "gem/view/pack/rounding.h"

namespace gem::view {

/// Which frames: `count` of them from `first` on, each `stride` frames after the last.
struct FrameRange {
  std::size_t first = 0;
  std::size_t count = 0;
  std::size_t stride = 1;
};

/// A packet that needs no other to be read. Values are whole numbers of steps. A speed is the difference from the last
/// frame; a place is the difference from where the mean speed since the last frame would have led. Floes that are
/// retired, or whose place is no number, have no values. `first`: number of the first frame on the page.
std::string pack_frames(const std::vector<FrameView>& frames, std::size_t first, std::size_t floes,
                        const Rounding& rounding);

/// The same for frames of a file. Throws Error(file_system) if the file cannot be read.
std::string pack_frames(const RunFile& file, const FrameRange& range, const Rounding& rounding);

}  // namespace gem::view
