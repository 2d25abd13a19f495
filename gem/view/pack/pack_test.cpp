// Packets are read back by a reader of their own, and compared with what was packed, to the stated rounding.
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "gem/view/pack/pack_column.h"
#include "gem/view/pack/pack_frames.h"
#include "gem/view/pack/packet.h"

namespace gem::view {
namespace {

/// The numbers of a packet, in order.
class Reader {
 public:
  explicit Reader(std::string bytes) : bytes_(std::move(bytes)) {}
  std::uint64_t whole() {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes_.at(at_++));
      value |= std::uint64_t(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
  }
  std::int64_t signed_whole() {
    const std::uint64_t value = whole();
    return value % 2 == 0 ? std::int64_t(value / 2) : -std::int64_t(value / 2) - 1;
  }
  void changes(std::vector<bool>& flags) {
    std::size_t at = 0;
    for (std::uint64_t left = whole(); left > 0; --left) {
      at += whole();
      flags.at(at) = !flags.at(at);
    }
  }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

struct Opened {
  nlohmann::json head;
  Reader numbers;
};

Opened open(const std::string& packet) {
  std::size_t size = 0;
  for (int i = 0; i < 4; ++i) size |= std::size_t(static_cast<unsigned char>(packet.at(std::size_t(i)))) << (8 * i);
  std::string out(1 << 22, '\0');
  uLongf length = out.size();
  const auto* data = reinterpret_cast<const Bytef*>(packet.data() + 4 + size);
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(out.data()), &length, data, packet.size() - 4 - size), Z_OK);
  out.resize(length);
  return {nlohmann::json::parse(packet.substr(4, size)), Reader(out)};
}

/// Places and angles of the floes, frame after frame; empty for a floe without values.
struct Read {
  std::vector<std::vector<double>> x, theta, omega;
  std::vector<std::vector<bool>> there;
};

Read read_frames(const std::string& packet) {
  auto [head, numbers] = open(packet);
  const std::size_t floes = head.at("floes"), frames = head.at("count");
  Read out;
  std::vector<bool> there(floes);
  std::vector<std::vector<std::int64_t>> last(6, std::vector<std::int64_t>(floes));  // vx vy omega x y theta
  const std::string names[] = {"speed_m_per_s", "speed_m_per_s", "spin_rad_per_s", "place_m", "place_m", "angle_rad"};
  for (std::size_t n = 0; n < frames; ++n) {
    numbers.changes(there);
    const double seconds = n == 0 ? 0.0 : double(head["time_s"][n]) - double(head["time_s"][n - 1]);
    auto now = last;
    for (std::size_t column = 0; column < 6; ++column) {
      for (std::size_t i = 0; i < floes; ++i) {
        if (!there[i]) continue;
        now[column][i] += numbers.signed_whole();
        if (column < 3) continue;
        const double ratio = double(head[names[column - 3]]) * seconds / (2.0 * double(head[names[column]]));
        now[column][i] += std::int64_t(std::floor(double(now[column - 3][i] + last[column - 3][i]) * ratio + 0.5));
      }
    }
    const auto values = [&](std::size_t column) {
      std::vector<double> all;
      for (const std::int64_t steps : now[column]) all.push_back(double(steps) * double(head[names[column]]));
      return all;
    };
    out.x.push_back(values(3));
    out.theta.push_back(values(5));
    out.omega.push_back(values(2));
    out.there.push_back(there);
    last = now;
  }
  EXPECT_TRUE(numbers.at_end());
  return out;
}

/// Three floes: one drifts, one turns fast and leaves, one is nowhere in the middle frame.
std::vector<FrameView> frames() {
  std::vector<FrameView> all;
  for (int n = 0; n < 3; ++n) {
    const float t = 10.0F * float(n);
    FrameView frame{double(t),           {-1500.0F + 0.25F * t, 7.0F, 3.0F},
                    {1.0F, 2.0F, -3.0F}, {0.1F, 3.1F - t, 0.0F},
                    {0.25F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F},
                    {0.0F, -1.0F, 0.0F}, {1.0F, n < 2 ? 1.0F : 0.0F, 1.0F}};
    if (n == 1) frame.x[2] = std::numeric_limits<float>::quiet_NaN();
    all.push_back(frame);
  }
  return all;
}

TEST(PackFrames, ReadsBackToTheStatedRounding) {
  const Rounding rounding = rounding_for({{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}}, 10.0);
  const std::vector<FrameView> all = frames();
  const Read read = read_frames(pack_frames(all, 0, 3, rounding));
  const double turn = 2.0 * 3.14159265358979323846;
  for (std::size_t n = 0; n < 3; ++n)
    for (std::size_t i = 0; i < 3; ++i) {
      const bool there = all[n].active[i] != 0.0F && std::isfinite(all[n].x[i]);
      EXPECT_EQ(read.there[n][i], there) << n << " " << i;
      if (!there) continue;
      // half a step and the rounding of the division
      EXPECT_NEAR(read.x[n][i], double(all[n].x[i]), 0.5000001 * rounding.place_m) << n << " " << i;
      EXPECT_NEAR(read.omega[n][i], double(all[n].omega[i]), 0.5000001 * rounding.spin_rad_per_s) << n << " " << i;
      EXPECT_NEAR(std::remainder(read.theta[n][i] - double(all[n].theta[i]), turn), 0.0, 0.5000001 * rounding.angle_rad)
          << n << " " << i;
    }
}

TEST(PackFrames, FloesThatDriftTakeHardlyAnyRoom) {
  std::vector<FrameView> drift, shaken;
  std::mt19937 random(1);
  for (int n = 0; n < 20; ++n) {
    FrameView frame{10.0 * n, {}, {}, {}, {}, {}, {}, {}};
    for (int i = 0; i < 500; ++i) {
      frame.x.push_back(3.7F * float(i) + 2.5F * float(n));
      for (auto* zero : {&frame.y, &frame.theta, &frame.vy, &frame.omega}) zero->push_back(0.0F);
      frame.vx.push_back(0.25F);
      frame.active.push_back(1.0F);
    }
    drift.push_back(frame);
    for (int i = 0; i < 500; ++i) frame.x[std::size_t(i)] += 0.01F * float(random() % 101);
    shaken.push_back(frame);
  }
  const Rounding rounding = rounding_for({}, 10.0);
  const std::size_t quiet = pack_frames(drift, 0, 500, rounding).size();
  EXPECT_LT(quiet, 3000U);  // 10000 places
  EXPECT_GT(pack_frames(shaken, 0, 500, rounding).size(), 2 * quiet);
}

TEST(Rounding, StepsSuitTheSmallestFloeAndTheTimeBetweenFrames) {
  const std::vector<Vec2> small = {{-0.05, -0.05}, {0.05, -0.05}, {0.05, 0.05}};
  EXPECT_DOUBLE_EQ(rounding_for({small}, 10.0).place_m, 1e-4);
  EXPECT_DOUBLE_EQ(rounding_for({}, 10.0).place_m, 0.01);
  EXPECT_DOUBLE_EQ(rounding_for({}, 100.0).speed_m_per_s, 1e-4);
  EXPECT_DOUBLE_EQ(rounding_for({}, 0.1).speed_m_per_s, 1e-3);
}

void expect_column(const std::vector<double>& values, double step, int order) {
  ByteWriter out;
  EXPECT_EQ(write_column(out, values, step), order);
  Reader numbers(out.take());
  std::vector<bool> turned(values.size());
  numbers.changes(turned);
  bool missing = false;
  std::int64_t one = 0, two = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::int64_t base = order == 2 && i > 0 ? 2 * one - (i > 1 ? two : one) : one;
    two = one;
    one = base + numbers.signed_whole();
    missing = missing != turned[i];
    EXPECT_EQ(missing, !std::isfinite(values[i])) << i;
    if (!missing) {
      EXPECT_NEAR(double(one) * step, values[i], 0.5000001 * step) << i;
    }
  }
  EXPECT_TRUE(numbers.at_end());
}

TEST(PackColumn, ReadsBackToTheStatedRounding) {
  const double none = std::nan("");
  expect_column({0.0, 0.2, 0.4, 0.6, 0.8, 1.0}, 1e-6, 2);
  expect_column({5.0, -3.0, 7.5, 0.0, 1e6, -2.0}, 0.01, 1);
  expect_column({none, 1.0, none, none, 2.0, 2.0, none}, 0.1, 1);
  expect_column({}, 1.0, 1);
}

}  // namespace
}  // namespace gem::view
