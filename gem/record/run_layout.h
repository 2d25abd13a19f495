// The layout of a run file, and writing slabs into it. Not thread-safe.
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
  /// Creates the file, or empties an existing one.
  RunLayout(const std::string& path, const SceneDef& scene, const Bodies& bodies, const Provenance& provenance);
  /// Takes over a slab and writes the chunks that are full. A chunk is written once, and its place in the file is never
  /// reused. So every chunk that was flushed stays readable after a kill.
  void append(Slab slab);
  /// Writes the remaining rows that fill no chunk, at the end of the run.
  void append_rest();
  /// The rows that wait for their chunk to fill.
  const Slab& waiting() const { return waiting_; }
  /// Time of the last floe frame that was written [s].
  double saved_time() const { return saved_time_; }
  bool any_written() const { return any_written_; }
  void set_text(const char* attribute, const std::string& text);
  /// Once per file; the attributes are gem_verdict and gem_verdict_*, see verdict_attributes.h.
  void set_verdict(const RunVerdict& verdict);
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
