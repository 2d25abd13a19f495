// The path of a ship in transit, and where it leads in each time step. Host only.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/events/platform/transit.h"

namespace gem {

/// Place on a path, and its direction there.
struct PathPlace {
  Vec2 place;  // [m]
  Rotation course;
};

class TransitPath {
 public:
  TransitPath() = default;
  /// From `start` [m] with the yaw `yaw` [rad].
  TransitPath(const TransitDef& def, Vec2 start, double yaw);

  bool present() const { return !pieces_.empty(); }
  /// At a distance along the path [m].
  PathPlace at(double distance) const;
  /// In a time step of `dt` [s], counted from 0. The path does not lead on a ship that runs free: it stays at its
  /// start.
  TowStep step(std::int64_t number, double dt) const;
  /// Of the ship at the start [m/s], for time steps of `dt` [s].
  Vec2 start_velocity(double dt) const;
  /// Of all pieces up to the last way point [m].
  double length() const;

 private:
  /// A straight piece, or an arc with a curvature: positive to the left.
  struct Piece {
    double begin, length;  // along the path [m]
    Vec2 from;             // [m]
    Rotation course;       // at its begin
    double curvature;      // [1/m]
  };
  void append(double length, Rotation course, double curvature);
  static PathPlace on(const Piece& piece, double distance);

  double speed_ = 0.0;        // at which it leads [m/s]; of a ship that runs free 0
  double start_speed_ = 0.0;  // [m/s]
  Vec2 start_;
  Rotation yaw_;
  std::vector<Piece> pieces_;  // the last one goes on
};

/// What the arcs at its ends leave of each leg between way points [m]; negative: they do not fit. A way point on the
/// one before it leaves not a number.
std::vector<double> straight_rests(const TransitDef& def, Vec2 start);

}  // namespace gem
