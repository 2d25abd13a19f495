// Reasons of failed HDF5 calls, and text attributes.
#include "gem/record/hdf5_handle.h"

#include <algorithm>

namespace gem::hdf5 {

namespace {

/// The deepest entry of the error stack comes first. An entry with a message of the system has priority.
herr_t pick_reason(unsigned, const H5E_error2_t* entry, void* out) {
  auto& reason = *static_cast<std::string*>(out);
  const std::string text = entry->desc != nullptr ? entry->desc : "";
  const std::string key = "error message = '";
  if (const auto at = text.find(key); at != std::string::npos) {
    const auto from = at + key.size();
    reason = text.substr(from, text.find('\'', from) - from);
    return 1;
  }
  if (reason.empty()) reason = text;
  return 0;
}

}  // namespace

std::string last_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, pick_reason, &reason);
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  return reason.empty() ? "unknown reason" : reason;
}

std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

void quiet_errors() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

void write_text(hid_t object, const char* name, const std::string& text, std::size_t reserved) {
  const std::size_t size = std::max({text.size(), reserved, std::size_t{1}});
  std::string padded = text;
  padded.resize(size, '\0');
  const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, "text type");
  check(H5Tset_size(type, size), "text size");
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "text padding");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "text encoding");
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, "text space");
  const bool exists = H5Aexists(object, name) > 0;
  const Handle attribute =
      exists ? checked(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, name)
             : checked(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  const Handle stored = checked(H5Aget_type(attribute), H5Tclose, name);
  padded.resize(H5Tget_size(stored), '\0');
  check(H5Awrite(attribute, stored, padded.data()), name);
}

void write_numbers(hid_t object, const char* name, hid_t file_type, const std::vector<double>& values) {
  const hsize_t size = values.size();
  const Handle space = values.size() == 1 ? checked(H5Screate(H5S_SCALAR), H5Sclose, name)
                                          : checked(H5Screate_simple(1, &size, nullptr), H5Sclose, name);
  const Handle attribute =
      checked(H5Acreate2(object, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  check(H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data()), name);
}

}  // namespace gem::hdf5
