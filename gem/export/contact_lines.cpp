// Looks up the centroids of the bodies that press on each other.
#include "gem/export/contact_lines.h"

#include <map>

namespace gem {

PolyData contact_lines(const ContactRecord& record, const std::vector<FrameFloe>& floes, const PlatformTrack& platform,
                       double time_s) {
  const std::int32_t first_floe = record.first_floe();
  std::map<std::int32_t, Vec2> centre;
  if (platform.present()) centre[0] = platform.position(platform.sample_at(time_s));
  for (const FrameFloe& floe : floes) centre[first_floe + static_cast<std::int32_t>(floe.index)] = floe.position;
  PolyData data;
  data.cells = PolyCells::lines;
  data.time = time_s;
  std::vector<std::int32_t> floe_a, floe_b;
  std::vector<Vec2> force;
  std::vector<float> size;
  for (const ContactForce& contact : record.at(time_s)) {
    const auto a = centre.find(contact.a), b = centre.find(contact.b);
    if (b == centre.end()) continue;  // it left in this time step, or is fixed
    std::vector<Vec2> line = {contact.point, b->second};
    if (a != centre.end()) line.insert(line.begin(), a->second);
    data.add_cell(line);
    floe_a.push_back(static_cast<std::int32_t>(exported_body(contact.a, first_floe)));
    floe_b.push_back(static_cast<std::int32_t>(exported_body(contact.b, first_floe)));
    force.push_back(contact.force);
    size.push_back(static_cast<float>(length(contact.force)));
  }
  data.cell_data = {
      {"floe_a", 1, floe_a}, {"floe_b", 1, floe_b}, vector_array("force", force), {"force_size", 1, size}};
  return data;
}

}  // namespace gem
