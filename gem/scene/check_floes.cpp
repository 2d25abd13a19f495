// Checks of where the floes come from: a generated field, a file, or the case itself.
#include "gem/scene/check_floes.h"

#include <string>

#include "gem/scene/problems.h"
#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {

bool is_made(const FloesDef& floes) {
  return floes.source == FloeSource::generated || floes.source == FloeSource::copied;
}

void check_source(const SceneDef& s, std::vector<SceneProblem>& out) {
  const bool from_file = s.floes.source == FloeSource::file;
  if (from_file && s.floes.path.empty())
    out.push_back({"floes.path", "missing (source = \"file\") name the floe file"});
  if (!from_file && !s.floes.path.empty())
    out.push_back({"floes.path", "has no effect (value " + quoted_text(s.floes.path) +
                                     ", allowed only with floes.source = \"file\") remove it or change the source"});
  if (!from_file && s.floes.time_s != 0.0)
    out.push_back({"floes.time_s", "has no effect (value " + plain_number_text(s.floes.time_s) +
                                       ", allowed only with floes.source = \"file\") remove it or change the source"});
  if (!from_file && s.floes.concave != ConcaveFloes::refuse)
    out.push_back(
        {"floes.concave", "has no effect (allowed only with floes.source = \"file\") remove it or change the source"});
  const std::string& sha256 = s.floes.sha256;
  if (!sha256.empty() && (sha256.size() != 64 || sha256.find_first_not_of("0123456789abcdef") != std::string::npos))
    out.push_back({"floes.sha256", "not a SHA-256 (value " + quoted_text(sha256) +
                                       ", allowed 64 digits 0-9 and a-f) leave it out to use any floes"});
  if (!from_file && !sha256.empty())
    out.push_back({"floes.sha256", "has no effect (allowed only with floes.source = \"file\") remove it"});
  if (s.floes.source != FloeSource::listed && !s.floe.empty())
    out.push_back({"floe", "listed floes have no effect (value " + std::to_string(s.floe.size()) +
                               " floes) set floes.source = \"listed\""});
}

void check_concentration(const SceneDef& s, std::vector<SceneProblem>& out) {
  const double value = s.floes.concentration;
  if (value == 0.0) return;
  if (!is_made(s.floes))
    out.push_back({"floes.concentration", "has no effect (value " + plain_number_text(value) +
                                              ", allowed only with floes.source = \"generated\" or \"copied\") " +
                                              "remove it or change the source"});
  else if (value < concentration_minimum)
    out.push_back({"floes.concentration", "too low to be a pack (value " + plain_number_text(value) +
                                              ", allowed 0 or " +
                                              range_text({concentration_minimum, concentration_maximum}, "") +
                                              ") give a share, such as 0.9 for 9/10"});
}

}  // namespace gem
