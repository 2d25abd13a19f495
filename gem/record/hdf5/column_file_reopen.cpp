// Opens the columns of an existing file, cuts them, and goes on at their ends.
#include "gem/record/hdf5/column_file.h"

namespace gem {

using hdf5::check;
using hdf5::checked;
using hdf5::Handle;

ColumnFile ColumnFile::reopened(const std::string& path, const std::map<std::string, hsize_t>& size,
                                const ChunkShape& chunk) {
  ColumnFile file(size, chunk);
  file.file_ = hdf5::open_unclosed(path, file_access());
  return file;
}

hsize_t ColumnFile::open_column(const Column& column, hsize_t width) {
  const std::string path = path_of(column);
  Handle id = checked(H5Dopen2(file_, path.c_str(), dataset_access()), H5Dclose, path.c_str());
  const Handle space = checked(H5Dget_space(id), H5Sclose, path.c_str());
  const Handle creation = checked(H5Dget_create_plist(id), H5Pclose, path.c_str());
  const int rank = H5Sget_simple_extent_ndims(space);
  hsize_t size[2] = {0, 1}, chunk[2] = {1, 1};
  if (rank != 1 && rank != 2) throw hdf5::Failure{path + ": neither a list nor a table"};
  check(H5Sget_simple_extent_dims(space, size, nullptr), path.c_str());
  if (H5Pget_chunk(creation, rank, chunk) != rank) throw hdf5::Failure{path + ": it cannot grow"};
  if (size[1] != width) throw hdf5::Failure{path + ": rows of another width"};
  dataset_[path] = {std::move(id), size[0], width, chunk[0], chunk[1], file_type(column.stored)};
  return size[0];
}

hsize_t ColumnFile::open_dimension(const std::string& path) {
  Handle id = checked(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, path.c_str());
  const Handle space = checked(H5Dget_space(id), H5Sclose, path.c_str());
  hsize_t size = 0;
  if (H5Sget_simple_extent_ndims(space) != 1) throw hdf5::Failure{path + ": no dimension"};
  check(H5Sget_simple_extent_dims(space, &size, nullptr), path.c_str());
  dataset_[path] = {std::move(id), size, 1, chunk_.rows};
  return size;
}

void ColumnFile::cut(const std::string& path, hsize_t rows) {
  Dataset& dataset = dataset_.at(path);
  if (dataset.rows == rows) return;
  const hsize_t size[2] = {rows, dataset.width};
  check(H5Dset_extent(dataset.id, size), path.c_str());
  dataset.rows = rows;
}

}  // namespace gem
