// The steps of a report: check, compute, draw, write the page.
#include "gem/report/report.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "gem/base/error.h"
#include "gem/record/run_file/run_file.h"
#include "gem/report/figures/figures.h"
#include "gem/report/page.h"
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

/// Refuses a folder that holds the figures of another run.
void check_folder(const std::filesystem::path& page, const std::string& run) {
  std::ifstream old(page, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(old), std::istreambuf_iterator<char>()};
  if (text.empty() || text.find("<title>" + page_title(run) + "</title>") != std::string::npos) return;
  throw Error(ExitCode::usage, page.string() + " exists already (it is not the report of " + run +
                                   ") choose another folder with --out, or remove this one");
}

}  // namespace

void write_report(const std::string& run_file, const std::string& out_dir, bool allow_incomplete) {
  write_report(load_run(run_file, allow_incomplete), out_dir, allow_incomplete);
}

void write_report(const RunData& run, const std::string& out_dir, bool allow_incomplete) {
  if (!ended_as_asked(run.identity.status) && !allow_incomplete)
    throw Error(ExitCode::usage, "the run " + run.identity.name + " is not complete (status: " + run.identity.status +
                                     ") finish it, or ask for a report with --allow-incomplete");
  const std::filesystem::path folder(out_dir);
  check_folder(folder / "index.html", run.identity.name);
  const PlotFolder plots(folder / "figures", stamp(run.identity));
  const RunFindings findings = run_findings(run);
  const PageFigures figures{field_figures(run, plots), motion_figures(run, findings, plots), force_figures(run, plots),
                            book_figures(run, plots)};
  std::ofstream page(folder / "index.html", std::ios::binary);
  page << page_html(run, findings, whole_run_analysis(run), figures);
  page.close();
  if (!page)
    throw Error(ExitCode::file_system, "cannot write " + (folder / "index.html").string() +
                                           " (disk full or no permission) choose another output folder");
}

}  // namespace gem
