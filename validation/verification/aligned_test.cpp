// V55: two aligned squares meet face to face at the middle of their chord, and neither turns: in every orientation,
// order and place.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "gem/base/number_text.h"
#include "gem/base/strict_math.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Aligned : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Aligned, ::testing::ValuesIn(all_settings()), setting_name);

TEST_P(Aligned, V55_aligned_faces_do_not_turn) {
  const double speed = 0.5, gap = 1e-8;
  for (const double depth : {0.1, 1e-3, 1e-6})
    for (const Vec2 place : {Vec2{}, Vec2{3.7, -11.1}, Vec2{1e3, 333.3}}) {
      double turned = 0.0, uneven = 0.0;
      for (int k = 0; k < 60; ++k)
        for (const bool swapped : {false, true}) {
          const double angle = degrees(6.0 * k);
          const Vec2 along = rotate(strict::rotation_of_angle(angle), {1.0, 0.0});
          SceneDef scene = quiet_scene();
          scene.contact.manifold = Manifold::chord_middle;
          scene.numerics.time_step_s = depth / speed;
          scene.floe = {square(place, speed * along, angle), square(place + (10.0 + gap) * along, {}, angle)};
          if (swapped) std::swap(scene.floe[0], scene.floe[1]);
          Simulation run = start(scene, setting());
          run.advance(2);  // one brings them into each other, `depth` deep, in the other they hit
          EXPECT_EQ(run.log.quality[0].contacts, 0) << k;
          EXPECT_EQ(run.log.quality[1].contacts, 1) << k;
          for (int floe = 1; floe <= 2; ++floe) {
            turned = std::max(turned, std::fabs(run.bodies().spin[floe]));
            uneven = std::max(uneven, length(run.bodies().velocity[floe] - 0.5 * speed * along));
          }
        }
      const std::string id = "V55.depth_" + number_text(depth) + ".at_" + number_text(place.x);
      // A place is rounded to 1.1e-13 m at 1e3 m from the origin: a tilt of 1e-14 of the chord of 10 m.
      check_value(id + ".spin", 0.0, turned, rounding, "rad/s", where());
      check_value(id + ".speed", 0.0, uneven, rounding, "m/s", where());
    }
}

}  // namespace
}  // namespace gem::verification
