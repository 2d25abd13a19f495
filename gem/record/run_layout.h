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
  /// Takes a slab over and writes the chunks that are full. A chunk is written once and never again: its room in the
  /// file is never given to another chunk, so a killed run leaves every chunk readable that a flush has seen.
  void append(Slab slab);
  /// Writes the rows that fill no chunk; for the end of a run.
  void append_rest();
  /// What waits for its chunk to fill.
  const Slab& waiting() const { return waiting_; }
  /// Time of the last floe frame that was written [s].
  double saved_time() const { return saved_time_; }
  bool any_written() const { return any_written_; }
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
  void append_rows(const std::vector<RowColumn<Row>>& columns, std::vector<Row>& rows, std::size_t count);
  void append_stats(std::size_t count);
  void append_events(std::size_t count);
  void append_frames(std::size_t count);

  hdf5::Handle file_;
  Slab waiting_;
  double saved_time_ = 0.0;
  bool any_written_ = false;
  std::map<std::string, hsize_t> size_;        // of the fixed dimensions
  std::map<std::string, Dataset> dataset_;     // by path, those that grow
  std::map<std::string, hdf5::Handle> scale_;  // by path
};

}  // namespace gem
