// Answers from the run file. A file that is being written is opened anew to see its new rows.
#include "gem/view/server/site.h"

#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "gem/base/error.h"
#include "gem/view/pack/packet.h"
#include "gem/view/page_text.h"

namespace gem::view {

namespace {

constexpr const char* packet_type = "application/octet-stream";
constexpr std::chrono::milliseconds fresh_for(300);  // rows are flushed every second

/// The number of this name; nothing if there is none or it is no whole number.
std::optional<std::size_t> number_in(const std::map<std::string, std::string>& query, const std::string& name) {
  const auto found = query.find(name);
  if (found == query.end()) return std::nullopt;
  std::size_t value = 0;
  const char* const end = found->second.data() + found->second.size();
  const auto [stop, fault] = std::from_chars(found->second.data(), end, value);
  if (fault != std::errc{} || stop != end) return std::nullopt;
  return value;
}

Reply no_such() { return {404, "text/plain; charset=utf-8", "there is nothing at this address"}; }

}  // namespace

Reply Site::answer(const std::string& method, const std::string& place,
                   const std::map<std::string, std::string>& query) {
  if (control_) ++control_->requests;
  if (method == "POST") return control_ && command(place) ? Reply{204, "text/plain", ""} : no_such();
  if (method != "GET") return {405, "text/plain; charset=utf-8", "only GET and POST"};
  if (place == "state" && control_) return state();
  const std::lock_guard lock(mutex_);
  try {
    if (control_ && !std::filesystem::exists(path_))
      return {503, "text/plain; charset=utf-8", "the run has no file yet"};
    return read(place, query);
  } catch (const Error& error) {
    return {control_ ? 503 : 500, "text/plain; charset=utf-8", error.what()};
  }
}

Reply Site::read(const std::string& place, const std::map<std::string, std::string>& query) {
  if (place.empty()) return {200, "text/html; charset=utf-8", served_page(file().attribute("title"), control_)};
  const RunFile& run = file();
  const PagePlan plan = plan_for(run);
  if (place == "description") return {200, "application/json", json_text(describe_run(run, plan))};
  if (place == "shapes") return {200, packet_type, pack_shapes(run, plan)};
  const std::optional<std::size_t> first = number_in(query, "first");
  if (!first) return no_such();
  if (place == "frames") {
    const std::vector<FrameRange> ranges = frame_ranges(run, plan, *first);
    return ranges.empty() ? Reply{204, packet_type, ""}
                          : Reply{200, packet_type, pack_frames(run, ranges[0], plan.rounding)};
  }
  const auto group = query.find("group");
  const bool known =
      group != query.end() && (group->second == "platform" || group->second == "events" || group->second == "stats");
  if (place != "rows" || !known) return no_such();
  return {200, packet_type, pack_rows(run, rows_for_page(group->second, plan, *first))};
}

Reply Site::state() const {
  const nlohmann::ordered_json object = {{"time_s", control_->time_s.load()},
                                         {"duration_s", control_->duration_s.load()},
                                         {"running", control_->running.load()},
                                         {"paused", control_->paused.load()},
                                         {"stopping", control_->stop.load()}};
  return {200, "application/json", json_text(object)};
}

bool Site::command(const std::string& name) {
  if (name == "pause" || name == "go_on")
    control_->paused = name == "pause";
  else if (name == "stop")
    control_->stop = true;
  else if (name == "has_all")
    control_->has_all = true;
  else
    return false;
  return true;
}

const RunFile& Site::file() {
  const auto now = std::chrono::steady_clock::now();
  if (!file_ || (control_ && now - opened_ > fresh_for)) {
    file_.reset();
    file_.emplace(path_, allow_incomplete_ || control_);
    opened_ = now;
  }
  return *file_;
}

}  // namespace gem::view
