// Adds up the forces of each frame by fixed body.
#include "gem/report/run/fixed_record.h"

#include <algorithm>

#include "gem/analysis/statistics/record_mean.h"
#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/contact_record.h"

namespace gem {
namespace {

void add_findings(std::vector<Finding>& findings, const std::string& name, const std::vector<Vec2>& force) {
  std::vector<double> x, y;
  double largest = 0.0;
  for (const Vec2 f : force) {
    x.push_back(f.x);
    y.push_back(f.y);
    largest = std::max(largest, length(f));
  }
  findings.push_back(mean_of(name + "_force_x_mean_N", x));
  findings.push_back(mean_of(name + "_force_y_mean_N", y));
  findings.push_back({name + "_force_largest_N", largest, {}});
}

}  // namespace

FixedRecord fixed_record(const RunFile& file, const SceneDef& scene) {
  const std::size_t bodies = scene.fixed.size();
  if (bodies == 0 || !ContactRecord::is_in(file)) return {};
  const ContactRecord contacts(file);
  if (bodies > file.boundary_outlines().size())
    throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) +
                                           " (it has fewer fixed bodies than its case); the file may be damaged");
  // they stand behind the platform and the boundary, before the floes
  const std::size_t first = static_cast<std::size_t>(contacts.first_floe()) - bodies;
  FixedRecord fixed;
  fixed.force.resize(bodies);
  for (const double time : file.column("floes/time")) {
    if (!(time > 0.0)) continue;
    fixed.time.push_back(time);
    for (std::vector<Vec2>& force : fixed.force) force.emplace_back();
    const auto add = [&](std::int32_t body, Vec2 force) {
      const std::size_t k = static_cast<std::size_t>(body) - first;
      if (static_cast<std::size_t>(body) >= first && k < bodies) fixed.force[k].back() += force;
    };
    for (const ContactForce& one : contacts.at(time)) {
      add(one.a, -one.force);  // it acts on B
      add(one.b, one.force);
    }
  }
  return fixed;
}

std::vector<Finding> fixed_findings(const FixedRecord& fixed, double from_s) {
  const auto begin = std::lower_bound(fixed.time.begin(), fixed.time.end(), from_s) - fixed.time.begin();
  const std::size_t frames = fixed.time.size() - static_cast<std::size_t>(begin);
  if (frames < 2) return {};
  std::vector<Finding> findings;
  std::vector<Vec2> all(frames);
  for (std::size_t k = 0; k < fixed.force.size(); ++k) {
    const std::vector<Vec2> force(fixed.force[k].begin() + begin, fixed.force[k].end());
    for (std::size_t n = 0; n < frames; ++n) all[n] += force[n];
    add_findings(findings, "fixed_" + std::to_string(k), force);
  }
  add_findings(findings, "fixed_all", all);
  return findings;
}

}  // namespace gem
