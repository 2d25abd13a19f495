// Finds the rows of a frame by their time and reads only those.
#include "gem/record/run_file/contact_record.h"

#include <algorithm>
#include <cmath>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"

namespace gem {

ContactRecord::ContactRecord(const RunFile& file)
    : file_(file), times_(is_in(file) ? file.column("contacts/time") : std::vector<double>{}) {
  if (!is_in(file)) return;
  const auto refuse = [&](const char* why) {
    throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (" + why + "); the file may be damaged");
  };
  if (!std::is_sorted(times_.begin(), times_.end())) refuse("contacts/time does not ascend");
  // the platform and the fixed bodies stand before the floes
  const double first = file.number_attribute("gem_first_floe_body");
  if (!(first == 1.0 + double(file.boundary_outlines().size())))
    refuse("gem_first_floe_body does not fit the fixed bodies");
  first_floe_ = static_cast<std::int32_t>(first);
  bodies_ = first + double(file.floe_count());
}

std::vector<ContactForce> ContactRecord::at(double time) const {
  const auto [begin, end] = std::equal_range(times_.begin(), times_.end(), time);
  const auto first = static_cast<std::size_t>(begin - times_.begin()), count = static_cast<std::size_t>(end - begin);
  if (count == 0) return {};
  const auto read = [&](const char* name) { return file_.column_rows(std::string("contacts/") + name, first, count); };
  const std::vector<double> a = read("body_a"), b = read("body_b"), x = read("x"), y = read("y"), fx = read("force_x"),
                            fy = read("force_y");
  std::vector<ContactForce> forces;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(a[i] >= 0.0 && b[i] > a[i] && b[i] < bodies_)) continue;
    if (!std::isfinite(x[i] + y[i] + fx[i] + fy[i])) continue;
    forces.push_back({static_cast<std::int32_t>(a[i]), static_cast<std::int32_t>(b[i]), {x[i], y[i]}, {fx[i], fy[i]}});
  }
  return forces;
}

}  // namespace gem
