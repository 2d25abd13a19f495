// The forces between bodies as a packet for the page.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gem/record/run_file/contact_record.h"
#include "gem/view/pack/pack_frames.h"

namespace gem::view {

/// The forces of one frame, and the centroids of the bodies that they act on: `place` by body, 0, 0 for what is no
/// floe.
struct FrameForces {
  std::vector<ContactForce> contacts;
  std::vector<Vec2> place;
};

/// A packet of forces: of each frame the `most` largest, with their points about the centroid of body b to 0.1 m, and
/// the force to 1/2000 of the largest of its frame. `first`: number of the first frame on the page.
std::string pack_contacts(std::vector<FrameForces> frames, std::size_t first, std::size_t most);

/// The same for frames of a file that holds forces. Throws Error(file_system) if the file cannot be read.
std::string pack_contacts(const RunFile& file, const FrameRange& range, std::size_t most);

}  // namespace gem::view
