// Walks over the links by hand: the walk of the library follows groups as deep as they go.
#include "gem/record/hdf5/untrusted_file.h"

#include <array>
#include <limits>

namespace gem::hdf5 {
namespace {

constexpr hsize_t links_maximum = 1000;  // of one group; the largest group of a run file has 30, a summary has 200
constexpr std::size_t name_maximum = 200;
constexpr int depth_maximum = 2;  // the root, and groups in it
constexpr int dimensions_maximum = 2;
constexpr hsize_t chunk_bytes_maximum = hsize_t{256} << 20;
constexpr hsize_t row_values_maximum = 10'000'000;  // as many floes as a case may have
// Deflate makes at most 1032 bytes of one. The rest is for the chunk that a killed run did not write.
constexpr double expansion_maximum = 1100.0;
constexpr double expansion_free = 64e6;

[[noreturn]] void refuse(const std::string& name, const std::string& why) { throw Failure{name + ": " + why}; }

hsize_t file_bytes(hid_t object) {
  const Handle file = checked(H5Iget_file_id(object), H5Fclose, "file");
  hsize_t bytes = 0;
  check(H5Fget_filesize(file, &bytes), "file size");
  return bytes;
}

void check_filters(const std::string& name, hid_t creation) {
  const int count = H5Pget_nfilters(creation);
  for (int i = 0; i < count; ++i) {
    unsigned flags = 0, settings = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &values, nullptr, 0, nullptr, &settings);
    if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_FLETCHER32)
      refuse(name, "a filter that gem does not use (number " + std::to_string(filter) + ")");
  }
}

/// Everything that must be known before the extent is asked for: a virtual dataset opens its sources then.
void check_layout(const std::string& name, hid_t dataset) {
  const Handle creation = checked(H5Dget_create_plist(dataset), H5Pclose, name.c_str());
  const H5D_layout_t layout = H5Pget_layout(creation);
  if (layout != H5D_COMPACT && layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED)
    refuse(name, "its data are in other files (a virtual dataset)");
  if (H5Pget_external_count(creation) != 0) refuse(name, "its data are in other files (external storage)");
  check_filters(name, creation);
  if (layout != H5D_CHUNKED) return;
  std::array<hsize_t, H5S_MAX_RANK> chunk{};
  const int rank = H5Pget_chunk(creation, H5S_MAX_RANK, chunk.data());
  hsize_t bytes = 8;
  for (int i = 0; i < rank; ++i) {
    if (chunk[i] > chunk_bytes_maximum / bytes) refuse(name, "its chunks are too large");
    bytes *= chunk[i];
  }
}

void check_type(const std::string& name, hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  const std::size_t size = H5Tget_size(type);
  if ((kind == H5T_INTEGER || kind == H5T_FLOAT) && size <= 16) return;
  if (kind == H5T_STRING && (H5Tis_variable_str(type) > 0 || size <= text_bytes_maximum)) return;
  refuse(name, "neither numbers nor text of a size that gem writes");
}

/// Checks the extent; returns how many values reading takes at a time. Tables that grow with a run are read some rows
/// at a time.
hsize_t check_extent(const std::string& name, hid_t dataset, std::size_t value_size, hsize_t file_bytes) {
  const Handle space = checked(H5Dget_space(dataset), H5Sclose, name.c_str());
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0 || rank > dimensions_maximum) refuse(name, "too many dimensions");
  std::array<hsize_t, dimensions_maximum> size{1, 1}, most{1, 1};
  check(H5Sget_simple_extent_dims(space, size.data(), most.data()), name.c_str());
  if (size[1] > row_values_maximum) refuse(name, "its rows are too long");
  if (size[0] > std::numeric_limits<std::uint32_t>::max()) refuse(name, "too many rows");
  const double bytes = double(size[0]) * double(size[1]) * double(value_size);
  if (bytes > expansion_maximum * double(H5Dget_storage_size(dataset)) + expansion_free)
    refuse(name, "it claims more data than the file holds");
  const bool is_growing_table = rank == 2 && most[0] == H5S_UNLIMITED;
  const hsize_t at_once = is_growing_table ? size[1] : size[0] * size[1];
  if (at_once > values_at_once(file_bytes)) refuse(name, "too large to read at once");
  return at_once;
}

class Walk {
 public:
  explicit Walk(hsize_t file_bytes) : file_bytes_(file_bytes) {}

  void group(hid_t place, const std::string& path, int depth) {
    H5G_info_t info{};
    check(H5Gget_info(place, &info), path.c_str());
    if (info.nlinks > links_maximum) refuse(path, "too many objects");
    for (hsize_t i = 0; i < info.nlinks; ++i) {
      std::array<char, name_maximum + 1> name{};
      const ssize_t length =
          H5Lget_name_by_idx(place, ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(), H5P_DEFAULT);
      if (length < 0) refuse(path, last_reason());
      if (length == 0 || static_cast<std::size_t>(length) > name_maximum) refuse(path, "a name is too long or empty");
      object(place, name.data(), path + name.data(), depth);
    }
  }

 private:
  void object(hid_t place, const char* name, const std::string& path, int depth) {
    H5L_info_t link{};
    check(H5Lget_info(place, name, &link, H5P_DEFAULT), path.c_str());
    if (link.type != H5L_TYPE_HARD) refuse(path, "a link to another place or file");
    const Handle object = checked(H5Oopen(place, name, H5P_DEFAULT), H5Oclose, path.c_str());
    const H5I_type_t kind = H5Iget_type(object);
    if (kind == H5I_GROUP && depth >= depth_maximum) refuse(path, "groups are nested too deep");
    if (kind == H5I_GROUP) return group(object, path + "/", depth + 1);
    if (kind != H5I_DATASET) refuse(path, "neither a group nor a dataset");
    check_layout(path, object);
    const Handle type = checked(H5Dget_type(object), H5Tclose, path.c_str());
    check_type(path, type);
    values_ += check_extent(path, object, H5Tget_size(type), file_bytes_);
    if (values_ > values_together(file_bytes_)) refuse(path, "the data of the file are too large to read");
  }

  const hsize_t file_bytes_;
  hsize_t values_ = 0;
};

}  // namespace

void refuse_plugins() { H5PLset_loading_state(0); }

void check_at_once(hid_t object, hsize_t values, const std::string& name) {
  if (values > values_at_once(file_bytes(object))) refuse(name, "too large to read at once");
}

void check_untrusted(hid_t file) { Walk(file_bytes(file)).group(file, "", 1); }

}  // namespace gem::hdf5
