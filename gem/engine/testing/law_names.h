// For tests: the laws of a scene as words, so that a parameterised test is named by the laws that it takes.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <tuple>

#include "gem/scene/scene_def.h"

namespace gem {

// GoogleTest finds PrintTo in the namespace of its argument.
inline void PrintTo(ContactSolver solver, std::ostream* out) { *out << solver_name(solver); }

inline void PrintTo(Manifold manifold, std::ostream* out) {
  *out << (manifold == Manifold::chord_ends ? "chord_ends" : "chord_middle");
}

inline void PrintTo(Yaw yaw, std::ostream* out) { *out << (yaw == Yaw::free ? "free_yaw" : "locked_yaw"); }

inline void PrintTo(FrictionLaw law, std::ostream* out) {
  *out << (law == FrictionLaw::one_step ? "one_step" : "fixed_direction");
}

inline void PrintTo(DragLaw law, std::ostream* out) {
  *out << (law == DragLaw::none ? "no_drag" : law == DragLaw::linear ? "linear" : "quadratic");
}

namespace test {

template <class Law>
std::string law_name(Law law) {
  return testing::PrintToString(law);
}

/// All laws of a combination, joined by underscores.
template <class... Laws>
std::string law_name(const std::tuple<Laws...>& laws) {
  std::string name;
  const auto append = [&](const std::string& law) { name += (name.empty() ? "" : "_") + law; };
  std::apply([&](const auto&... law) { (append(law_name(law)), ...); }, laws);
  return name;
}

/// Name generator of a test whose parameter is a law or a tuple of laws.
struct LawNames {
  template <class Parameter>
  std::string operator()(const testing::TestParamInfo<Parameter>& info) const {
    return law_name(info.param);
  }
};

}  // namespace test
}  // namespace gem
