// Choices between two numbers without branches. Time steps use them, since their result is defined for equal arguments
// and signed zeros.
#pragma once

#include "gem/base/macros.h"

namespace gem {

/// mask ? a : b
GEM_HD GEM_INLINE double pick(bool mask, double a, double b) { return mask ? a : b; }
GEM_HD GEM_INLINE double larger(double a, double b) { return a > b ? a : b; }
GEM_HD GEM_INLINE double smaller(double a, double b) { return a < b ? a : b; }
GEM_HD GEM_INLINE double magnitude(double a) { return a < 0.0 ? -a : a; }

GEM_HD GEM_INLINE bool both(bool a, bool b) { return a && b; }
GEM_HD GEM_INLINE bool but_not(bool a, bool b) { return a && !b; }
GEM_HD GEM_INLINE bool any(bool a) { return a; }

GEM_HD GEM_INLINE float pick(bool mask, float a, float b) { return mask ? a : b; }
GEM_HD GEM_INLINE float larger(float a, float b) { return a > b ? a : b; }
GEM_HD GEM_INLINE float smaller(float a, float b) { return a < b ? a : b; }
GEM_HD GEM_INLINE float magnitude(float a) { return a < 0.0F ? -a : a; }

}  // namespace gem
