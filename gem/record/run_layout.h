// The HDF5 side of the run writer: creates the file with all its datasets and appends rows. One thread at a time.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gem/record/hdf5_handle.h"
#include "gem/record/run_writer.h"

namespace gem {

/// An open run file. Every failed call throws hdf5::Failure.
class RunLayout {
 public:
  RunLayout(const std::string& path, bool overwrite, const SceneDef& scene, const Bodies& bodies,
            const Provenance& provenance);
  void append(const Slab& slab);
  void set_text(const char* attribute, const std::string& text);
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
  void create_file(const std::string& path, bool overwrite);
  void write_header(const SceneDef& scene, const Bodies& bodies, const Provenance& provenance);
  void measure(const SceneDef& scene, const Bodies& bodies);
  void add_group(const std::string& group, const char* unlimited);
  void add_dimension(hid_t group, const std::string& name, hsize_t size, bool unlimited);
  void add_column(const Column& column, const std::vector<double>* values);
  void describe(const Column& column, hid_t dataset);
  void attach_scales(const Column& column, const std::vector<std::string>& names, hid_t dataset);
  template <class Value>
  void append_column(const std::string& path, const std::vector<Value>& values, hsize_t rows);
  template <class Row>
  void append_rows(const std::vector<RowColumn<Row>>& columns, const std::vector<Row>& rows);

  hdf5::Handle file_;
  std::map<std::string, hsize_t> size_;                // of the fixed dimensions
  std::map<std::string, Dataset> dataset_;             // by path, those that grow
  std::map<std::string, hdf5::Handle> scale_;          // by path
};

}  // namespace gem
