// An HDF5 file of named dimensions and columns that grow, readable as netCDF-4. One thread at a time.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gem/record/hdf5_handle.h"
#include "gem/record/schema.h"

namespace gem {

/// Rows that are written together. Only whole chunks are safe from a kill, so what a chunk holds is what a kill costs:
/// where a field is large, and a frame takes long to simulate, a chunk holds fewer frames of more floes (131 kB each).
struct ChunkShape {
  hsize_t frames = 16;
  hsize_t floes = 2048;
  hsize_t rows = 1024;  // of the platform and of the events

  hsize_t rows_of(const std::string& group) const;
};
ChunkShape chunk_shape(std::size_t floes);

/// Every failed call throws hdf5::Failure.
class ColumnFile {
 public:
  /// Creates the file, or empties the one that is there. `size` holds the dimensions that do not grow.
  ColumnFile(const std::string& path, const std::map<std::string, hsize_t>& size, const ChunkShape& chunk);

  hid_t id() const { return file_; }
  hdf5::Handle add_group(const std::string& group);
  void add_dimension(hid_t group, const std::string& name, hsize_t size, bool unlimited);
  /// `values` of a column that does not grow, or none.
  void add_column(const Column& column, const std::vector<double>* values);
  /// Rows behind those of the column at `path`; without values the column alone grows.
  template <class Value>
  void append(const std::string& path, const std::vector<Value>& values, hsize_t rows);
  void flush();
  void close();
  /// Gives up all handles without closing: after a failure the library cannot close the file any more.
  void abandon();

 private:
  struct Dataset {
    hdf5::Handle id;
    hsize_t rows = 0;
    hsize_t width = 1;
  };
  void describe(const Column& column, hid_t dataset);
  void attach_scales(const Column& column, const std::vector<std::string>& names, hid_t dataset);

  hdf5::Handle file_;
  std::map<std::string, hsize_t> size_;  // of the fixed dimensions
  ChunkShape chunk_;
  std::map<std::string, Dataset> dataset_;     // by path, those that grow
  std::map<std::string, hdf5::Handle> scale_;  // by path
};

}  // namespace gem
