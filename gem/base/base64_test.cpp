// Bytes as text.
#include "gem/base/base64.h"

#include <gtest/gtest.h>

namespace gem {
namespace {

TEST(Base64, EqualsTheExamplesOfRfc4648) {
  const char* const expected[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t n = 0; n < 7; ++n) EXPECT_EQ(base64(std::string("foobar").substr(0, n)), expected[n]);
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

}  // namespace
}  // namespace gem
