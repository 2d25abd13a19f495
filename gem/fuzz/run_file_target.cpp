// Fuzz target: the reader of run files, through `gem info`, the numbers of `gem analyse`, the page of a report, the
// path that a summary keeps, and the run file as the ice of another run.
#include <string>
#include <vector>

#include "gem/command/command.h"
#include "gem/fuzz/target.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/run_start.h"
#include "gem/report/page.h"
#include "gem/report/run/load_run.h"
#include "gem/report/run/platform_path.h"
#include "gem/scene/check_scene.h"

namespace {

/// Runs `gem info`. It may fail, but not for a reason that it did not foresee.
void describe(std::vector<std::string> words) {
  gem::Chosen chosen;
  chosen.in_child = false;
  CLI::App app("", "gem");
  gem::add_info_command(app, chosen);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  const int code = gem::run_command_line(app, chosen, static_cast<int>(arguments.size()), arguments.data());
  gem::fuzz::expect(code != static_cast<int>(gem::ExitCode::resource_limit), "the command met an unexpected exception");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = gem::fuzz::hdf5_input("run.h5", gem::fuzz::text_of(data, size));
  describe({"gem", "info", path});
  describe({"gem", "info", "--json", path});
  gem::fuzz::accepted([&] {
    const gem::RunData run = gem::load_run(path, true);
    const std::vector<gem::Figure> figure(1);  // gnuplot is not called
    page_html(run, gem::run_findings(run), gem::whole_run_analysis(run), {figure, figure, figure, figure});
  });
  gem::fuzz::accepted([&] { gem::read_path(path, 0.5); });
  gem::fuzz::accepted(
      [&] { gem::fuzz::make_listed_field(gem::with_listed_floes({}, gem::floes_of_run_file(path).floes)); });
  return 0;
}
