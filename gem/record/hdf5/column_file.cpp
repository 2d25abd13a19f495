// Creates dimensions and columns with their attributes, and appends rows.
#include "gem/record/hdf5/column_file.h"

#include <hdf5_hl.h>

#include <algorithm>
#include <cstddef>
#include <sstream>

#include "gem/engine/step/overlap_count.h"

namespace gem {

using hdf5::check;
using hdf5::checked;
using hdf5::Handle;

hid_t file_type(Stored stored) {
  switch (stored) {
    case Stored::f8:
      return H5T_IEEE_F64LE;
    case Stored::f4:
      return H5T_IEEE_F32LE;
    case Stored::i4:
      return H5T_STD_I32LE;
    case Stored::u1:
      return H5T_STD_U8LE;
  }
  return H5T_IEEE_F64LE;
}

namespace {

hid_t memory_type(double) { return H5T_NATIVE_DOUBLE; }
hid_t memory_type(float) { return H5T_NATIVE_FLOAT; }

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> list;
  for (std::string word; stream >> word;) list.push_back(word);
  return list;
}

bool grows(const std::string& dimension) {
  return dimension == "time" || dimension == "event" || dimension == "contact" || dimension == "split";
}

}  // namespace

ChunkShape chunk_shape(std::size_t floes) {
  ChunkShape shape;
  shape.frames = std::clamp<hsize_t>(65536 / std::max<hsize_t>(floes, 1), 1, shape.frames);
  shape.floes = 32768 / shape.frames;
  shape.rows = 64 * shape.frames;
  return shape;
}

hsize_t ChunkShape::rows_of(const std::string& group) const {
  return group == "floes" || group == "stats" ? frames : rows;
}

namespace {

/// How much of the index stays in memory.
enum class Index { all, little };

H5AC_cache_config_t index_cache(H5AC_cache_config_t cache, Index kept) {
  cache.set_initial_size = true;
  cache.initial_size = kept == Index::all ? cache.max_size : cache.min_size;
  cache.evictions_enabled = kept == Index::little;
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
  return cache;
}

}  // namespace

Handle ColumnFile::file_access() {
  Handle access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  // needed to read the file while it is written
  check(H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST), "file format");
  check(H5Pset_file_locking(access, false, true), "file locking");
  // the index of the file is written only by a flush, so that it never names rows that are not on the disk
  H5AC_cache_config_t cache{};
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  check(H5Pget_mdc_config(access, &cache), "index cache");
  cache = index_cache(cache, Index::all);
  check(H5Pset_mdc_config(access, &cache), "index cache");
  return access;
}

Handle ColumnFile::dataset_access() {
  Handle access = checked(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose, "dataset access");
  // without a cache a chunk is handed to the system when it is written, not later
  check(H5Pset_chunk_cache(access, 1, 0, 1.0), "chunk cache");
  return access;
}

ColumnFile::ColumnFile(const std::string& path, const std::map<std::string, hsize_t>& size, const ChunkShape& chunk)
    : ColumnFile(size, chunk) {
  const Handle access = file_access();
  const Handle creation = checked(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "file creation");
  file_ = checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose, "cannot create");
}

Handle ColumnFile::add_group(const std::string& group) {
  return checked(H5Gcreate2(file_, group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, group.c_str());
}

/// A dimension without values, as netCDF marks it. A dimension of size 0 is legal there only if it can grow.
void ColumnFile::add_dimension(hid_t group, const std::string& name, hsize_t size, bool unlimited) {
  const hsize_t maximum = unlimited || size == 0 ? H5S_UNLIMITED : size;
  const Handle space = checked(H5Screate_simple(1, &size, &maximum), H5Sclose, name.c_str());
  const Handle creation = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name.c_str());
  if (maximum == H5S_UNLIMITED) {
    check(H5Pset_chunk(creation, 1, &chunk_.rows), name.c_str());
  }
  Handle id = checked(H5Dcreate2(group, name.c_str(), H5T_IEEE_F32BE, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                      H5Dclose, name.c_str());
  std::string digits = std::to_string(size);
  digits.insert(0, digits.size() < 10 ? 10 - digits.size() : 0, ' ');
  const std::string mark = "This is a netCDF dimension but not a netCDF variable." + digits;
  check(H5DSset_scale(id, mark.c_str()), name.c_str());
  char path[256] = "";
  H5Iget_name(id, path, sizeof path);
  if (unlimited) {
    dataset_[path] = {checked(H5Dopen2(file_, path, H5P_DEFAULT), H5Dclose, path), 0, 1, chunk_.rows};
  }
  scale_[path] = std::move(id);
}

void ColumnFile::add_column(const Column& column, const std::vector<double>* values) {
  const std::vector<std::string> names = words(column.dimensions);
  std::vector<hsize_t> size, maximum, chunk;
  bool chunked = false;
  for (std::size_t d = 0; d < names.size(); ++d) {
    const hsize_t now = grows(names[d]) ? 0 : size_.at(names[d]);
    const bool open = grows(names[d]) || now == 0;
    size.push_back(now);
    maximum.push_back(open ? H5S_UNLIMITED : now);
    const hsize_t wish = d > 0 ? chunk_.floes : chunk_.rows_of(column.group);
    chunk.push_back(open ? wish : std::min(wish, now));
    chunked = chunked || open || now > 64;
  }
  const std::string path = path_of(column);
  const Handle space =
      checked(H5Screate_simple(static_cast<int>(size.size()), size.data(), maximum.data()), H5Sclose, path.c_str());
  const Handle creation = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path.c_str());
  if (chunked) {
    check(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()), path.c_str());
    check(H5Pset_shuffle(creation), path.c_str());
    check(H5Pset_deflate(creation, 1), path.c_str());
  }
  Handle id =
      checked(H5Dcreate2(file_, path.c_str(), file_type(column.stored), space, H5P_DEFAULT, creation, dataset_access()),
              H5Dclose, path.c_str());
  describe(column, id);
  attach_scales(column, names, id);
  if (values != nullptr && !values->empty()) {
    check(H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values->data()), path.c_str());
  }
  if (!grows(names.front())) return;
  const bool wide = names.size() > 1;
  dataset_[path] = {std::move(id),           0, wide ? size.back() : 1, chunk.front(), wide ? chunk.back() : 1,
                    file_type(column.stored)};
}

void ColumnFile::describe(const Column& column, hid_t dataset) {
  hdf5::write_text(dataset, "units", column.units);
  hdf5::write_text(dataset, "long_name", column.long_name);
  if (column.name == "vertex_count") {
    hdf5::write_text(dataset, "sample_dimension", column.group == "shape" ? "vertex" : "boundary_vertex");
  }
  if (column.group == "shape" && column.name == "thickness") {
    hdf5::write_text(dataset, "standard_name", "sea_ice_thickness");
  }
  if (column.dimensions == "time overlap_class") {
    std::vector<double> edges;
    for (int i = 0; i < OverlapCount::classes; ++i) edges.push_back(OverlapCount::upper_edge(i));
    hdf5::write_numbers(dataset, "class_upper_edges", H5T_IEEE_F64LE, edges);
  }
  if (column.flag_meanings.empty()) return;
  std::vector<double> values(words(column.flag_meanings).size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = double(i);
  hdf5::write_numbers(dataset, "flag_values", file_type(column.stored), values);
  hdf5::write_text(dataset, "flag_meanings", column.flag_meanings);
}

void ColumnFile::attach_scales(const Column& column, const std::vector<std::string>& names, hid_t dataset) {
  const std::string path = path_of(column);
  if (names.front() == column.name) {
    check(H5DSset_scale(dataset, column.name.c_str()), path.c_str());
    scale_[path] = checked(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, path.c_str());
    return;
  }
  for (std::size_t d = 0; d < names.size(); ++d) {
    const auto own = scale_.find("/" + column.group + "/" + names[d]);
    const auto found = own != scale_.end() ? own : scale_.find("/" + names[d]);
    check(H5DSattach_scale(dataset, found->second, static_cast<unsigned>(d)), path.c_str());
  }
}

void ColumnFile::start() {
  scale_.clear();
  check(H5Fstart_swmr_write(file_), "cannot let others read");
}

/// Writes one chunk along the time without compression. A chunk that grows is then overwritten in its place, and only
/// its new rows differ: whatever part of it reaches the disk, the rows before stay whole.
template <class Value>
void ColumnFile::write_plain(const Dataset& dataset, const std::vector<Value>& values, hsize_t rows) {
  const hsize_t cells = dataset.chunk_rows * dataset.chunk_width;
  for (hsize_t first = 0; first < dataset.width; first += dataset.chunk_width) {
    std::vector<Value> chunk(cells);
    const hsize_t width = std::min(dataset.chunk_width, dataset.width - first);
    for (hsize_t row = 0; row < rows; ++row)
      std::copy_n(values.begin() + std::ptrdiff_t(row * dataset.width + first), width,
                  chunk.begin() + std::ptrdiff_t(row * dataset.chunk_width));
    check(H5Tconvert(memory_type(Value{}), dataset.stored, cells, chunk.data(), nullptr, H5P_DEFAULT), "convert");
    constexpr std::uint32_t no_filters = 3;  // one bit for each of the two filters that are left out
    const hsize_t place[2] = {dataset.rows, first};
    check(H5Dwrite_chunk(dataset.id, H5P_DEFAULT, no_filters, place, cells * H5Tget_size(dataset.stored), chunk.data()),
          "write chunk");
  }
}

template <class Value>
void ColumnFile::write_packed(const Dataset& dataset, const Value* values, hsize_t first, hsize_t rows) {
  const hsize_t start[2] = {first, 0};
  const hsize_t count[2] = {rows, dataset.width};
  const Handle file_space = checked(H5Dget_space(dataset.id), H5Sclose, "rows");
  check(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start, nullptr, count, nullptr), "rows");
  const int rank = H5Sget_simple_extent_ndims(file_space);
  const Handle memory_space = checked(H5Screate_simple(rank, count, nullptr), H5Sclose, "rows");
  check(H5Dwrite(dataset.id, memory_type(Value{}), memory_space, file_space, H5P_DEFAULT, values), "rows");
}

template <class Value>
void ColumnFile::append(const std::string& path, const std::vector<Value>& values, hsize_t rows, Rows kind) {
  if (rows == 0) return;
  Dataset& dataset = dataset_.at(path);
  const hsize_t size[2] = {dataset.rows + rows, dataset.width};
  check(H5Dset_extent(dataset.id, size), path.c_str());
  if (!values.empty()) {
    // space that a chunk left is lost while others may read: a chunk that was written plain stays so
    const hsize_t plain = kind == Rows::part ? rows : dataset.plain ? std::min(rows, dataset.chunk_rows) : 0;
    if (plain > 0) write_plain(dataset, values, plain);
    if (rows > plain) write_packed(dataset, values.data() + plain * dataset.width, dataset.rows + plain, rows - plain);
  }
  dataset.plain = kind == Rows::part;
  if (kind != Rows::part) dataset.rows += rows;
}

template void ColumnFile::append(const std::string&, const std::vector<double>&, hsize_t, Rows);
template void ColumnFile::append(const std::string&, const std::vector<float>&, hsize_t, Rows);

void ColumnFile::overwrite(const std::string& path, const std::vector<double>& values, hsize_t first, hsize_t width) {
  const Dataset dataset{checked(H5Dopen2(file_, path.c_str(), dataset_access()), H5Dclose, path.c_str()), 0, width};
  write_packed(dataset, values.data(), first, values.size() / width);
}

std::uint64_t ColumnFile::room_for(const std::string& path, hsize_t rows) const {
  const Dataset& dataset = dataset_.at(path);
  const auto chunks = [](hsize_t cells, hsize_t chunk) { return (cells + chunk - 1) / chunk; };
  if (dataset.stored < 0) return 0;
  return chunks(rows, dataset.chunk_rows) * chunks(dataset.width, dataset.chunk_width) * dataset.chunk_rows *
         dataset.chunk_width * H5Tget_size(dataset.stored);
}

std::vector<std::string> ColumnFile::growing() const {
  std::vector<std::string> paths;
  for (const auto& [path, dataset] : dataset_) paths.push_back(path);
  return paths;
}

void ColumnFile::flush() {
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "cannot flush");
  shrink_index();
}

/// All of the index is in the file now, so dropping it from memory writes nothing. What the next rows need is read
/// back.
void ColumnFile::shrink_index() {
  H5AC_cache_config_t cache{};
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  check(H5Fget_mdc_config(file_, &cache), "index cache");
  H5AC_cache_config_t change = index_cache(cache, Index::little);
  check(H5Fset_mdc_config(file_, &change), "index cache");
  H5G_info_t root{};  // the library drops what is too much when the index is used
  check(H5Gget_info(file_, &root), "index cache");
  change = index_cache(cache, Index::all);
  check(H5Fset_mdc_config(file_, &change), "index cache");
}

std::size_t ColumnFile::index_bytes() const {
  std::size_t most = 0, clean = 0, now = 0;
  int entries = 0;
  check(H5Fget_mdc_size(file_, &most, &clean, &now, &entries), "index cache");
  return now;
}

void ColumnFile::close() {
  for (auto& [path, dataset] : dataset_) {
    if (!dataset.id.close()) throw hdf5::Failure{path + ": " + hdf5::last_reason()};
  }
  for (auto& [path, scale] : scale_) {
    if (!scale.close()) throw hdf5::Failure{path + ": " + hdf5::last_reason()};
  }
  if (!file_.close()) throw hdf5::Failure{"cannot close: " + hdf5::last_reason()};
}

void ColumnFile::abandon() {
  for (auto& [path, dataset] : dataset_) dataset.id.abandon();
  for (auto& [path, scale] : scale_) scale.abandon();
  file_.abandon();
}

}  // namespace gem
