// Reasons of failed HDF5 calls, and text attributes.
#include "gem/record/hdf5/hdf5_handle.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace gem::hdf5 {

namespace {

constexpr const char* out_of_memory = "out of memory";

/// The deepest entry of the error stack comes first. An entry with a message of the system has priority.
herr_t pick_reason(unsigned, const H5E_error2_t* entry, void* out) {
  auto& reason = *static_cast<std::string*>(out);
  const std::string text = entry->desc != nullptr ? entry->desc : "";
  if (entry->maj_num == H5E_RESOURCE && text.find("memory") != std::string::npos) {
    reason = out_of_memory;
    return 1;
  }
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

bool is_memory(const std::string& reason) {
  return reason.find(out_of_memory) != std::string::npos || reason.find(std::strerror(ENOMEM)) != std::string::npos;
}

Handle open_unclosed(const std::string& path, hid_t access) {
  const hbool_t yes = true;  // the two settings of the program h5clear
  check(H5Pset(access, "clear_status_flags", &yes), "file access");
  check(H5Pset(access, "skip_eof_check", &yes), "file access");
  Handle file = checked(H5Fopen(path.c_str(), H5F_ACC_RDWR, access), H5Fclose, "cannot open");
  check(H5Fincrement_filesize(file, 0), "file size");
  return file;
}

Handle open_left_file(const std::string& path) {
  const Handle access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  // a driver of its own, since the library gives the same file of the same driver only once
  check(H5Pset_fapl_log(access, nullptr, 0, 0), "file access");
  check(H5Pset_file_locking(access, false, true), "file locking");  // the caller holds the lock
  return open_unclosed(path, access);
}

std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

void quiet_errors() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

std::size_t element_count(hid_t object, hid_t space, std::size_t stored, const std::string& name) {
  const Handle file = checked(H5Iget_file_id(object), H5Fclose, name.c_str());
  hsize_t bytes = 0;
  check(H5Fget_filesize(file, &bytes), name.c_str());
  constexpr hsize_t most_packed = 1032;  // bytes that deflate can pack into one
  const hsize_t most = bytes * most_packed / std::max<hsize_t>(stored, 1);
  std::vector<hsize_t> size(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  check(H5Sget_simple_extent_dims(space, size.data(), nullptr), name.c_str());
  if (H5Sget_simple_extent_type(space) == H5S_NULL || std::count(size.begin(), size.end(), hsize_t{0}) > 0) return 0;
  hsize_t count = 1;
  for (const hsize_t length : size) {
    if (length > most / count) throw Failure{name + ": larger than its file can hold"};
    count *= length;
  }
  return count;
}

std::string read_text(hid_t object, const std::string& name) {
  if (H5Aexists(object, name.c_str()) <= 0) return "";
  const Handle attribute = checked(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, name.c_str());
  const Handle type = checked(H5Aget_type(attribute), H5Tclose, name.c_str());
  const Handle space = checked(H5Aget_space(attribute), H5Sclose, name.c_str());
  if (H5Tget_class(type) != H5T_STRING) return "";
  const std::size_t size = H5Tget_size(type);
  if (element_count(object, space, size, name) != 1) return "";
  if (H5Tis_variable_str(type) > 0) {  // as other programs write them
    char* words = nullptr;
    check(H5Aread(attribute, type, &words), name.c_str());
    const std::string copy = words != nullptr ? words : "";
    check(H5Dvlen_reclaim(type, space, H5P_DEFAULT, &words), name.c_str());
    return copy;
  }
  std::string text(size, '\0');
  check(H5Aread(attribute, type, text.data()), name.c_str());
  return text.substr(0, text.find('\0'));
}

namespace {

/// The attribute of this name, made anew if one of another kind or length has the name. A file that is mended or goes
/// on may come from anybody, and the library would read as many values as the file asks for.
Handle attribute_to_write(hid_t object, const char* name, hid_t type, hid_t space) {
  if (H5Aexists(object, name) > 0) {
    Handle found = checked(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, name);
    const Handle stored = checked(H5Aget_type(found), H5Tclose, name);
    const Handle extent = checked(H5Aget_space(found), H5Sclose, name);
    if (H5Tget_class(stored) == H5Tget_class(type) && H5Tis_variable_str(stored) <= 0 &&
        H5Sget_simple_extent_npoints(extent) == H5Sget_simple_extent_npoints(space))
      return found;
    check(H5Adelete(object, name), name);
  }
  return checked(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
}

}  // namespace

void write_text(hid_t object, const char* name, const std::string& text, std::size_t reserved) {
  const std::size_t size = std::max({text.size(), reserved, std::size_t{1}});
  std::string padded = text;
  padded.resize(size, '\0');
  const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, "text type");
  check(H5Tset_size(type, size), "text size");
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "text padding");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "text encoding");
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, "text space");
  const Handle attribute = attribute_to_write(object, name, type, space);
  const Handle stored = checked(H5Aget_type(attribute), H5Tclose, name);
  padded.resize(H5Tget_size(stored), '\0');
  check(H5Awrite(attribute, stored, padded.data()), name);
}

void write_numbers(hid_t object, const char* name, hid_t file_type, const std::vector<double>& values) {
  const hsize_t size = values.size();
  const Handle space = values.size() == 1 ? checked(H5Screate(H5S_SCALAR), H5Sclose, name)
                                          : checked(H5Screate_simple(1, &size, nullptr), H5Sclose, name);
  const Handle attribute = attribute_to_write(object, name, file_type, space);
  check(H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data()), name);
}

}  // namespace gem::hdf5
