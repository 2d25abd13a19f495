#include "gem/record/side_loads.h"

#include <utility>

#include "gem/geometry/outline_side.h"

namespace gem {

SideLoads::SideLoads(std::vector<Vec2> outline) : SideLoads(std::vector<std::vector<Vec2>>{std::move(outline)}) {}

SideLoads::SideLoads(std::vector<std::vector<Vec2>> pieces) : pieces_(std::move(pieces)) { clear(); }

void SideLoads::clear() {
  std::size_t sides = 0;
  first_.clear();
  for (const std::vector<Vec2>& piece : pieces_) {
    first_.push_back(sides);
    sides += piece.size();
  }
  sums_.normal.assign(sides, 0.0);
  sums_.friction.assign(sides, 0.0);
}

void SideLoads::add(const ContactEvent& row, Vec2 place, Rotation rotation) {
  if (sides() == 0) return;
  const auto piece = static_cast<std::size_t>(row.body_a);
  const Rotation back{rotation.cosine, -rotation.sine};
  const std::size_t side =
      first_[piece] + side_of(pieces_[piece], rotate(back, row.point - place), rotate(back, row.normal));
  sums_.normal[side] += row.impulse_normal;
  // the row gives the impulse on the ice
  sums_.friction[side] -= row.impulse_tangential;
}

void SideLoads::take(std::vector<float>& normal, std::vector<float>& friction) {
  for (const double sum : sums_.normal) normal.push_back(static_cast<float>(sum));
  for (const double sum : sums_.friction) friction.push_back(static_cast<float>(sum));
  clear();
}

}  // namespace gem
