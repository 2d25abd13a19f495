// Packs a run file, makes the page of it and writes that beside its place first.
#include "gem/view/view_run.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/view/pack/pack_run.h"
#include "gem/view/page_text.h"

namespace gem::view {

namespace {

/// Whether a file begins as pages of gem view do, with this mark.
bool is_page(const std::string& path, const std::string& mark) {
  std::ifstream file(path, std::ios::binary);
  std::string head(200, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find("<!-- gem view " + mark) != std::string::npos;
}

/// Throws Error(file_system) if `out` would take the place of anything but an earlier page of the same case.
void check_replaced(const std::string& out, const std::string& mark, bool overwrite) {
  const bool same = is_page(out, mark);
  if (!overwrite && !same && is_page(out, ""))
    throw Error(ExitCode::file_system,
                "cannot write " + shown(out) + " (it is the page of another run); use --overwrite or another --out");
  check_output_path(out, overwrite || same);
}

}  // namespace

void write_page(const std::string& run_file, const std::string& out, bool allow_incomplete, bool overwrite) {
  const RunFile file(run_file, allow_incomplete);
  const PagePlan plan = plan_for(file);
  const nlohmann::ordered_json description = describe_run(file, plan);
  check_replaced(out, page_mark(description), overwrite);
  const std::string page = whole_page(description, pack_run(file, plan));
  const std::string draft = out + ".new";
  std::ofstream stream(draft, std::ios::binary);
  stream << page;
  stream.close();
  std::error_code fault;
  if (stream) std::filesystem::rename(draft, out, fault);
  if (stream && !fault) return;
  std::remove(draft.c_str());
  throw Error(ExitCode::file_system, "cannot write " + shown(out) + " (" +
                                         (fault ? fault.message() : std::string("disk full or no permission")) +
                                         "); choose another place with --out");
}

}  // namespace gem::view
