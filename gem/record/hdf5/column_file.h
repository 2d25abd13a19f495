// An HDF5 file of named dimensions and growing columns, readable as netCDF-4, also while it is written (SWMR). Not
// thread-safe.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "gem/record/hdf5/hdf5_handle.h"
#include "gem/record/schema.h"

namespace gem {

/// Rows that are compressed together. Fields with more floes, whose frames take longer to simulate, get fewer frames
/// per chunk (131 kB per chunk).
struct ChunkShape {
  hsize_t frames = 16;
  hsize_t floes = 2048;
  hsize_t rows = 1024;  // of platform and events

  hsize_t rows_of(const std::string& group) const;
};
ChunkShape chunk_shape(std::size_t floes);

/// The type of a column in the file.
hid_t file_type(Stored stored);

/// How rows are appended. `whole`: a multiple of a chunk, for good. `part`: less than a chunk; the next call for the
/// column gives these rows again, with those that came after them. `last`: any number, for good.
enum class Rows { whole, part, last };

/// Every failed call throws hdf5::Failure.
class ColumnFile {
 public:
  /// Creates the file, or empties an existing one. `size` holds the lengths of the dimensions that do not grow. The
  /// caller holds the lock of the file.
  ColumnFile(const std::string& path, const std::map<std::string, hsize_t>& size, const ChunkShape& chunk);
  /// Opens an existing file, closed or left by a process that died, to append to the columns that open_column() names.
  static ColumnFile reopened(const std::string& path, const std::map<std::string, hsize_t>& size,
                             const ChunkShape& chunk);
  /// Opens a growing column whose rows are `width` wide. Returns its number of rows. Before start().
  hsize_t open_column(const Column& column, hsize_t width);
  /// Opens a dimension that grows. Returns its length. Before start().
  hsize_t open_dimension(const std::string& path);
  /// Cuts off the rows from `rows` on, a multiple of a chunk.
  void cut(const std::string& path, hsize_t rows);

  hid_t id() const { return file_; }
  hdf5::Handle add_group(const std::string& group);
  void add_dimension(hid_t group, const std::string& name, hsize_t size, bool unlimited);
  /// Adds a column; `values` are those of a column that does not grow, else null.
  void add_column(const Column& column, const std::vector<double>* values);
  /// Ends the layout: no group, dimension, column or attribute can be added. From now on others can read the file.
  void start();
  /// Appends rows to the column at `path`. Without values only its length grows. The values are handed to the system
  /// at once; readers see them after flush().
  template <class Value>
  void append(const std::string& path, const std::vector<Value>& values, hsize_t rows, Rows kind);
  /// Writes values over rows of a column that does not grow, from row `first` on; rows are `width` wide.
  void overwrite(const std::string& path, const std::vector<double>& values, hsize_t first, hsize_t width);
  /// Bytes that `rows` more rows of the column can take, in whole chunks, uncompressed.
  std::uint64_t room_for(const std::string& path, hsize_t rows) const;
  /// Paths of the growing columns.
  std::vector<std::string> growing() const;
  /// Hands the lengths and the index of the file to the system. To be called when the values are on the disk. The index
  /// then leaves memory, but for a megabyte.
  void flush();
  /// Bytes of the index in memory.
  std::size_t index_bytes() const;
  void close();
  /// Drops all handles without closing them. After a failed write the library cannot close the file.
  void abandon();

 private:
  ColumnFile(const std::map<std::string, hsize_t>& size, const ChunkShape& chunk) : size_(size), chunk_(chunk) {}
  static hdf5::Handle file_access();
  static hdf5::Handle dataset_access();
  void shrink_index();

  struct Dataset {
    hdf5::Handle id;
    hsize_t rows = 0;  // written for good
    hsize_t width = 1;
    hsize_t chunk_rows = 1;
    hsize_t chunk_width = 1;
    hid_t stored = H5I_INVALID_HID;
    bool plain = false;  // the chunk after `rows` stands in the file, part-full and not compressed
  };
  template <class Value>
  void write_plain(const Dataset& dataset, const std::vector<Value>& values, hsize_t rows);
  template <class Value>
  void write_packed(const Dataset& dataset, const Value* values, hsize_t first, hsize_t rows);
  void describe(const Column& column, hid_t dataset);
  void attach_scales(const Column& column, const std::vector<std::string>& names, hid_t dataset);

  hdf5::Handle file_;
  std::map<std::string, hsize_t> size_;  // lengths of the fixed dimensions
  ChunkShape chunk_;
  std::map<std::string, Dataset> dataset_;     // growing datasets, by path
  std::map<std::string, hdf5::Handle> scale_;  // by path
};

}  // namespace gem
