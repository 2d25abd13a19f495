// Joins what presses on the platform, a row for each floe and time step, to hits: from first touch to release.
//
// One hit is one event. Its crushing peak, closing speed and effective mass are those of the first touch, so they do
// not depend on the time step. While a floe lies on the platform its force vanishes again and again for up to two
// seconds, since its neighbours push it about. Faces that touch again are almost parallel, the more so the shorter the
// time step, and a flat touch has a large crushing peak whatever its energy. So a floe hits anew only after a release.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "gem/engine/engine.h"

namespace gem {

/// A force window moves in so many parts at most, whatever the time step.
inline constexpr std::int64_t window_parts = 16;

/// A hit of one floe.
struct Hit {
  ContactEvent first;               // the first time step
  double impulse_normal = 0.0;      // until release [N s]
  double impulse_tangential = 0.0;  // until release, along the normal turned left [N s]
  double depth = 0.0;               // largest overlap depth until release [m]
  double largest_force = 0.0;       // compliant: largest normal force until release [N]
  double duration = 0.0;            // from the first to the end of the last time step that presses [s]
  double window_impulse = 0.0;      // largest normal impulse in a force window [N s]
  double window_end = 0.0;          // end of that window [s]
};

/// A hit of a floe that still presses.
struct OpenHit {
  Hit hit;
  std::int64_t begin = 0, end = 0;  // time steps that press: the first, and one after the last
  /// Normal impulse of the last parts of a window [N s]; part n of the run is at n % window_parts.
  std::array<double, window_parts> part{};
  std::int64_t last_part = 0;  // the newest of them
};

struct HitRule {
  double release_s = 0.0;              // a floe that has not pressed for this long hits anew
  double closing_speed_m_per_s = 0.0;  // hits that do not close faster are left out
  double window_s = 1.0;               // force window
};

/// Hits come out in the order of their release, then of body numbers, however many time steps are added at once.
class Hits {
 public:
  Hits(HitRule rule, double time_step_s);
  /// Adds rows up to the end of time step `step`, in order of time. Appends the hits that are released by then to
  /// `ended`.
  void add(const std::vector<ContactEvent>& rows, std::int64_t step, std::vector<Hit>& ended);
  /// Appends the hits that are not released.
  void end_all(std::vector<Hit>& ended);
  /// The hits that are not released, by body number.
  std::vector<OpenHit> open() const;
  /// Goes on with hits that are not released.
  void restore(const std::vector<OpenHit>& open);

 private:
  using Released = std::vector<OpenHit>;

  std::int64_t release_of(const OpenHit& open) const { return open.end + release_steps_; }
  void take(const ContactEvent& row, Released& released);
  void add_to_window(OpenHit& open, std::int64_t step, double impulse) const;
  void append(Released& released, std::vector<Hit>& ended) const;

  HitRule rule_;
  double time_step_;
  std::int64_t release_steps_;
  std::int64_t part_steps_, parts_;       // of a force window
  std::map<std::int32_t, OpenHit> open_;  // by body number
};

}  // namespace gem
