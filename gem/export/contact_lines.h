// The forces between bodies as lines.
#pragma once

#include <vector>

#include "gem/export/floe_record.h"
#include "gem/export/platform_track.h"
#include "gem/export/poly_data.h"
#include "gem/record/run_file/contact_record.h"

namespace gem {

/// Number of a body as exports name it: floes from 0 as in /shape and /floes, -1 the platform, -2, -3, ... the fixed
/// bodies in the order of /boundary.
constexpr double exported_body(double body, double first_floe) {
  return body >= first_floe ? body - first_floe : -1.0 - body;
}

/// A line for each force at `time_s` [s], from the centroid of one body over the point of contact to the centroid of
/// the other; it begins at the point where the first is a fixed body. Cell data: floe_a, floe_b, force on floe_b [N],
/// force_size [N]. `floes` are those of the frame. Throws Error(file_system) if the file is damaged.
PolyData contact_lines(const ContactRecord& record, const std::vector<FrameFloe>& floes, const PlatformTrack& platform,
                       double time_s);

}  // namespace gem
