// A whole run file as packets for the page.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "gem/record/run_file/run_file.h"
#include "gem/view/pack/pack_frames.h"
#include "gem/view/pack/pack_rows.h"

namespace gem::view {

/// A page holds at most so many places of floes, else every second, third, ... frame.
inline constexpr std::size_t places_maximum = 6'000'000;
/// A page holds at most so many rows of the platform, else the largest of every 2, 3, ... rows.
inline constexpr std::size_t platform_rows_maximum = 72'000;
/// A page holds at most so many forces between bodies, else only the largest of each frame.
inline constexpr std::size_t contacts_maximum = 300'000;

/// How a run is thinned out and rounded for its page. It depends on the case alone, so it stays while a run grows.
struct PagePlan {
  Rounding rounding;
  std::size_t frame_stride = 1;                      ///< every so many-th frame
  std::size_t contacts_of_frame = contacts_maximum;  ///< the largest forces between bodies of each frame
  std::size_t platform_bucket = 1;                   ///< the row with the largest ice load of so many
};
PagePlan plan_for(const RunFile& file);

/// What the page must know before the numbers: name, status, origin, verdict, bodies that do not move, moorings.
/// Throws Error(file_system) if the file is damaged.
nlohmann::ordered_json describe_run(const RunFile& file, const PagePlan& plan);

/// Outlines, thickness, area, mass and class of the floes. Outlines are kept to a tenth of a step of a place.
std::string pack_shapes(const RunFile& file, const PagePlan& plan);

/// The frames that a page holds, from the page's frame `first` on, in packets of some megabytes before compression.
std::vector<FrameRange> frame_ranges(const RunFile& file, const PagePlan& plan, std::size_t first = 0);

/// The rows that a page holds of a group, from row `first` of the file on.
RowChoice rows_for_page(const std::string& group, const PagePlan& plan, std::size_t first = 0);

/// All packets of a page: shapes, first frames, rows, other frames, forces between bodies.
std::vector<std::string> pack_run(const RunFile& file, const PagePlan& plan);

}  // namespace gem::view
