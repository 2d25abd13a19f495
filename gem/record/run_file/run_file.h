// Reads a run file: for analysis and for `gem info`.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "gem/record/verdict.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// The status of a run that ended before its case does, as `gem run --until` asks. It can go on.
inline constexpr const char* until_status = "stopped:until";

/// Whether a run with this status has all that it was asked for.
inline bool ended_as_asked(const std::string& status) { return status == "complete" || status == until_status; }

/// One frame of the floes.
struct FrameView {
  double time = 0.0;
  std::vector<float> x, y, theta, vx, vy, omega;
  std::vector<float> active;  // 0 or 1
};

/// An open run file, also one that is being written. It shows the rows that were there when it was opened: all datasets
/// of a group have the same length. Reading throws Error(file_system) that names the file and the dataset.
class RunFile {
 public:
  /// Throws Error(file_system) if the file cannot be read, is not a run file, has another schema version, or is not
  /// complete (unless allow_incomplete).
  explicit RunFile(const std::string& path, bool allow_incomplete = false);
  ~RunFile();
  RunFile(RunFile&&) noexcept;

  const std::string& path() const;
  /// "running" (also after a kill), "complete" or "stopped:<reason>".
  std::string status() const;
  /// A text attribute of the root, e.g. "gem_engine". "gem_case_toml" returns the whole case. Empty if there is none.
  std::string attribute(const std::string& name) const;
  double number_attribute(const std::string& name) const;
  /// A list of numbers, or one number, of the root.
  std::vector<double> number_list(const std::string& name) const;
  /// How contacts were solved; older files call it gem_resolution.
  std::string solver() const;
  /// A whole dataset by path, e.g. "platform/x". Two-dimensional data are row by row. Throws if it is too large for
  /// that: for_each_piece() reads columns of any length.
  std::vector<double> column(const std::string& dataset) const;
  /// `count` rows from `first` on of a dataset. Throws if they are not there.
  std::vector<double> column_rows(const std::string& dataset, std::size_t first, std::size_t count) const;
  /// Length of each dimension of a dataset.
  std::vector<std::size_t> shape(const std::string& dataset) const;
  /// Length of the first dimension of a dataset.
  std::size_t rows(const std::string& dataset) const;
  std::string units(const std::string& dataset) const;
  std::string long_name(const std::string& dataset) const;
  bool has(const std::string& dataset) const;

  std::size_t floe_count() const;
  /// Whether floes may split: pieces that were not made yet have an empty outline.
  bool has_pieces() const { return has("splits/time"); }
  /// Whether a floe of this file may have this outline.
  bool is_floe_outline(const std::vector<Vec2>& outline) const {
    return outline.size() >= 3 || (outline.empty() && has_pieces());
  }
  std::size_t frame_count() const;
  FrameView frame(std::size_t index) const;
  /// `count` frames from `first` on: faster than one by one, because frames are compressed together.
  std::vector<FrameView> frames(std::size_t first, std::size_t count) const;
  /// Outlines of the floes about their centroids [m].
  std::vector<std::vector<Vec2>> floe_outlines() const;
  /// Outlines of the fixed bodies in the world [m].
  std::vector<std::vector<Vec2>> boundary_outlines() const;
  /// Outline of the platform about its centroid [m]; empty without a platform.
  std::vector<Vec2> platform_outline() const;
  /// The outlines of its convex pieces; one for a platform of one piece, none without a platform. The outline is their
  /// corners, piece by piece.
  std::vector<std::vector<Vec2>> platform_pieces() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

/// The verdict that the run ended with. Without judgements if the file has none: it is older, or the run still runs or
/// was killed. Throws Error(file_system) if its lists differ in length.
RunVerdict verdict_of(const RunFile& file);

/// Whether the file begins with an HDF5 signature.
bool is_run_file(const std::string& path);

}  // namespace gem
