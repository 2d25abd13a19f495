// Answers from the run file. A file that is being written is opened anew to see its new rows.
#include "gem/view/server/site.h"

#include <sys/stat.h>

#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "gem/base/error.h"
#include "gem/view/pack/pack_contacts.h"
#include "gem/view/pack/packet.h"
#include "gem/view/page_text.h"

namespace gem::view {

namespace {

constexpr const char* packet_type = "application/octet-stream";
constexpr std::chrono::milliseconds fresh_for(300);    // rows are flushed every second
constexpr std::chrono::milliseconds page_waits(1000);  // between two looks of a page at a run
constexpr std::chrono::milliseconds look_again(20);

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

Site::Site(std::string run_file, bool allow_incomplete, LiveControl* control)
    : path_(std::move(run_file)),
      allow_incomplete_(allow_incomplete),
      control_(control),
      former_(control ? identity_of(path_) : FileIdentity{}) {}

Site::FileIdentity Site::identity_of(const std::string& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return {};
  return {static_cast<std::uint64_t>(found.st_dev), static_cast<std::uint64_t>(found.st_ino)};
}

bool Site::has_own_file() const {
  const FileIdentity now = identity_of(path_);
  return now != FileIdentity{} && now != former_;
}

Reply Site::answer(const std::string& method, const std::string& place,
                   const std::map<std::string, std::string>& query) {
  if (control_) {
    control_->gone = place == "leave";
    ++control_->requests;
  }
  if (method == "POST") return control_ && command(place) ? Reply{204, "text/plain", ""} : no_such();
  if (method != "GET") return {405, "text/plain; charset=utf-8", "only GET and POST"};
  if (place == "state" && control_) return state();
  if (place == "wait" && control_) return wait();
  const std::lock_guard lock(mutex_);
  try {
    if (control_ && !has_own_file()) {
      // the page itself asks again until there is one
      if (place.empty())
        return {200, "text/html; charset=utf-8", served_page(std::filesystem::path(path_).stem().string(), true)};
      return {503, "text/plain; charset=utf-8", "the run has no file yet"};
    }
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
  if (place == "contacts" && ContactRecord::is_in(run)) {
    const std::vector<FrameRange> ranges = frame_ranges(run, plan, *first);
    return ranges.empty() ? Reply{204, packet_type, ""}
                          : Reply{200, packet_type, pack_contacts(run, ranges[0], plan.contacts_of_frame)};
  }
  const auto group = query.find("group");
  const bool known =
      group != query.end() && (group->second == "platform" || group->second == "events" || group->second == "stats");
  if (place != "rows" || !known) return no_such();
  return {200, packet_type, pack_rows(run, rows_for_page(group->second, plan, *first))};
}

/// The page is paced from here: a browser slows down the clocks of a page in a hidden tab, but not the answers to it.
Reply Site::wait() const {
  const auto until = std::chrono::steady_clock::now() + page_waits;
  while (control_->running && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(look_again);
  return state();
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
  else if (name != "leave")
    return false;
  return true;
}

const RunFile& Site::file() {
  const auto now = std::chrono::steady_clock::now();
  const bool running = control_ && control_->running;
  // the file of a run that has just ended has its last rows, however lately it was opened
  if (!file_ || (control_ && (now - opened_ > fresh_for || running != opened_running_))) {
    file_.reset();
    file_.emplace(path_, allow_incomplete_ || control_);
    opened_ = now;
    opened_running_ = running;
  }
  return *file_;
}

}  // namespace gem::view
