// The verdict in a run file: attributes of the root.
//
//   gem_verdict                                    the grade of the run
//   gem_verdict_criteria, gem_verdict_grades       one word per criterion, separated by blanks
//   gem_verdict_values, gem_verdict_doubtful_above,
//   gem_verdict_bad_above, gem_verdict_times_s     one number per criterion, then NaN
//   gem_verdict_texts                              one line per criterion
#pragma once

#include "gem/record/hdf5/hdf5_handle.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/verdict.h"

namespace gem {

/// Creates the attributes, empty, with room for any verdict. Throws hdf5::Failure.
void reserve_verdict(hid_t file);

/// Writes the attributes, which reserve_verdict() created. Throws hdf5::Failure.
void write_verdict(hid_t file, const RunVerdict& verdict);

}  // namespace gem
