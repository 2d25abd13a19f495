// What a run file holds and how slabs go into it. One thread at a time.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gem/record/column_file.h"
#include "gem/record/run_writer.h"

namespace gem {

/// An open run file. Every failed call throws hdf5::Failure.
class RunLayout {
 public:
  /// Creates the file, or empties the one that is there.
  RunLayout(const std::string& path, const SceneDef& scene, const Bodies& bodies, const Provenance& provenance);
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
  void flush() { file_.flush(); }
  void close() { file_.close(); }
  void abandon() { file_.abandon(); }

 private:
  void write_header(const SceneDef& scene, const Bodies& bodies, const Provenance& provenance);
  void add_group(const std::string& group);
  template <class Row>
  void append_rows(const std::vector<RowColumn<Row>>& columns, std::vector<Row>& rows, std::size_t count);
  void append_stats(std::size_t count);
  void append_events(std::size_t count);
  void append_frames(std::size_t count);

  std::map<std::string, hsize_t> size_;  // of the dimensions that do not grow
  ChunkShape chunk_;
  ColumnFile file_;
  Slab waiting_;
  double saved_time_ = 0.0;
  bool any_written_ = false;
};

}  // namespace gem
