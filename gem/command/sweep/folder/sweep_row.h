// What is known of one run of a sweep.
#pragma once

#include <cstdint>
#include <string>

#include "gem/scene/sweep/sweep.h"

namespace gem {

/// One run of a sweep as the manifest lists it.
struct SweepRow {
  std::int64_t index = 0;  // from 1, in the order of the sweep file
  std::string name;
  std::string case_sha256;
  std::string status = "missing";  // done | running | stopped | failed | other | missing
  std::string state_hash;
  std::string engine;
  double duration_s = 0.0;   // requested
  double time_s = 0.0;       // simulated
  double wall_time_s = 0.0;  // wall time of the run
  std::string error;         // why it is not done; empty if unknown
  std::string verdict;       // good | doubtful | bad | not judged; empty: no file
  SweepDraw draw = {};       // what was drawn for it
  std::string doubts = {};   // the criteria that gave a doubtful or bad verdict: "overlap, unfinished_steps"
};

}  // namespace gem
