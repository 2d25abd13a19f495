// What no engine may accept.
#include <gtest/gtest.h>

#include "gem/base/error.h"
#include "gem/engine/engine.h"
#include "gem/field/field.h"

namespace gem {
namespace {

TEST(MakeEngine, RefusesASolverThatTheEngineDoesNotHave) {
  SceneDef scene;
  const Bodies field = make_field(scene);
  scene.contact.solver = static_cast<ContactSolver>(3);
  for (const std::string& name : engine_names()) {
    try {
      make_engine(scene, field, {.name = name, .threads = 1});
      ADD_FAILURE() << "the engine " << name << " runs a solver that nobody wrote";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what()).find("cannot run contact.solver"), std::string::npos) << error.what();
    }
  }
}

TEST(MakeEngine, RefusesAnUnknownName) {
  const SceneDef scene;
  EXPECT_THROW(make_engine(scene, make_field(scene), {.name = "none", .threads = 1}), Error);
}

}  // namespace
}  // namespace gem
