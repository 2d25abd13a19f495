// An HDF5 file of named dimensions and growing columns, readable as netCDF-4. Not thread-safe.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gem/record/hdf5_handle.h"
#include "gem/record/schema.h"

namespace gem {

/// Rows that are written together. Only whole chunks survive a kill, so a kill loses up to one chunk. Fields with more
/// floes, whose frames take longer to simulate, get fewer frames per chunk (131 kB per chunk).
struct ChunkShape {
  hsize_t frames = 16;
  hsize_t floes = 2048;
  hsize_t rows = 1024;  // of platform and events

  hsize_t rows_of(const std::string& group) const;
};
ChunkShape chunk_shape(std::size_t floes);

/// Every failed call throws hdf5::Failure.
class ColumnFile {
 public:
  /// Creates the file, or empties an existing one. `size` holds the lengths of the dimensions that do not grow.
  ColumnFile(const std::string& path, const std::map<std::string, hsize_t>& size, const ChunkShape& chunk);

  hid_t id() const { return file_; }
  hdf5::Handle add_group(const std::string& group);
  void add_dimension(hid_t group, const std::string& name, hsize_t size, bool unlimited);
  /// Adds a column; `values` are those of a column that does not grow, else null.
  void add_column(const Column& column, const std::vector<double>* values);
  /// Appends rows to the column at `path`. Without values only its length grows.
  template <class Value>
  void append(const std::string& path, const std::vector<Value>& values, hsize_t rows);
  void flush();
  void close();
  /// Drops all handles without closing them. After a failed write the library cannot close the file.
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
  std::map<std::string, hsize_t> size_;  // lengths of the fixed dimensions
  ChunkShape chunk_;
  std::map<std::string, Dataset> dataset_;     // growing datasets, by path
  std::map<std::string, hdf5::Handle> scale_;  // by path
};

}  // namespace gem
