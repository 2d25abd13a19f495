// The steps of a report: check, compute, draw, write the page.
#include "gem/report/report.h"

#include <filesystem>

#include "gem/base/error.h"
#include "gem/record/run_file/run_file.h"
#include "gem/report/display.h"
#include "gem/report/figures/figures.h"
#include "gem/report/page.h"
#include "gem/report/page_frame.h"
#include "gem/report/run/load_run.h"
#include "gem/report/run/run_findings.h"

namespace gem {
namespace {

std::string stamp(const RunIdentity& identity) {
  std::string text = identity.name;
  if (!identity.source.empty()) text += "  " + identity.source;
  if (identity.status != "complete") text += "  " + identity.status;
  return text;
}

}  // namespace

void write_report(const std::string& run_file, const std::string& out_dir, bool allow_incomplete,
                  std::optional<double> at_s) {
  write_report(load_run(run_file, allow_incomplete, at_s), out_dir, allow_incomplete);
}

void write_report(const RunData& run, const std::string& out_dir, bool allow_incomplete) {
  if (!ended_as_asked(run.identity.status) && !allow_incomplete)
    throw Error(ExitCode::usage, "the run " + run.identity.name + " is not complete (status: " + run.identity.status +
                                     "); finish it, or ask for a report with --allow-incomplete");
  if (run.at_s && !(*run.at_s >= 0.0 && *run.at_s <= run.duration_s))
    throw Error(ExitCode::usage, "the run " + run.identity.name + " has no time " + time_text(*run.at_s) +
                                     " (it lasts " + time_text(run.duration_s) + "); choose another --at");
  const std::filesystem::path folder(out_dir);
  check_page_folder(folder, page_title(run.identity.name), "report of " + run.identity.name);
  const PlotFolder plots(folder / "figures", stamp(run.identity));
  const RunFindings findings = run_findings(run);
  const PageFigures figures{field_figures(run, plots), motion_figures(run, findings, plots), force_figures(run, plots),
                            book_figures(run, plots)};
  write_page(folder, page_html(run, findings, whole_run_analysis(run), figures));
}

}  // namespace gem
