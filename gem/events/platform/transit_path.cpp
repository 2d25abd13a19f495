// Straight legs and arcs from way points.
#include "gem/events/platform/transit_path.h"

#include <cmath>

#include "gem/base/strict_math.h"

namespace gem {
namespace {

Rotation product(Rotation p, Rotation q) {
  return {p.cosine * q.cosine - p.sine * q.sine, p.sine * q.cosine + p.cosine * q.sine};
}

Rotation inverse(Rotation q) { return {q.cosine, -q.sine}; }

/// A leg between two way points.
struct Leg {
  double length;
  Rotation course;
};

std::vector<Leg> legs_of(const TransitDef& def, Vec2 start) {
  std::vector<Leg> legs;
  for (const auto& [x, y] : def.way_point_m) {
    const Vec2 way = Vec2{x, y} - start;
    const double size = gem::length(way);
    legs.push_back({size, {way.x / size, way.y / size}});
    start = {x, y};
  }
  return legs;
}

/// How far before and after a corner its arc touches the legs: R tan of half the turn.
double touching(const Leg& from, const Leg& to, double radius) {
  const Rotation turn = product(to.course, inverse(from.course));
  return radius * std::abs(turn.sine) / (1.0 + turn.cosine);
}

/// The same at the end of leg k; 0 at the last.
double touching(const std::vector<Leg>& legs, std::size_t k, double radius) {
  return k + 1 < legs.size() ? touching(legs[k], legs[k + 1], radius) : 0.0;
}

}  // namespace

std::vector<double> straight_rests(const TransitDef& def, Vec2 start) {
  const std::vector<Leg> legs = legs_of(def, start);
  std::vector<double> rests;
  for (std::size_t k = 0; k < legs.size(); ++k) {
    const double before = k > 0 ? touching(legs, k - 1, def.turn_radius_m) : 0.0;
    const double rest = legs[k].length - before - touching(legs, k, def.turn_radius_m);
    rests.push_back(legs[k].length > 0.0 ? rest : std::nan(""));
  }
  return rests;
}

TransitPath::TransitPath(const TransitDef& def, Vec2 start, double yaw)
    : speed_(runs_free(def) ? 0.0 : def.speed_m_per_s),
      start_speed_(def.speed_m_per_s),
      start_(start),
      yaw_(strict::rotation_of_angle(yaw)) {
  if (!in_transit(def)) return;
  const std::vector<Leg> legs = legs_of(def, start);
  const std::vector<double> rests = straight_rests(def, start);
  for (std::size_t k = 0; k < legs.size(); ++k) {
    append(rests[k], legs[k].course, 0.0);
    if (k + 1 == legs.size()) break;
    const double turn = strict::angle_of(product(legs[k + 1].course, inverse(legs[k].course)));
    if (turn != 0.0)
      append(std::abs(turn) * def.turn_radius_m, legs[k].course, (turn > 0.0 ? 1.0 : -1.0) / def.turn_radius_m);
  }
  if (legs.empty()) append(0.0, strict::rotation_of_angle(def.course_rad), 0.0);
}

void TransitPath::append(double length, Rotation course, double curvature) {
  const bool first = pieces_.empty();
  const double begin = first ? 0.0 : pieces_.back().begin + pieces_.back().length;
  const Vec2 from = first ? start_ : on(pieces_.back(), begin).place;
  pieces_.push_back({begin, length, from, course, curvature});
}

PathPlace TransitPath::on(const Piece& piece, double distance) {
  const double way = distance - piece.begin;
  if (piece.curvature == 0.0) return {piece.from + way * Vec2{piece.course.cosine, piece.course.sine}, piece.course};
  const Rotation turn = strict::rotation_of_angle(way * piece.curvature);
  const Vec2 chord = (1.0 / piece.curvature) * Vec2{turn.sine, 1.0 - turn.cosine};
  return {piece.from + rotate(piece.course, chord), product(turn, piece.course)};
}

PathPlace TransitPath::at(double distance) const {
  std::size_t k = 0;
  while (k + 1 < pieces_.size() && distance >= pieces_[k + 1].begin) ++k;
  return on(pieces_[k], distance);
}

TowStep TransitPath::step(std::int64_t number, double dt) const {
  const double from = static_cast<double>(number) * dt * speed_, to = static_cast<double>(number + 1) * dt * speed_;
  const PathPlace now = at(from), next = at(to);
  const Rotation since_start = product(now.course, inverse(pieces_.front().course));
  return {now.place, product(since_start, yaw_), (1.0 / dt) * (next.place - now.place),
          strict::angle_of(product(next.course, inverse(now.course))) / dt};
}

Vec2 TransitPath::start_velocity(double dt) const {
  const Rotation course = pieces_.front().course;
  return speed_ > 0.0 ? step(0, dt).velocity : start_speed_ * Vec2{course.cosine, course.sine};
}

double TransitPath::length() const { return pieces_.empty() ? 0.0 : pieces_.back().begin + pieces_.back().length; }

}  // namespace gem
