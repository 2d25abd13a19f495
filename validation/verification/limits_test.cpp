// Known limits of the methods, measured: V52, the elastic stress gives speed back.
#include <cmath>

#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Limits : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Limits, ::testing::ValuesIn(all_settings()), setting_name);

TEST_P(Limits, V52_elastic_stress_gives_speed_back) {
  for (const double dt : {0.2, 0.1, 0.05, 0.025}) {
    const double closing = 0.5, gap = 1e-9;
    SceneDef scene = quiet_scene();
    scene.numerics.time_step_s = dt;
    scene.contact.manifold = Manifold::chord_middle;
    scene.contact.elastic_stiffness_N_per_m = 1e6;
    scene.floe = {square({-5.0 - 0.5 * gap, 0.0}, {0.5 * closing, 0.0}),
                  square({5.0 + 0.5 * gap, 0.0}, {-0.5 * closing, 0.0})};
    Simulation run = start(scene, setting());
    run.advance(40);
    int touched = 0;
    for (const StepQuality& quality : run.log.quality) touched += quality.contacts > 0;
    EXPECT_GT(touched, 0) << "the floes never met";
    const double parting = run.bodies().velocity[2].x - run.bodies().velocity[1].x;
    // independent sees the floes as deep as one time step brings them. The stress of that depth then pushes without
    // resistance, and a contact does not pull, so no later time step takes the speed back.
    const double phase = dt * std::sqrt(1e6 / 22500.0);
    const double given_back = setting().coupled() ? 0.0 : std::pow(phase / (1.0 + phase), 2);
    check_value("V52.dt_" + std::to_string(dt).substr(0, 5), given_back, parting / closing,
                setting().coupled() ? 1e-12 : 2.0 * gap / (closing * dt), "-", where());
    expect_closed_books(run);
  }
}

}  // namespace
}  // namespace gem::verification
