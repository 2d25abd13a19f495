// A verdict in few words, for tables and messages.
#pragma once

#include <string>

#include "gem/record/verdict.h"

namespace gem {

/// Whether the run is doubted because time steps ended before their contacts had converged. Then the loads of a short
/// time are wrong first.
bool stops_short(const RunVerdict& verdict);

/// What stands behind a load of a short time, " (not converged)", or nothing.
std::string doubt_text(const RunVerdict& verdict);

/// The criteria of one grade, by the names that run files have: "overlap, unfinished_steps".
std::string criteria_of_grade(const RunVerdict& verdict, Grade grade);

/// The criteria that gave a doubtful or bad verdict; empty for another one.
std::string doubts_of(const RunVerdict& verdict);

/// The grade, and after a colon the criteria that gave it: "doubtful: unfinished_steps".
std::string verdict_text(const RunVerdict& verdict);

}  // namespace gem
