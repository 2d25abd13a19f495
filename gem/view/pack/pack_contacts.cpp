// Bodies as differences from the contact before, points and forces as whole steps. page/chains.js reads them.
#include "gem/view/pack/pack_contacts.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "gem/view/pack/byte_writer.h"
#include "gem/view/pack/packet.h"

namespace gem::view {

namespace {

constexpr double place_step_m = 0.1;
constexpr double force_parts = 2000.0;
constexpr double far_m = 1e9;  // no place is farther

std::int64_t steps(double value, double step) {
  return static_cast<std::int64_t>(std::floor(std::clamp(value, -far_m, far_m) / step + 0.5));
}

void keep_largest(std::vector<ContactForce>& contacts, std::size_t most) {
  if (contacts.size() <= most) return;
  const auto size = [](const ContactForce& c) { return dot(c.force, c.force); };
  std::stable_sort(contacts.begin(), contacts.end(),
                   [&](const ContactForce& p, const ContactForce& q) { return size(p) > size(q); });
  contacts.resize(most);
  std::sort(contacts.begin(), contacts.end(),
            [](const ContactForce& p, const ContactForce& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
}

double largest_force(const std::vector<ContactForce>& contacts) {
  double largest = 0.0;
  for (const ContactForce& c : contacts) largest = std::max({largest, std::abs(c.force.x), std::abs(c.force.y)});
  return largest;
}

void write_frame(ByteWriter& out, const FrameForces& frame, double force_step) {
  out.whole(frame.contacts.size());
  std::int32_t last_a = 0;
  for (const ContactForce& c : frame.contacts) {
    out.whole(static_cast<std::uint64_t>(c.a - last_a));
    out.whole(static_cast<std::uint64_t>(c.b - c.a));
    last_a = c.a;
    const Vec2 arm = c.point - frame.place[static_cast<std::size_t>(c.b)];
    for (const double v : {arm.x, arm.y}) out.signed_whole(steps(v, place_step_m));
    for (const double v : {c.force.x, c.force.y})
      out.signed_whole(static_cast<std::int64_t>(std::floor(v / force_step + 0.5)));
  }
}

}  // namespace

std::string pack_contacts(std::vector<FrameForces> frames, std::size_t first, std::size_t most) {
  ByteWriter out;
  std::vector<double> force_steps;
  for (FrameForces& frame : frames) {
    const double largest = largest_force(frame.contacts);
    force_steps.push_back(largest > 0.0 ? largest / force_parts : 1.0);
    keep_largest(frame.contacts, most);
    write_frame(out, frame, force_steps.back());
  }
  const nlohmann::ordered_json description = {{"kind", "contacts"},     {"first", first},
                                              {"count", frames.size()}, {"place_m", place_step_m},
                                              {"force_N", force_steps}, {"most", most}};
  return packet(description, out.take());
}

std::string pack_contacts(const RunFile& file, const FrameRange& range, std::size_t most) {
  const ContactRecord record(file);
  const auto first_floe = static_cast<std::size_t>(record.first_floe());
  std::vector<FrameForces> frames;
  for (std::size_t n = 0; n < range.count; ++n) {
    const FrameView view = file.frame(range.first + n * range.stride);
    FrameForces frame{record.at(view.time), std::vector<Vec2>(first_floe + view.x.size())};
    for (std::size_t i = 0; i < view.x.size(); ++i)
      if (std::isfinite(view.x[i]) && std::isfinite(view.y[i])) frame.place[first_floe + i] = {view.x[i], view.y[i]};
    frames.push_back(std::move(frame));
  }
  return pack_contacts(std::move(frames), range.first / range.stride, most);
}

}  // namespace gem::view
