// The pairs of bodies whose corners may overlap within a time step, found once at its start.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gem/engine/contact/corners.h"
#include "gem/engine/contact/pair_watch.h"
#include "gem/engine/contact/sub_body.h"
#include "gem/engine/cpu/thread_team.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// A corner of one body of a contact, p, within reach of the other, q.
struct CornerInReach {
  std::int32_t contact = 0, corner = 0, side = 0;
  bool of_b = false;    // p is b of the contact, else a
  bool counts = false;  // for the stability limit: it is within reach of the present motion

  std::int32_t p(const Contact& c) const { return of_b ? c.b : c.a; }
  std::int32_t q(const Contact& c) const { return of_b ? c.a : c.b; }
};

/// Two bodies and their corners; the platform is one body, of several pieces maybe.
struct PairInReach {
  std::int32_t a = 0, b = 0;          // entries of the bodies
  std::int32_t contact = 0;           // of the first piece
  std::int32_t first = 0, count = 0;  // corners
  PairWatch watch;
};

class PairsInReach {
 public:
  /// Velocities before the other loads of the time step, to be set before they act.
  void note_velocities(const FieldState& f);

  /// Called by every thread of a team.
  void find(const FieldState& f, Contacts contacts, std::int64_t substeps, ThreadTeam& team, int rank);

  std::span<const CornerInReach> corners() const { return corner_; }
  std::span<const PairInReach> pairs() const { return pair_; }
  /// Bodies with corners within reach, and the platform. By entry, like body_id() and share().
  std::span<SubBody> bodies() { return body_; }
  std::span<const std::int32_t> body_id() const { return body_id_; }
  /// Corners within reach that share the mass of a body.
  std::int32_t share(std::int32_t entry) const { return share_[entry] > 0 ? share_[entry] : 1; }
  /// Its entry; -1: there is none.
  std::int32_t platform() const { return platform_; }

  Surface surface_of(const FieldState& f, std::int32_t body) const;
  Vec2 velocity_before(std::int32_t body) const { return velocity_before_[body]; }
  double spin_before(std::int32_t body) const { return spin_before_[body]; }

 private:
  void find_corners(const FieldState& f, Contacts contacts, const ThreadTeam& team, int rank);
  void lay_out(const FieldState& f, Contacts contacts, std::int64_t substeps, int threads);
  std::int32_t enter(const FieldState& f, std::int32_t body, std::int64_t substeps);
  void watch_pair(const FieldState& f, Contacts contacts, double h, PairInReach& pair);

  struct alignas(64) Part {  // one per thread
    std::vector<CornerInReach> corner;
  };
  std::vector<Part> part_;
  std::vector<CornerInReach> corner_;
  std::vector<PairInReach> pair_;
  std::vector<SubBody> body_;
  std::vector<std::int32_t> body_id_, share_;
  std::vector<std::int32_t> entry_of_;  // per body; -1: none
  std::int32_t platform_ = -1;
  std::vector<std::uint8_t> hidden_side_, no_corner_;  // of the pieces of the platform, indexed as bodies.vertex
  std::vector<Vec2> velocity_before_;                  // [m/s]
  std::vector<double> spin_before_;                    // [rad/s]
};

/// Place of a body at the start of the time step: the platform moves in every substep [m].
inline Vec2 start_of(const FieldState& f, std::int32_t body) {
  return f.constants.is_platform(body) ? f.platform_position : f.bodies.position[body];
}

}  // namespace gem
