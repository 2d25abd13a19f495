// Base of the tests that need a GPU.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <tuple>

#include "gem/base/error.h"
#include "gem/engine/cuda/cuda_engine.h"

namespace gem {

/// Skips the test, with the reason, if no GPU is usable.
class OnGpu : public testing::Test {
 protected:
  void SetUp() override {
    try {
      usable_cuda_device();
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
};

/// Names a parameterised test by its route.
inline void PrintTo(Route route, std::ostream* out) {
  *out << (route == Route::automatic ? "automatic" : route == Route::resident ? "resident" : "phases");
}

using SolverAndManifold = std::tuple<ContactSolver, Manifold>;

inline SceneDef resolved(SceneDef scene, ContactSolver solver, Manifold manifold) {
  scene.contact.solver = solver;
  scene.contact.manifold = manifold;
  return scene;
}

}  // namespace gem
