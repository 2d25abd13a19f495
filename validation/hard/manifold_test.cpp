// The two manifolds compared: chord_ends, the default of coupled, and chord_middle.
#include <algorithm>
#include <cmath>

#include "gem/field/field.h"
#include "validation/hard/hard.h"
#include "validation/hard/tight_field.h"

namespace gem::hard {
namespace {

class HardManifold : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, HardManifold, ::testing::ValuesIn(verification::all_settings()),
                         verification::setting_name);

const char* name_of(Manifold manifold) { return manifold == Manifold::chord_ends ? "ends" : "middle"; }

/// A floe over a ledge that ends 1 m beyond its centre, so that 6 m of its face lie on the ledge.
SceneDef on_a_ledge(const Setting& setting, Manifold manifold) {
  SceneDef scene = read_hard_case("H05_parallel_faces.toml", setting);
  scene.contact.manifold = manifold;
  scene.floe[0].angle_rad = 0.0;
  scene.fixed[0].outline_m = {{-64.0, -16.0}, {1.0, -16.0}, {1.0, 0.0}, {-64.0, 0.0}};
  return scene;
}

TEST_P(HardManifold, F1_a_face_lands_on_a_ledge) {
  const double speed = 0.25;
  for (const Manifold manifold : {Manifold::chord_ends, Manifold::chord_middle}) {
    SceneDef scene = on_a_ledge(setting(), manifold);
    scene.water.drag_law = DragLaw::none;
    scene.ice.friction_ice = 0.0;
    scene.contact.elastic_stiffness_N_per_m = 0.0;
    scene.numerics.residual_tolerance = 1e-14;
    scene.numerics.iterations_maximum = 20000;
    scene.floe[0].velocity_m_per_s = {0.0, -speed};
    scene.floe[0].position_m.y = 5.0 - verification::touch;
    Watched run(scene, setting());
    run.advance(1);
    // With both ends the centre lies over the face and the floe stops. A single point in the middle of the face, 2 m
    // from the centre, leaves 1 - 1 / (1 + eta^2 m / I) of the speed, and the floe tips over the edge.
    const double eta2 = manifold == Manifold::chord_ends ? 0.0 : 4.0;
    const double left = speed * (1.0 - 1.0 / (1.0 + eta2 * 45000.0 / 750000.0));
    // Iterations end when no point asks for more than the tolerance times the speed. With shared masses (both ends: nn
    // of 1.1e-4 against a smallest response of 1.7e-5 per kg) the error is at most 6.4 times that. The touch of 2^-40 m
    // shifts the point by half of it: 1e-13 relative.
    const double allowed = (10.0 * scene.numerics.residual_tolerance + 1e-13) * speed;
    verification::check_value(std::string("F1.") + name_of(manifold) + ".speed_left", left, -run.bodies().velocity[2].y,
                              allowed, "m/s", where());
    expect_sound(std::string("F1.") + name_of(manifold), run);
  }
}

TEST_P(HardManifold, F2_a_face_rests_on_a_ledge) {
  for (const Manifold manifold : {Manifold::chord_ends, Manifold::chord_middle}) {
    Watched run(on_a_ledge(setting(), manifold), setting());
    run.advance(2000, 20);
    // The chord of a tipping floe moves below its centre, so the floe stays with either manifold, within the slack of a
    // contact over 6 m.
    bound(std::string("F2.") + name_of(manifold) + ".turned", std::fabs(run.bodies().rotation[2].sine), 1e-3, "rad",
          where());
    expect_sound(std::string("F2.") + name_of(manifold), run);
  }
}

TEST_P(HardManifold, F3_a_column_stands) {
  for (const Manifold manifold : {Manifold::chord_ends, Manifold::chord_middle}) {
    SceneDef scene = read_hard_member("H01_columns.toml", "H01_10", setting());
    scene.contact.manifold = manifold;
    Bodies bodies = make_field(scene);
    for (std::size_t i = first_floe_of(bodies); i < bodies.count(); ++i) bodies.spin[i] = i % 2 == 0 ? 1e-4 : -1e-4;
    Watched run(scene, bodies, setting());
    run.advance(12000, 200);
    double turned = 0.0;
    for (std::size_t i = first_floe_of(bodies); i < bodies.count(); ++i)
      turned = std::max(turned, std::fabs(run.bodies().rotation[i].sine));
    // After ten minutes under pressure the faces lie on each other within 1 mm over a face of 10 m. One point per
    // contact cannot keep a floe aligned; there a column counts as standing if no floe has turned by more than 10 cm
    // over its face.
    const std::string id = std::string("F3.") + name_of(manifold);
    bound(id + ".turned", turned, manifold == Manifold::chord_ends ? 1e-4 : 1e-2, "rad", where());
    expect_sound(id, run);
  }
}

TEST_P(HardManifold, F4_a_tight_field_packs) {
  for (const Manifold manifold : {Manifold::chord_ends, Manifold::chord_middle}) {
    SceneDef scene = resolved_as(tight_scene(12, 6), setting());
    scene.contact.manifold = manifold;
    const std::string id = std::string("F4.") + name_of(manifold);
    Watched run(scene, setting());
    run.advance(2000, 20);
    bound(id + ".overlap", run.worst().overlap, 20e-3, "m", where());
    bound(id + ".overlap_99.9", overlaps(run.bodies()).most, 2e-3, "m", where());
    bound(id + ".fastest_left", fastest_floe(run.bodies()), 0.25, "m/s", where());
    expect_sound(id, run);
  }
}

}  // namespace
}  // namespace gem::hard
