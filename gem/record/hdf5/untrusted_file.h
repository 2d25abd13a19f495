// Looks through an HDF5 file of unknown origin before anything is read from it. Included by gem/record only.
#pragma once

#include "gem/record/hdf5/hdf5_handle.h"

namespace gem::hdf5 {

/// Largest number of values that are read at once from a file of `file_bytes` bytes: 1 GiB in memory. A longer file may
/// have a value for each of its bytes.
constexpr hsize_t values_at_once(hsize_t file_bytes) {
  return file_bytes > hsize_t{1} << 27 ? file_bytes : hsize_t{1} << 27;
}
/// Largest number of values of all datasets that are read whole: 8 GiB in memory, or eight values for each byte.
constexpr hsize_t values_together(hsize_t file_bytes) { return 8 * values_at_once(file_bytes); }
/// Largest size of a text attribute or text dataset [bytes].
inline constexpr std::size_t text_bytes_maximum = std::size_t{16} << 20;

/// Keeps the library from loading filters and drivers from shared libraries. Call it before a file is opened.
void refuse_plugins();

/// Throws Failure if so many values of `object` are too many to read at once.
void check_at_once(hid_t object, hsize_t values, const std::string& name);

/// Throws Failure if the file could make the library open another file, run foreign code, or use up memory: links that
/// are not hard, data in other files (external, virtual), unknown filters, groups within groups, too many objects,
/// sizes above the limits, or more data than the bytes in the file can hold.
void check_untrusted(hid_t file);

}  // namespace gem::hdf5
