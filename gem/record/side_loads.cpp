#include "gem/record/side_loads.h"

#include <utility>

#include "gem/geometry/outline_side.h"

namespace gem {

SideLoads::SideLoads(std::vector<Vec2> outline) : outline_(std::move(outline)) {
  sums_.normal.assign(sides(), 0.0);
  sums_.friction.assign(sides(), 0.0);
}

void SideLoads::add(const ContactEvent& row, Vec2 place, Rotation rotation) {
  if (outline_.empty()) return;
  const Rotation back{rotation.cosine, -rotation.sine};
  const std::size_t side = side_of(outline_, rotate(back, row.point - place), rotate(back, row.normal));
  sums_.normal[side] += row.impulse_normal;
  // the row gives the impulse on the ice
  sums_.friction[side] -= row.impulse_tangential;
}

void SideLoads::take(std::vector<float>& normal, std::vector<float>& friction) {
  for (const double sum : sums_.normal) normal.push_back(static_cast<float>(sum));
  for (const double sum : sums_.friction) friction.push_back(static_cast<float>(sum));
  *this = SideLoads(std::move(outline_));
}

}  // namespace gem
