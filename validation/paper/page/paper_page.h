// The report page: judged statements, tables, period, choices, divergence, figures; and all rows as CSV.
#pragma once

#include <string>
#include <vector>

#include "validation/paper/plots/paper_figures.h"
#include "validation/paper/statements/catalogue.h"
#include "validation/paper/statements/evaluation.h"
#include "validation/paper/studies/day_study.h"
#include "validation/paper/studies/divergence_study.h"
#include "validation/paper/studies/ice_study.h"
#include "validation/paper/studies/period_question.h"
#include "validation/paper/studies/seed_extremes.h"
#include "validation/paper/studies/sensitivity.h"
#include "validation/paper/studies/stationarity.h"
#include "validation/paper/studies/unordered_study.h"

namespace gem {

struct Reproduction {
  std::vector<std::string> mixed;  // settings that should be equal and are not
  std::vector<JudgedRow> statements;
  std::vector<JudgedSettings> settings;
  std::vector<Candidate> period;
  std::vector<ChoiceRow> choices;
  std::vector<StationarityRow> stationarity;
  std::vector<ExtremesRow> extremes;
  std::vector<DayRow> days;
  DivergenceStudy divergence;
  IceStudy ice;
  UnorderedStudy unordered;
  std::vector<PaperFigure> figures;
};

/// The page in Markdown; paths of pictures are relative to `root`.
std::string page_text(const PaperFolder& folder, const Reproduction& result, const std::filesystem::path& root);

/// One CSV row per check: case, metric, expected, source, tolerance and kind, result, interval, verdict.
std::string rows_text(const Reproduction& result);

}  // namespace gem
