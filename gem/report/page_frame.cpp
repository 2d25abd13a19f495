// Style, escaping and figures of all pages.
#include "gem/report/page_frame.h"

#include <fstream>
#include <iterator>

#include "gem/base/error.h"
#include "gem/report/plain_text.h"

namespace gem {
namespace {

constexpr const char* kStyle = R"(
:root { --ink: #1f2530; --soft: #5c6470; --line: #e1e4e8; --accent: #31688e; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 3rem 2rem 4rem; max-width: 66rem; background: #ffffff; color: var(--ink);
       font: 16px/1.5 "Source Sans 3", "Helvetica Neue", Helvetica, Arial, sans-serif; }
header { border-bottom: 2px solid var(--ink); padding-bottom: .8rem; }
h1 { font-size: 2rem; font-weight: 600; line-height: 1.15; margin: 0; overflow-wrap: anywhere; }
header p { margin: .3rem 0 0; color: var(--soft); }
h2 { font-size: 1.25rem; font-weight: 600; margin: 3rem 0 .5rem; }
.warning { border: 2px solid #b3261e; color: #8c1d18; background: #fdf1f0; padding: .7rem 1rem; margin: 1.2rem 0;
           font-weight: 600; }
.headline { display: flex; flex-wrap: wrap; gap: 1rem 2.5rem; margin: 1.8rem 0 .5rem; }
.headline div { flex: 1 1 9rem; }
.headline strong { display: block; font-size: 1.7rem; font-weight: 600; line-height: 1.2; color: var(--accent);
                   white-space: nowrap; }
.headline span { color: var(--soft); font-size: .88rem; line-height: 1.3; display: block; }
table { border-collapse: collapse; width: 100%; margin: 1.6rem 0; font-size: .95rem;
        font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; padding-bottom: .35rem; border-bottom: 1px solid var(--ink); }
th, td { text-align: left; vertical-align: top; padding: .28rem .8rem .28rem 0; border-bottom: 1px solid var(--line);
         font-weight: 400; }
th[scope=row] { color: var(--soft); width: 24rem; }
th[scope=col] { font-weight: 600; }
code { font: .85em ui-monospace, "DejaVu Sans Mono", Menlo, monospace; overflow-wrap: anywhere; }
figure { margin: 1.4rem 0 2rem; }
figure svg { display: block; width: 100%; height: auto; }
figure svg text, figure svg tspan { font-family: "Source Sans 3", "Helvetica Neue", Helvetica, Arial, sans-serif; }
figcaption { color: var(--soft); font-size: .9rem; max-width: 52rem; margin-top: .3rem; }
figcaption span { white-space: nowrap; }
figcaption a { color: var(--accent); text-decoration: none; }
figcaption a:hover { text-decoration: underline; }
.notes { color: var(--soft); font-size: .9rem; max-width: 52rem; }
.matrix { table-layout: fixed; }
.matrix td, .matrix th { padding: .4rem .6rem .6rem 0; font-size: .74rem; line-height: 1.35; border-bottom: none; }
.matrix th[scope=row] { width: 4rem; overflow-wrap: anywhere; color: var(--ink); font-weight: 600; }
.matrix svg { display: block; width: 100%; height: auto; border: 1px solid var(--line); margin-bottom: .3rem; }
.matrix p { margin: 0; overflow: hidden; }
.matrix p span { float: right; text-align: right; }
.matrix i { display: block; height: 4px; min-width: 1px; background: var(--accent); margin-bottom: .2rem; }
.runs { font-size: .82rem; }
.runs th[scope=row] { width: auto; color: var(--ink); }
@page { size: A4; margin: 16mm 15mm; }
@media print {
  body { padding: 0; max-width: none; font-size: 10pt; -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  h1 { font-size: 18pt; }
  h2 { break-after: avoid; margin-top: 1.4rem; }
  h2.page { break-before: page; }
  figure, table, .headline { break-inside: avoid; }
  figcaption span { display: none; }
  th[scope=row] { width: 16rem; }
}
)";

std::string figure_html(const Figure& figure) {
  return "<figure role=\"img\" aria-label=\"" + escaped(figure.title) + "\">\n" + figure.svg + "\n<figcaption>" +
         figure.caption + " <span><a href=\"figures/" + figure.name + ".csv\">numbers</a>, <a href=\"figures/" +
         figure.name + ".gp\">script</a></span></figcaption>\n</figure>\n";
}

}  // namespace

std::string html_page(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         title + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n" + body + "</body>\n</html>\n";
}

std::string figure_section(const std::string& title, const std::vector<Figure>& figures, bool new_page) {
  if (figures.empty()) return "";
  std::string html = std::string("<section><h2") + (new_page ? " class=\"page\"" : "") + ">" + title + "</h2>\n";
  for (const Figure& figure : figures) html += figure_html(figure);
  return html + "</section>\n";
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : plain_text(text)) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\'')
      result += "&#39;";
    else
      result += c;
  }
  return result;
}

void check_page_folder(const std::filesystem::path& folder, const std::string& title, const std::string& what) {
  const std::filesystem::path page = folder / "index.html";
  std::ifstream old(page, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(old), std::istreambuf_iterator<char>()};
  if (text.empty() || text.find("<title>" + title + "</title>") != std::string::npos) return;
  throw Error(ExitCode::usage, page.string() + " exists already (it is not the " + what +
                                   "); choose another folder with --out, or remove this one");
}

void write_page(const std::filesystem::path& folder, const std::string& html) {
  std::ofstream page(folder / "index.html", std::ios::binary);
  page << html;
  page.close();
  if (!page)
    throw Error(ExitCode::file_system, "cannot write " + (folder / "index.html").string() +
                                           " (disk full or no permission); choose another output folder");
}

}  // namespace gem
