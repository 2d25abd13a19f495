// Looks up chunks and times at the end of datasets.
#include "gem/record/hdf5/row_extent.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace gem::hdf5 {

namespace {

struct Shape {
  std::vector<hsize_t> size, chunk;  // no chunk: the dataset does not grow
};

Shape shape_of(hid_t dataset) {
  Shape shape;
  const Handle space = checked(H5Dget_space(dataset), H5Sclose, "extent");
  const int rank = H5Sget_simple_extent_ndims(space);
  shape.size.resize(static_cast<std::size_t>(std::max(0, rank)));
  check(H5Sget_simple_extent_dims(space, shape.size.data(), nullptr), "extent");
  const Handle creation = checked(H5Dget_create_plist(dataset), H5Pclose, "layout");
  if (rank < 1 || H5Pget_layout(creation) != H5D_CHUNKED) return shape;
  shape.chunk.resize(shape.size.size());
  if (H5Pget_chunk(creation, rank, shape.chunk.data()) < 0) throw Failure{"layout: " + last_reason()};
  return shape;
}

/// Whether all chunks that begin in `row` stand in the file.
bool stand(hid_t dataset, const Shape& shape, hsize_t row, std::uint64_t file_size) {
  const hsize_t width = shape.size.size() > 1 ? shape.size[1] : 1;
  const hsize_t step = shape.size.size() > 1 ? shape.chunk[1] : 1;
  for (hsize_t first = 0; first < width; first += step) {
    const hsize_t place[2] = {row, first};
    unsigned filters = 0;
    haddr_t address = HADDR_UNDEF;
    hsize_t bytes = 0;
    // a failure means that the index was cut with the chunk
    if (H5Dget_chunk_info_by_coord(dataset, place, &filters, &address, &bytes) < 0) return false;
    if (address == HADDR_UNDEF || address + bytes > file_size) return false;
  }
  return true;
}

herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

/// A dimension of netCDF that holds no values.
bool is_bare_dimension(const std::string& group, const std::string& name) {
  return (group == "events" && name == "event") || (group == "contacts" && name == "contact") ||
         (group == "splits" && name == "split");
}

}  // namespace

std::uint64_t rows_on_disk(hid_t dataset, std::uint64_t file_size, std::uint64_t checked_chunks) {
  const Shape shape = shape_of(dataset);
  if (shape.chunk.empty()) return shape.size.empty() ? 0 : shape.size[0];
  const hsize_t chunk = shape.chunk[0];
  hsize_t rows = shape.size[0], whole = 0;  // the last `whole` chunks of the rows stand
  while (rows > 0 && whole < checked_chunks && whole * chunk < rows) {
    const hsize_t begin = (rows - 1) / chunk * chunk - whole * chunk;
    ++whole;
    if (stand(dataset, shape, begin, file_size)) continue;
    rows = begin;
    whole = 0;
  }
  return rows;
}

std::uint64_t rows_in_time(hid_t dataset, std::uint64_t rows) {
  // zeros at the end come from chunks that were not written, so the end is enough
  const hsize_t first = rows > 65536 ? rows - 65536 : 0;
  const hsize_t count = rows - first;
  if (count == 0) return 0;
  const Handle space = checked(H5Dget_space(dataset), H5Sclose, "time");
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &count, nullptr), "time");
  const Handle memory = checked(H5Screate_simple(1, &count, nullptr), H5Sclose, "time");
  std::vector<double> time(count);
  check(H5Dread(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, time.data()), "time");
  while (time.size() > 1 && time.back() == 0.0) time.pop_back();
  return first + time.size();
}

std::uint64_t rows_of_group(hid_t file, const std::string& group, std::uint64_t file_size,
                            std::uint64_t checked_chunks) {
  if (H5Lexists(file, group.c_str(), H5P_DEFAULT) <= 0) return 0;
  const Handle folder(H5Gopen2(file, group.c_str(), H5P_DEFAULT), H5Gclose);
  if (!folder.valid()) return 0;  // something else has the name
  std::vector<std::string> names;
  check(H5Literate(folder, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add_name, &names), group.c_str());
  std::uint64_t rows = names.empty() ? 0 : std::numeric_limits<std::uint64_t>::max();
  for (const std::string& name : names) {
    if (is_bare_dimension(group, name)) continue;
    const Handle dataset(H5Dopen2(folder, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset.valid()) continue;
    rows = std::min(rows, rows_on_disk(dataset, file_size, checked_chunks));
  }
  if (H5Lexists(folder, "time", H5P_DEFAULT) <= 0) return rows;
  const Handle time(H5Dopen2(folder, "time", H5P_DEFAULT), H5Dclose);
  if (!time.valid() || shape_of(time).size.size() != 1) return rows;
  return rows_in_time(time, rows);
}

}  // namespace gem::hdf5
