// The layout of a run file, and writing slabs into it. Not thread-safe.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "gem/record/hdf5/column_file.h"
#include "gem/record/run_file/run_writer.h"

namespace gem {

/// Rows of a run file by group.
struct RowCount {
  std::size_t platform = 0;
  std::size_t events = 0;
  std::size_t stats = 0;
  std::size_t frames = 0;
  std::size_t contacts = 0;
  std::size_t splits = 0;
};

/// An open run file. Every failed call throws hdf5::Failure.
class RunLayout {
 public:
  /// Creates the file, or empties an existing one. The caller holds the lock of the file.
  RunLayout(const std::string& path, const SceneDef& scene, const Bodies& bodies, const Provenance& provenance);
  /// Opens the file of a run that goes on from `from`, and cuts off the rows behind that.
  RunLayout(const std::string& path, const SceneDef& scene, const Bodies& bodies, const Provenance& provenance,
            const FilePosition& from);
  /// Takes over a slab and writes the chunks that are full, compressed. Readers see them after flush().
  void append(Slab slab);
  /// Makes all rows visible to readers, also those that fill no chunk, which are written again with their chunk. `sync`
  /// hands the file to the disk, and throws hdf5::Failure. Lengths are written after the rows that they count: a copy
  /// or a kill at any moment finds no row that was not written.
  void flush(const std::function<void()>& sync);
  /// Writes the remaining rows that fill no chunk, at the end of the run. Then flush().
  void append_rest();
  /// Bytes that the waiting rows and those of `slab` can take.
  std::uint64_t room_for(const Slab& slab) const;
  /// Rows that readers see after the last flush.
  const RowCount& visible() const { return visible_; }
  /// Time of the last floe frame that readers see [s].
  double saved_time() const { return saved_time_; }
  /// The rows that are written for good and those that wait.
  FilePosition position() const;
  /// The attributes of the end of a run: state hash, verdict (none without judgements), then the status.
  void set_end(const std::string& status, std::uint64_t state_hash, const RunVerdict& verdict);
  void close() { file_.close(); }
  void abandon() { file_.abandon(); }

 private:
  void renew_header(const Provenance& provenance);
  void write_header(const SceneDef& scene, const Bodies& bodies, const Provenance& provenance);
  void add_group(const std::string& group);
  template <class Row>
  void append_rows(const std::vector<RowColumn<Row>>& columns, const std::vector<Row>& rows, std::size_t count,
                   Rows kind);
  void append_stats(std::size_t count, Rows kind);
  void append_platform(std::size_t count, Rows kind);
  void append_events(std::size_t count, Rows kind);
  void append_contacts(std::size_t count, Rows kind);
  void append_splits(std::size_t count, Rows kind);
  void write_pieces(const PieceShapes& pieces);
  void append_frames(std::size_t count, Rows kind);
  void append_waiting(const RowCount& count, Rows kind);
  RowCount waiting() const;
  hsize_t width_of(const Column& column) const;
  void drop_waiting(const RowCount& count);

  std::map<std::string, hsize_t> size_;  // of the dimensions that do not grow
  ChunkShape chunk_;
  bool has_contacts_;              // the forces between bodies are recorded
  bool has_splits_;                // floes may split
  bool is_compliant_;              // the books and the forces of compliant contacts are recorded
  bool has_sides_;                 // the impulses on the sides of the platform are recorded
  std::vector<PartColumn> parts_;  // of mooring lines and thrusters
  ColumnFile file_;
  Slab waiting_;      // rows of chunks that are not full
  RowCount written_;  // for good
  RowCount visible_;
  double last_time_ = 0.0;  // of the last floe frame written for good [s]
  double saved_time_ = 0.0;
};

/// Writes the attributes of the end of a run into a file whose handle is broken, as after a failed write. Throws
/// hdf5::Failure.
void set_end_of_broken(const std::string& path, const std::string& status, std::uint64_t state_hash,
                       const RunVerdict& verdict);

}  // namespace gem
