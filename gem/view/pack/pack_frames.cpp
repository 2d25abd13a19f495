// Foretells each value from the frame before and keeps the difference. page/unpack.js does the same in reverse: both
// use the same operations of double precision in the same order.
#include "gem/view/pack/pack_frames.h"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "gem/view/pack/byte_writer.h"
#include "gem/view/pack/packet.h"

namespace gem::view {

namespace {

constexpr double frame_steps_maximum = 1e9;  // steps; beyond it a value counts as no number

struct Whole {
  std::vector<std::int64_t> x, y, theta, vx, vy, omega;
  explicit Whole(std::size_t floes) : x(floes), y(floes), theta(floes), vx(floes), vy(floes), omega(floes) {}
};

double nearest(double value) { return std::floor(value + 0.5); }

/// Difference of two angles in steps, within half a turn.
std::int64_t within_half_turn(std::int64_t difference) {
  const std::int64_t turn = turn_steps;
  const std::int64_t rest = ((difference % turn) + turn) % turn;
  return rest >= turn / 2 ? rest - turn : rest;
}

/// The shift that a mean speed leads to; none if times of a damaged file make it absurd.
std::int64_t foretold(double steps) {
  return std::abs(steps) <= frame_steps_maximum ? static_cast<std::int64_t>(nearest(steps)) : 0;
}

/// One frame of the file in steps. `there`: which floes have values.
struct RoundedFrame {
  Whole value;
  std::vector<std::uint8_t> there;
};

RoundedFrame rounded(const FrameView& frame, const Rounding& step) {
  RoundedFrame out{Whole(frame.x.size()), std::vector<std::uint8_t>(frame.x.size())};
  for (std::size_t i = 0; i < frame.x.size(); ++i) {
    const double value[] = {
        nearest(double(frame.x[i]) / step.place_m),        nearest(double(frame.y[i]) / step.place_m),
        nearest(double(frame.theta[i]) / step.angle_rad),  nearest(double(frame.vx[i]) / step.speed_m_per_s),
        nearest(double(frame.vy[i]) / step.speed_m_per_s), nearest(double(frame.omega[i]) / step.spin_rad_per_s)};
    bool finite = frame.active[i] != 0.0F;
    for (const double v : value) finite = finite && std::abs(v) <= frame_steps_maximum;
    if (!finite) continue;
    out.there[i] = 1;
    std::vector<std::int64_t>* const columns[] = {&out.value.x,  &out.value.y,  &out.value.theta,
                                                  &out.value.vx, &out.value.vy, &out.value.omega};
    for (int k = 0; k < 6; ++k) (*columns[k])[i] = static_cast<std::int64_t>(value[k]);
  }
  return out;
}

using StepColumn = std::vector<std::int64_t>;

class FramePacker {
 public:
  FramePacker(std::size_t floes, const Rounding& step)
      : last_{Whole(floes), std::vector<std::uint8_t>(floes)}, step_(step) {}

  void add(RoundedFrame now, double seconds) {
    write_changes(out_, last_.there, now.there);
    const double places = step_.speed_m_per_s * seconds / (2.0 * step_.place_m);
    const double angles = step_.spin_rad_per_s * seconds / (2.0 * step_.angle_rad);
    add_speed(now, &Whole::vx);
    add_speed(now, &Whole::vy);
    add_speed(now, &Whole::omega);
    add_place(now, &Whole::x, &Whole::vx, places, false);
    add_place(now, &Whole::y, &Whole::vy, places, false);
    add_place(now, &Whole::theta, &Whole::omega, angles, true);
    keep_gone(now);
    last_ = std::move(now);
  }
  std::string take() { return out_.take(); }

 private:
  void add_speed(const RoundedFrame& now, StepColumn Whole::*column) {
    for (std::size_t i = 0; i < now.there.size(); ++i)
      if (now.there[i]) out_.signed_whole((now.value.*column)[i] - (last_.value.*column)[i]);
  }

  void add_place(const RoundedFrame& now, StepColumn Whole::*place, StepColumn Whole::*speed, double ratio,
                 bool angle) {
    for (std::size_t i = 0; i < now.there.size(); ++i) {
      if (!now.there[i]) continue;
      const double mean = double((now.value.*speed)[i] + (last_.value.*speed)[i]);
      const std::int64_t shift = foretold(mean * ratio);
      const std::int64_t rest = (now.value.*place)[i] - (last_.value.*place)[i] - shift;
      out_.signed_whole(angle ? within_half_turn(rest) : rest);
    }
  }

  /// A floe without values stays where it was.
  void keep_gone(RoundedFrame& now) const {
    for (std::size_t i = 0; i < now.there.size(); ++i) {
      if (now.there[i]) continue;
      for (StepColumn Whole::*column : {&Whole::x, &Whole::y, &Whole::theta, &Whole::vx, &Whole::vy, &Whole::omega})
        (now.value.*column)[i] = (last_.value.*column)[i];
    }
  }

  ByteWriter out_;
  RoundedFrame last_;
  Rounding step_;
};

}  // namespace

std::string pack_frames(const std::vector<FrameView>& frames, std::size_t first, std::size_t floes,
                        const Rounding& rounding) {
  std::vector<double> times;
  FramePacker packer(floes, rounding);
  for (const FrameView& frame : frames) {
    const double seconds = times.empty() ? 0.0 : frame.time - times.back();
    times.push_back(frame.time);
    packer.add(rounded(frame, rounding), seconds);
  }
  const nlohmann::ordered_json description = {{"kind", "frames"},
                                              {"first", first},
                                              {"count", frames.size()},
                                              {"floes", floes},
                                              {"turn_steps", turn_steps},
                                              {"angle_rad", rounding.angle_rad},
                                              {"place_m", rounding.place_m},
                                              {"speed_m_per_s", rounding.speed_m_per_s},
                                              {"spin_rad_per_s", rounding.spin_rad_per_s},
                                              {"time_s", times}};
  return packet(description, packer.take());
}

std::string pack_frames(const RunFile& file, const FrameRange& range, const Rounding& rounding) {
  std::vector<FrameView> frames;
  if (range.count > 0) frames = file.frames(range.first, (range.count - 1) * range.stride + 1);
  if (range.stride > 1)
    for (std::size_t n = 1; n < range.count; ++n) frames[n] = std::move(frames[n * range.stride]);
  frames.resize(range.count);
  return pack_frames(frames, range.first / range.stride, file.floe_count(), rounding);
}

}  // namespace gem::view
