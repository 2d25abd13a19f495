// When the text of gem analyse explains "not resolved".
#include "gem/command/analyse/analyse_output.h"

#include <gtest/gtest.h>

namespace gem {
namespace {

constexpr const char* note = "not resolved: the record has too few cycles";

std::string text_with(const std::vector<Finding>& findings) {
  AnalysedRun run;
  run.path = "a.h5";
  run.name = "not resolved";  // a name is no finding
  run.findings = findings;
  return text_of(run);
}

TEST(AnalyseOutput, ExplainsWhatIsNotResolved) {
  const Finding contact{"contact_fraction", 0.5, {}};
  EXPECT_EQ(text_with({contact}).find(note), std::string::npos) << text_with({contact});
  EXPECT_NE(text_with({contact, {"x_period_by_maxima_s", {}, {}}}).find(note), std::string::npos);
  const Finding sharp{"x_period_by_spectrum_s", 90.0, IntervalEstimate{90.0, 80.0, 100.0}};
  const Finding wide{"x_period_by_spectrum_s", 90.0, IntervalEstimate{90.0, 60.0, 130.0}};
  EXPECT_EQ(text_with({contact, sharp}).find(note), std::string::npos);
  EXPECT_NE(text_with({contact, wide}).find(note), std::string::npos);
  // a length that was not resolved is rounding where nothing moved and nothing touched
  EXPECT_EQ(text_with({{"contact_fraction", 0.0, {}}, {"x_amplitude_median_m", {}, {}}}).find(note), std::string::npos);
}

}  // namespace
}  // namespace gem
