// The page of a run as HTML text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace gem::view {

/// Sources of the page, embedded in the program. gem_page.cmake makes them of gem/view/page.
extern const std::string page_html, page_style, page_script;

/// Names the case of a run, in hex digits: it stands in the first comment of a page, behind the words `gem view`.
std::string page_mark(const nlohmann::ordered_json& description);

/// A page with its data in it, which loads nothing: description and packets of pack/pack_run.h.
std::string whole_page(const nlohmann::ordered_json& description, const std::vector<std::string>& packets);

/// A page that asks the server it came from for its data. `live`: the run goes on, and has buttons.
std::string served_page(const std::string& title, bool live);

/// What the browser may do in the page: run its own script, and ask its own server if it has one.
std::string content_security_policy(bool served);

}  // namespace gem::view
