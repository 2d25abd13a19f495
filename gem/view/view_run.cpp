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

constexpr const char* page_mark = "<!-- gem view -->";

/// Whether a file begins as pages of gem view do.
bool is_page(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(200, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find(page_mark) != std::string::npos;
}

}  // namespace

void write_page(const std::string& run_file, const std::string& out, bool allow_incomplete, bool overwrite) {
  check_output_path(out, overwrite || is_page(out));
  const RunFile file(run_file, allow_incomplete);
  const PagePlan plan = plan_for(file);
  const std::string page = whole_page(describe_run(file, plan), pack_run(file, plan));
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
                                         ") choose another place with --out");
}

}  // namespace gem::view
