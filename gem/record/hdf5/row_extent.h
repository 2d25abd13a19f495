// How many rows of a growing dataset really stand in a file. Included by gem/record only.
#pragma once

#include <cstdint>
#include <string>

#include "gem/record/hdf5/hdf5_handle.h"

namespace gem::hdf5 {

/// Rows along the first dimension whose chunks all stand in the file, which has `file_size` bytes. Fewer than the
/// length of the dataset if the file was cut, or if a killed program wrote the length before the rows. Throws Failure.
std::uint64_t rows_on_disk(hid_t dataset, std::uint64_t file_size);

/// Rows of a column of increasing times, without zeros at its end. Throws Failure.
std::uint64_t rows_in_time(hid_t dataset, std::uint64_t rows);

/// Rows that all datasets of a group with rows hold, at most those of its times. 0 if there is no such group; what is
/// no dataset is left out.
std::uint64_t rows_of_group(hid_t file, const std::string& group, std::uint64_t file_size);

}  // namespace gem::hdf5
