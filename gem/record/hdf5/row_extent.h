// How many rows of a growing dataset really stand in a file. Included by gem/record only.
#pragma once

#include <cstdint>
#include <string>

#include "gem/record/hdf5/hdf5_handle.h"

namespace gem::hdf5 {

/// Chunks at the end of a column that a repair looks at. Chunks that are written at the same time may stand in any
/// order, so the end of a cut file may lie between them. More than a flush ever writes, chosen by hand. The library
/// counts through all chunks to find one.
inline constexpr std::uint64_t repaired_chunks = 256;

/// Rows along the first dimension whose chunks all stand in the file, which has `file_size` bytes: fewer than the
/// length of the dataset if the file was cut, or if a killed program wrote the length before the rows. The last
/// `checked_chunks` chunks of these rows were looked at. Throws Failure.
std::uint64_t rows_on_disk(hid_t dataset, std::uint64_t file_size, std::uint64_t checked_chunks = 1);

/// Rows of a column of increasing times, without zeros at its end. Throws Failure.
std::uint64_t rows_in_time(hid_t dataset, std::uint64_t rows);

/// Rows that all datasets of a group with rows hold, at most those of its times. 0 if there is no such group; what is
/// no dataset is left out.
std::uint64_t rows_of_group(hid_t file, const std::string& group, std::uint64_t file_size,
                            std::uint64_t checked_chunks = 1);

}  // namespace gem::hdf5
