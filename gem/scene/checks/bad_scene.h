// Cases with a fault, for the tests of reading and checking.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "gem/base/error.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {

struct BadScene {
  const char* name;
  std::string text;
  std::vector<std::string> expected;  ///< parts of the message
};

inline void PrintTo(const BadScene& bad, std::ostream* out) { *out << bad.name; }

inline std::string bad_scene_name(const testing::TestParamInfo<BadScene>& bad) { return bad.param.name; }

/// The message with which a case is refused, or "accepted".
inline std::string rejection(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_scene(text, "bad.toml", overrides);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_rejected);
    return error.what();
  }
  return "accepted";
}

/// Refused with all expected parts of the message: bad_scene_test.cpp.
class BadSceneTest : public testing::TestWithParam<BadScene> {};

inline std::string repeated(const std::string& part, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += part;
  return out;
}

/// The outline of a listed floe.
inline const char* const square_outline = "outline_m = [[0, 0], [1, 0], [1, 1], [0, 1]]\n";

}  // namespace gem
