// Puts style, script and data into the frame page/page.html. Data are JSON with every < escaped, and base64.
#include "gem/view/page_text.h"

#include <nlohmann/json.hpp>

#include "gem/base/base64.h"
#include "gem/base/sha256.h"
#include "gem/report/page_frame.h"
#include "gem/view/pack/packet.h"

namespace gem::view {

namespace {

/// Packets before the script: it draws them while the browser still reads the others.
constexpr std::size_t first_packets = 5;

/// 'sha256-...' as a policy wants it.
std::string source_hash(const std::string& text) {
  const std::string hex = sha256_hex(text);
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return "'sha256-" + base64(bytes) + "'";
}

std::string script_safe(const std::string& json) {
  std::string out;
  for (const char c : json) c == '<' ? out += "\\u003c" : out += c;
  return out;
}

std::string data_tag(const std::string& kind, const std::string& text) {
  return "<script type=\"" + kind + "\">" + text + "</script>\n";
}

/// Puts `by` in the place of `mark`, at or behind `at`, and returns where it ends: what was put in is not searched.
std::size_t replace(std::string& text, std::size_t at, const std::string& mark, const std::string& by) {
  const std::size_t found = text.find(mark, at);
  text.replace(found, mark.size(), by);
  return found + by.size();
}

std::string page_with(const std::string& mark, const std::string& title, const std::string& data, bool served,
                      const std::string& more = "") {
  std::string page = page_html;
  std::size_t at = replace(page, 0, "@mark@", mark);
  at = replace(page, at, "@policy@", content_security_policy(served));
  at = replace(page, at, "@title@", escaped(title));
  at = replace(page, at, "@style@", page_style);
  at = replace(page, at, "@data@", data);
  at = replace(page, at, "@script@", page_script);
  replace(page, at, "@more@", more);
  return page;
}

}  // namespace

std::string content_security_policy(bool served) {
  return "default-src 'none'; script-src " + source_hash(page_script) + "; style-src " + source_hash(page_style) +
         "; img-src blob: data:; media-src blob:; base-uri 'none'; form-action 'none'; connect-src " +
         (served ? "'self'" : "'none'");
}

std::string page_mark(const nlohmann::ordered_json& description) {
  return sha256_hex(description.value(nlohmann::ordered_json::json_pointer("/origin/gem_case_sha256"), std::string()));
}

std::string whole_page(const nlohmann::ordered_json& description, const std::vector<std::string>& packets) {
  std::string data = data_tag("application/json", script_safe(json_text(description)));
  std::string more;
  for (std::size_t i = 0; i < packets.size(); ++i)
    (i < first_packets ? data : more) += data_tag("text/base64", base64(packets[i]));
  return page_with(page_mark(description), description.at("name").get<std::string>(), data, false, more);
}

std::string served_page(const std::string& title, bool live) {
  return page_with("served", title, data_tag("text/server", live ? "live" : "file"), true);
}

}  // namespace gem::view
