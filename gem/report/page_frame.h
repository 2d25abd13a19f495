// What all pages share: one HTML file with style and pictures inside, and the folder that it lies in.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gem/report/figures/plot_folder.h"

namespace gem {

/// A self-contained page: style and pictures are inline, nothing is loaded from elsewhere. `title` and `body` are HTML.
std::string html_page(const std::string& title, const std::string& body);

/// A section with figures; empty without figures. `new_page`: it begins a page in print.
std::string figure_section(const std::string& title, const std::vector<Figure>& figures, bool new_page);

/// Text escaped for HTML.
std::string escaped(const std::string& text);

/// Throws Error(usage) if the folder holds a page of another title. `what` says whose page it should be.
void check_page_folder(const std::filesystem::path& folder, const std::string& title, const std::string& what);

/// Writes folder/index.html. Throws Error(file_system) if it cannot.
void write_page(const std::filesystem::path& folder, const std::string& html);

}  // namespace gem
