#include "gem/record/hits.h"

#include <algorithm>
#include <cmath>

namespace gem {

Hits::Hits(HitRule rule, double time_step_s)
    : rule_(rule), time_step_(time_step_s), release_steps_(std::llround(rule.release_s / time_step_s)) {
  const std::int64_t window = std::max<std::int64_t>(1, std::llround(rule.window_s / time_step_s));
  part_steps_ = (window + window_parts - 1) / window_parts;
  parts_ = (window + part_steps_ - 1) / part_steps_;
}

void Hits::add_to_window(OpenHit& open, std::int64_t step, double impulse) const {
  const std::int64_t now = step / part_steps_;
  const auto at = [](std::int64_t n) { return static_cast<std::size_t>(n % window_parts); };
  for (std::int64_t n = std::max(open.last_part + 1, now - window_parts + 1); n <= now; ++n) open.part[at(n)] = 0.0;
  open.last_part = now;
  open.part[at(now)] += impulse;
  double sum = 0.0;
  for (std::int64_t n = std::max<std::int64_t>(0, now - parts_ + 1); n <= now; ++n) sum += open.part[at(n)];
  if (!(sum > open.hit.window_impulse)) return;
  open.hit.window_impulse = sum;
  open.hit.window_end = static_cast<double>((now + 1) * part_steps_) * time_step_;
}

void Hits::take(const ContactEvent& row, Released& released) {
  const std::int64_t step = std::llround(row.time / time_step_);
  const auto [at, is_new] = open_.try_emplace(row.body_b);
  OpenHit& open = at->second;
  const bool again = !is_new && step >= release_of(open);
  if (again) released.push_back(open);
  if (is_new || again) open = {{row}, step, step, {}, step / part_steps_};
  Hit& hit = open.hit;
  hit.impulse_normal += row.impulse_normal;
  hit.impulse_tangential += row.impulse_tangential;
  hit.depth = std::max(hit.depth, row.depth);
  hit.largest_force = std::max(hit.largest_force, row.largest_force);
  add_to_window(open, step, row.impulse_normal);
  open.end = step + 1;
  hit.duration = static_cast<double>(open.end - open.begin) * time_step_;
}

void Hits::append(Released& released, std::vector<Hit>& ended) const {
  std::sort(released.begin(), released.end(), [&](const OpenHit& a, const OpenHit& b) {
    return a.end != b.end ? a.end < b.end : a.hit.first.body_b < b.hit.first.body_b;
  });
  for (const OpenHit& open : released)
    if (open.hit.first.closing_speed > rule_.closing_speed_m_per_s) ended.push_back(open.hit);
}

void Hits::add(const std::vector<ContactEvent>& rows, std::int64_t step, std::vector<Hit>& ended) {
  Released released;
  for (const ContactEvent& row : rows) take(row, released);
  for (auto at = open_.begin(); at != open_.end();) {
    const bool over = release_of(at->second) <= step;
    if (over) released.push_back(at->second);
    at = over ? open_.erase(at) : std::next(at);
  }
  append(released, ended);
}

void Hits::end_all(std::vector<Hit>& ended) {
  Released released;
  for (const auto& [body, open] : open_) released.push_back(open);
  open_.clear();
  append(released, ended);
}

std::vector<OpenHit> Hits::open() const {
  std::vector<OpenHit> all;
  for (const auto& [body, open] : open_) all.push_back(open);
  return all;
}

void Hits::restore(const std::vector<OpenHit>& open) {
  open_.clear();
  for (const OpenHit& one : open) open_[one.hit.first.body_b] = one;
}

}  // namespace gem
