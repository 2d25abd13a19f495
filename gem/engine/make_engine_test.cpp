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

TEST(MakeEngine, CompliantContactsRunOnCpuAndReference) {
  SceneDef scene;
  scene.contact.solver = ContactSolver::compliant;
  const Bodies field = make_field(scene);
  EXPECT_TRUE(make_engine(scene, field, {.name = "cpu", .threads = 1}));
  EXPECT_TRUE(make_engine(scene, field, {.name = "reference", .threads = 1}));
}

TEST(MakeEngine, TheHashCountsWhatCornersRemember) {
  const Bodies field = make_field(SceneDef{});
  const std::vector<std::uint64_t> key = {1};
  std::vector<CornerMemory> value(1);
  const std::uint64_t without = hash_of(3, field, 0), fresh = hash_of(3, field, 0, nullptr, {key, value});
  EXPECT_EQ(hash_of(3, field, 0, nullptr, {}), without);
  EXPECT_NE(fresh, without);
  for (double CornerMemory::*member : {&CornerMemory::crushed, &CornerMemory::stretch, &CornerMemory::stiffness,
                                       &CornerMemory::elastic, &CornerMemory::normal, &CornerMemory::side}) {
    value = {{}};
    value[0].*member = 1.0;
    EXPECT_NE(hash_of(3, field, 0, nullptr, {key, value}), fresh);
  }
}

TEST(MakeEngine, RefusesAnUnknownName) {
  const SceneDef scene;
  EXPECT_THROW(make_engine(scene, make_field(scene), {.name = "none", .threads = 1}), Error);
}

}  // namespace
}  // namespace gem
