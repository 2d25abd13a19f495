// Cells and sections of the report page.
#pragma once

#include <optional>
#include <string>

#include "validation/paper/page/paper_page.h"

namespace gem {

/// Text escaped for a cell of a table.
std::string cell(const std::string& text);
/// An end of an interval, which may be infinite.
std::string end_text(double value);
/// "88.7 (88.1 … 89.2; 95 % over 5 runs)", or the note if nothing was measured.
std::string result_text(const std::optional<Measured>& measured, const std::string& note);
/// Mean over the runs of a condition in a unit, with its interval if there is one; "-" without runs.
std::string mean_text(const PaperFolder& folder, const std::string& run, const std::string& name, double unit = 1.0);

/// Combined probability of independent runs by Fisher's method; "-" without runs.
std::string chance_text(const PaperFolder& folder, const std::string& run, const std::string& name);

std::string period_text(const Reproduction& result);
/// How three definitions of a period differ in run 1, and how the count depends on the sampling.
std::string counting_text(const PaperFolder& folder);
std::string choices_text(const Reproduction& result);
/// Growth of the motion with time, and extremes, over the seeds.
std::string stationarity_text(const Reproduction& result);
std::string extremes_text(const Reproduction& result);
/// Runs of a day compared with shorter runs of the same condition.
std::string days_text(const PaperFolder& folder, const Reproduction& result);
std::string divergence_text(const Reproduction& result);
std::string ice_text(const IceStudy& study);
std::string unordered_text(const UnorderedStudy& study);
std::string chaos_text(const PaperFolder& folder);

}  // namespace gem
