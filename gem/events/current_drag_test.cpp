// Current drag: exact over a time step of any length, for slip and spin, quadratic and linear.
#include "gem/events/current_drag.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gem {
namespace {

constexpr double drag_rate = 0.0745;
constexpr Vec2 slip0{0.3, -0.4};

/// Path of the slip over a time step: (final slip) x dt plus the correction.
Vec2 path(const DragSolution& drag, double dt) { return drag.path_correction + dt * drag.slip; }

TEST(CurrentDrag, QuadraticMatchesItsClosedForm) {
  for (const double dt : {1e-6, 0.05, 10.0, 1000.0}) {
    const DragSolution drag = drag_quadratic(drag_rate, slip0, 0.5, dt);
    const double z = drag_rate * 0.5 * dt;
    EXPECT_NEAR(drag.slip.x * (1.0 + z) / 0.3, 1.0, 1e-15);
    EXPECT_NEAR(drag.slip.y * (1.0 + z) / -0.4, 1.0, 1e-15);
    EXPECT_NEAR(length(path(drag, dt)) * drag_rate / std::log1p(z), 1.0, 1e-14);
  }
}

TEST(CurrentDrag, TwoHalvesAreOneTimeStep) {
  for (const double dt : {0.05, 7.0, 1000.0}) {
    const DragSolution whole = drag_quadratic(drag_rate, slip0, 0.5, dt);
    const DragSolution first = drag_quadratic(drag_rate, slip0, 0.5, 0.5 * dt);
    const DragSolution second = drag_quadratic(drag_rate, first.slip, length(first.slip), 0.5 * dt);
    EXPECT_NEAR(second.slip.x / whole.slip.x, 1.0, 1e-14);
    EXPECT_NEAR(second.slip.y / whole.slip.y, 1.0, 1e-14);
    const Vec2 halves = path(first, 0.5 * dt) + path(second, 0.5 * dt);
    EXPECT_NEAR(halves.x / path(whole, dt).x, 1.0, 1e-14);

    const double decay = std::exp(-dt / 20.0), half_decay = std::exp(-0.5 * dt / 20.0);
    const DragSolution linear = drag_linear(0.05, slip0, decay, dt);
    const DragSolution one = drag_linear(0.05, slip0, half_decay, 0.5 * dt);
    const DragSolution two = drag_linear(0.05, one.slip, half_decay, 0.5 * dt);
    EXPECT_NEAR(two.slip.x / linear.slip.x, 1.0, 1e-13);
    const Vec2 linear_halves = path(one, 0.5 * dt) + path(two, 0.5 * dt);
    EXPECT_NEAR(linear_halves.x / path(linear, dt).x, 1.0, 1e-12);
    EXPECT_NEAR(path(linear, dt).x / (20.0 * (slip0.x - linear.slip.x)), 1.0, 1e-12);
  }
}

TEST(CurrentDrag, SpinFollowsTheSameLaw) {
  for (const double spin : {0.02, -0.02}) {
    const SpinDragSolution turn = spin_drag_quadratic(3.0, spin, 50.0);
    EXPECT_NEAR(turn.spin / (spin / (1.0 + 3.0 * 0.02 * 50.0)), 1.0, 1e-15);
    const double angle = turn.angle_correction + 50.0 * turn.spin;
    EXPECT_NEAR(angle / (std::copysign(std::log1p(3.0) / 3.0, spin)), 1.0, 1e-14);
    const SpinDragSolution linear = spin_drag_linear(0.05, spin, std::exp(-2.5), 50.0);
    EXPECT_NEAR(linear.spin / (spin * std::exp(-2.5)), 1.0, 1e-15);
    EXPECT_NEAR((linear.angle_correction + 50.0 * linear.spin) / (20.0 * (spin - linear.spin)), 1.0, 1e-14);
  }
}

TEST(CurrentDrag, NoSlipNoDrag) {
  const DragSolution still = drag_quadratic(drag_rate, {}, 0.0, 0.05);
  EXPECT_EQ(still.slip.x, 0.0);
  EXPECT_EQ(still.path_correction.x, 0.0);
  const DragSolution undragged = drag_quadratic(0.0, slip0, 0.5, 0.05);
  EXPECT_EQ(undragged.slip.x, slip0.x);
  EXPECT_EQ(undragged.path_correction.y, 0.0);
  EXPECT_EQ(spin_drag_quadratic(3.0, 0.0, 0.05).spin, 0.0);
  EXPECT_EQ(spin_drag_quadratic(3.0, 0.0, 0.05).angle_correction, 0.0);
}

TEST(CurrentDrag, SmallSlipLosesNoDigits) {
  // the correction is the difference of two nearly equal numbers: dt (z/2 + ...) with an error of a few rounding units
  // of dt
  const double dt = 0.05, z = drag_rate * 1e-9 * dt;
  const DragSolution drag = drag_quadratic(drag_rate, {1e-9, 0.0}, 1e-9, dt);
  EXPECT_NEAR(drag.path_correction.x, dt * 0.5 * z * 1e-9, 1e-15 * dt * 1e-9);
}

}  // namespace
}  // namespace gem
