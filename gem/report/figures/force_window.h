// Which part of a record the report shows at full resolution.
#pragma once

#include "gem/report/run/run_data.h"

namespace gem {

struct TimeWindow {
  double from;
  double to;
};

/// A window of `length_s` inside the platform's record, which must not be empty: around run.at_s if a time was chosen;
/// else where most impacts begin and, among equals, the ice force is largest; without impacts around the largest ice
/// force. Shorter only if the record is.
TimeWindow force_window(const RunData& run, double length_s);

}  // namespace gem
