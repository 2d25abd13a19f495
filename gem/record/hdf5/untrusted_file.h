// Looks through an HDF5 file of unknown origin before anything is read from it. Included by gem/record only.
#pragma once

#include "gem/record/hdf5/hdf5_handle.h"

namespace gem::hdf5 {

/// Largest number of values of a dataset that is read whole: 1 GiB in memory.
inline constexpr hsize_t dataset_values_maximum = hsize_t{1} << 27;
/// Largest number of values of all such datasets together.
inline constexpr hsize_t file_values_maximum = hsize_t{1} << 30;
/// Largest size of a text attribute or text dataset [bytes].
inline constexpr std::size_t text_bytes_maximum = std::size_t{16} << 20;

/// Keeps the library from loading filters and drivers from shared libraries. Call it before a file is opened.
void refuse_plugins();

/// Throws Failure if the file could make the library open another file, run foreign code, or use up memory: links that
/// are not hard, data in other files (external, virtual), unknown filters, groups within groups, too many objects,
/// sizes above the limits, or more data than the bytes in the file can hold.
void check_untrusted(hid_t file);

}  // namespace gem::hdf5
