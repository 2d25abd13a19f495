// The progress line of slow and of short runs.
#include "gem/run/run_log.h"

#include <gtest/gtest.h>

namespace gem {
namespace {

TEST(ProgressText, ASlowRunHasASpeed) {
  EXPECT_EQ(rate_text(0.043), "0.043");
  EXPECT_EQ(rate_text(1.5), "1.5");
  EXPECT_EQ(rate_text(0.0), "0");
  EXPECT_EQ(rate_text(136.4), "136");
  const std::string line = progress_text({450.0, 900.0, 1500.0, 7, 1e-15});
  EXPECT_EQ(line, "50 %  450 s  0.3 x real time  7 contacts  25:00 left");
}

TEST(FittedLine, LeavesTheLastColumnFree) {
  EXPECT_EQ(fitted_line("50 %", 8), "50 %   ");
  EXPECT_EQ(fitted_line("50 %  450 s", 8), "50 %  4");
  EXPECT_EQ(fitted_line("50 %", 1), "5");
}

TEST(ProgressText, AShortRunHasATime) {
  EXPECT_NE(progress_text({0.02, 0.05, 1.0, 0, 0.0}).find("  0.0200 s  "), std::string::npos);
  EXPECT_NE(progress_text({12.5, 20.0, 1.0, 0, 0.0}).find("  12.5 s  "), std::string::npos);
  EXPECT_NE(progress_text({7200.0, 7200.0, 1.0, 0, 0.0}).find("  7200 s  "), std::string::npos);
}

}  // namespace
}  // namespace gem
