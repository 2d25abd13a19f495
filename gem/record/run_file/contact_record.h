// The forces between bodies in a run file, frame by frame.
#pragma once

#include <cstddef>
#include <vector>

#include "gem/engine/engine.h"
#include "gem/record/run_file/run_file.h"

namespace gem {

/// The rows of /contacts. Everything throws Error(file_system) if the file is damaged.
class ContactRecord {
 public:
  /// `file` must outlive this object.
  explicit ContactRecord(const RunFile& file);

  /// Whether the run was asked for forces between bodies.
  static bool is_in(const RunFile& file) { return file.has("contacts/time"); }
  /// The forces of the floe frame at `time` [s], ascending in (a, b); none if it has no rows. A force that is no
  /// number, and bodies that the file does not have, are left out.
  std::vector<ContactForce> at(double time) const;
  std::size_t rows() const { return times_.size(); }
  /// Body number of floe 0.
  std::int32_t first_floe() const { return first_floe_; }

 private:
  const RunFile& file_;
  std::vector<double> times_;  // of the rows, ascending [s]
  std::int32_t first_floe_ = 0;
  double bodies_ = 0.0;  // of the file
};

}  // namespace gem
