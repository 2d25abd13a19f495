// Where the floes come from, and the field that is made of them.
#include <cmath>
#include <string>

#include "gem/scene/checks/checks.h"
#include "gem/scene/checks/limit_text.h"
#include "gem/scene/platform_shape.h"
#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

constexpr double cover_maximum = 0.95;

bool makes_floes(const FloesDef& floes) { return is_made(floes) && (floes.count > 0 || floes.concentration > 0.0); }

void check_source(const SceneDef& s, SceneProblems& out) {
  const bool from_file = s.floes.source == FloeSource::file;
  if (from_file && s.floes.path.empty())
    out.push_back({"floes.path", "missing (source = \"file\"); name the floe file"});
  if (!from_file && !s.floes.path.empty())
    out.push_back({"floes.path", "has no effect (value " + quoted_text(s.floes.path) +
                                     ", allowed only with floes.source = \"file\"); remove it or change the source"});
  if (!from_file && s.floes.time_s != 0.0)
    out.push_back({"floes.time_s", "has no effect (value " + plain_number_text(s.floes.time_s) +
                                       ", allowed only with floes.source = \"file\"); remove it or change the source"});
  if (!from_file && s.floes.concave != ConcaveFloes::refuse)
    out.push_back(
        {"floes.concave", "has no effect (allowed only with floes.source = \"file\"); remove it or change the source"});
  const std::string& sha256 = s.floes.sha256;
  if (!sha256.empty() && (sha256.size() != 64 || sha256.find_first_not_of("0123456789abcdef") != std::string::npos))
    out.push_back({"floes.sha256", "not a SHA-256 (value " + quoted_text(sha256) +
                                       ", allowed 64 digits 0-9 and a-f); leave it out to use any floes"});
  if (!from_file && !sha256.empty())
    out.push_back({"floes.sha256", "has no effect (allowed only with floes.source = \"file\"); remove it"});
  if (s.floes.source != FloeSource::listed && !s.floe.empty())
    out.push_back({"floe", "listed floes have no effect (value " + std::to_string(s.floe.size()) +
                               " floes); set floes.source = \"listed\""});
}

void check_sizes(const SceneDef& s, SceneProblems& out) {
  const FloesDef& f = s.floes;
  if (!makes_floes(f)) return;
  if (!(f.size_minimum_m < f.size_mean_m && f.size_mean_m < f.size_maximum_m)) {
    out.push_back(
        {"floes.size_mean_m", "not between the limits (value " + plain_number_text(f.size_mean_m) +
                                  ", allowed between floes.size_minimum_m = " + plain_number_text(f.size_minimum_m) +
                                  " and floes.size_maximum_m = " + plain_number_text(f.size_maximum_m) + " m)"});
    return;
  }
  // On [a, b] with a given mean, the largest deviation has all weight at a and b.
  const double most = std::sqrt((f.size_mean_m - f.size_minimum_m) * (f.size_maximum_m - f.size_mean_m));
  if (f.size_deviation_m >= most)
    out.push_back(
        {"floes.size_deviation_m", "no distribution within the limits has this deviation (value " +
                                       plain_number_text(f.size_deviation_m) + ", allowed below " + limit_text(most) +
                                       " m with size_mean_m = " + plain_number_text(f.size_mean_m) +
                                       " between size_minimum_m = " + plain_number_text(f.size_minimum_m) +
                                       " and size_maximum_m = " + plain_number_text(f.size_maximum_m) + " m)"});
  if (f.concentration > 0.0) return;
  const double mean_area = f.size_mean_m * f.size_mean_m + f.size_deviation_m * f.size_deviation_m;
  const double cover = static_cast<double>(f.count) * mean_area / (f.length_m * f.width_m);
  if (cover > cover_maximum)
    out.push_back({"floes.count",
                   "the floes do not fit into the field (value " + std::to_string(f.count) + ", they would cover " +
                       number_text(cover, 4) +
                       " of its area; about 0.8 is the limit); lower it or enlarge floes.length_m or floes.width_m"});
}

void check_concentration(const SceneDef& s, SceneProblems& out) {
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
                                              "); give a share, such as 0.9 for 9/10"});
}

void check_classes(const SceneDef& s, SceneProblems& out) {
  if (!makes_floes(s.floes)) return;
  double sum = 0.0;
  for (const IceClassDef& c : s.floes.classes) sum += c.tenths;
  if (!(sum > 0.0) || sum > 9.0)
    out.push_back({"ice.class", "the sum of the tenths of all classes is out of range (value " +
                                    plain_number_text(sum) + ", allowed (0, 9])"});
  if (s.floes.classes.size() > 255)
    out.push_back(
        {"ice.class", "too many classes (value " + std::to_string(s.floes.classes.size()) + ", allowed at most 255)"});
}

void check_field_place(const SceneDef& s, SceneProblems& out) {
  const FloesDef& f = s.floes;
  if (!makes_floes(f)) return;
  const double end = f.start_x_m + f.length_m;
  const double bow = s.platform.anchor_m.x + s.platform.start_offset_m.x - platform_reach(s.platform).upstream;
  if (s.platform.present && end > bow)
    out.push_back({"floes.start_x_m", "the field reaches the platform (value " + plain_number_text(f.start_x_m) +
                                          ", allowed at most " + plain_number_text(bow - f.length_m) + " m)"});
  if (s.boundary.present && f.start_x_m < s.boundary.inlet_x_m)
    out.push_back({"floes.start_x_m",
                   "the field begins upstream of the boundary (value " + plain_number_text(f.start_x_m) +
                       ", allowed at least boundary.inlet_x_m = " + plain_number_text(s.boundary.inlet_x_m) + " m)"});
  if (s.boundary.present && f.width_m > s.boundary.inlet_width_m)
    out.push_back({"floes.width_m", "the field is wider than the channel (value " + plain_number_text(f.width_m) +
                                        ", allowed at most boundary.inlet_width_m = " +
                                        plain_number_text(s.boundary.inlet_width_m) + " m)"});
}

/// Tenths that differ from the cover of a field whose floes are counted.
void warn_of_tenths(const FloesDef& f, SceneWarnings& warnings) {
  double tenths = 0.0;
  for (const IceClassDef& c : f.classes) tenths += c.tenths;
  const double mean_area = f.size_mean_m * f.size_mean_m + f.size_deviation_m * f.size_deviation_m;
  const double cover = 10.0 * static_cast<double>(f.count) * mean_area / (f.length_m * f.width_m);
  if (std::abs(cover - tenths) > 1.0)
    warnings.push_back("ice.class: the tenths differ from the cover of the field (value " + plain_number_text(tenths) +
                       ", the floes cover " + plain_number_text(std::round(10.0 * cover) / 10.0) +
                       " tenths); only the ratio of the tenths is used");
}

}  // namespace

bool is_made(const FloesDef& floes) {
  return floes.source == FloeSource::generated || floes.source == FloeSource::copied;
}

void check_floes(const SceneDef& scene, SceneProblems& problems) {
  for (const auto rule : {check_source, check_sizes, check_concentration, check_classes, check_field_place})
    rule(scene, problems);
}

void warn_of_floes(const SceneDef& scene, SceneWarnings& warnings) {
  const FloesDef& f = scene.floes;
  if (is_made(f) && f.count > 0 && f.concentration == 0.0) warn_of_tenths(f, warnings);
  const FloesDef usual_floes;
  if (f.concentration > 0.0 && f.count != usual_floes.count)
    warnings.push_back("floes.count: has no effect (value " + std::to_string(f.count) +
                       ", floes.concentration sets the number of floes); remove it");
  if (!is_made(f) && f.count != usual_floes.count)
    warnings.push_back("floes.count: has no effect (value " + std::to_string(f.count) +
                       ", the floes that are given count); remove it");
  const std::vector<IceClassDef>& classes = f.classes;
  const IceClassDef usual;
  if (f.source == FloeSource::listed &&
      (classes.size() != 1 || classes[0].thickness_m != usual.thickness_m || classes[0].tenths != usual.tenths))
    warnings.push_back("ice.class: has no effect (listed floes have their own thickness_m); remove it");
}

}  // namespace gem
