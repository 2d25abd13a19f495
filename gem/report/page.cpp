// The frame of the page: style, sections, notes.
#include "gem/report/page.h"

#include "gem/record/run_file/run_file.h"
#include "gem/report/page_tables.h"
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

constexpr const char* kNotes = R"(<section><h2>How to read the numbers</h2>
<div class="notes">
<p>x points along the current, y to its left; motion is measured from where the mooring pulls nothing. Forces and
impulses act on the platform.</p>
<p>Ice loads are three quantities that are never mixed. An <em>event impulse</em> is what one collision gives in one
time step; a floe that rests against the platform has one in every time step. An <em>average</em> is the impulse over a stated time, divided by that time. A <em>crushing peak</em> is the
closed-form force of one event at the end of its crushing, from closing speed, effective mass, thickness and contact
width. It lasts about a tenth of a second or less and does not follow from the impulse over a time step. Against a flat
side it is pressure times contact area whatever the speed, and lasts milliseconds: a bound on local load, not a load on
the mooring. It is given for impacts, that is for events that follow at least a second without contact of the same
floe.</p>
<p>Means, periods and contact are those of <code>gem analyse</code>, with intervals of 95 %. Intervals of
means allow for correlation. They are given only for records of at least 16 natural periods. The spectral period carries a
jackknife over the tapers and half a resolution cell; where that spans more than a factor of two, the run does not
resolve a main period. The mean times between zero up-crossings of the record without its mean, and between local
maxima, are given from twenty of them on. Maxima count every wiggle, so that counts by eye can be compared.</p>
</div></section>
)";

/// Says why there are no pictures of the field.
std::string no_field_html(const RunData& run) {
  std::string why = "The run has no floes.";
  if (!run.floe_outlines.empty()) {
    const char* recorded[] = {"No frames", "One frame", "Two frames"};
    why = std::string(recorded[run.frames.size()]) +
          " of the floes recorded: pictures of the field need three (<code>output.floes_interval_s</code>).";
  }
  return "<section><h2>The field</h2>\n<p class=\"notes\">" + why + "</p></section>\n";
}

std::string figure_html(const Figure& figure) {
  return "<figure role=\"img\" aria-label=\"" + escaped(figure.title) + "\">\n" + figure.svg + "\n<figcaption>" +
         figure.caption + " <span><a href=\"figures/" + figure.name + ".csv\">numbers</a>, <a href=\"figures/" +
         figure.name + ".gp\">script</a></span></figcaption>\n</figure>\n";
}

std::string section(const std::string& title, const std::vector<Figure>& figures, bool new_page) {
  if (figures.empty()) return "";
  std::string html = std::string("<section><h2") + (new_page ? " class=\"page\"" : "") + ">" + title + "</h2>\n";
  for (const Figure& figure : figures) html += figure_html(figure);
  return html + "</section>\n";
}

std::string warning(const RunIdentity& identity) {
  if (ended_as_asked(identity.status)) return "";
  return "<p class=\"warning\">This run is not complete (status: " + escaped(identity.status) +
         "). Everything below covers only the part that was recorded.</p>\n";
}

std::string bad_warning(const RunVerdict& verdict) {
  if (verdict.grade != Grade::bad) return "";
  return "<p class=\"warning\">The numbers of this run cannot be believed: its verdict is bad. The reasons are in the "
         "table Verdict.</p>\n";
}

}  // namespace

std::string page_title(const std::string& run) { return escaped(run) + " - run report"; }

std::string page_html(const RunData& run, const RunFindings& findings, const std::vector<Finding>& analysis,
                      const PageFigures& figures) {
  const std::string name = escaped(run.identity.name);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      page_title(run.identity.name) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n";
  html += "<header><h1>" + name + "</h1>\n<p>Ice loads on a moored platform: report of one run</p></header>\n";
  html += warning(run.identity) + bad_warning(run.verdict) + headline_html(run, findings, analysis);
  html += figures.field.empty() ? no_field_html(run) : section("The field", figures.field, false);
  html += "<section><h2 class=\"page\">The run in numbers</h2>\n" + verdict_html(run.verdict) +
          motion_html(run, findings, analysis) + loads_html(run, findings, analysis) + quality_html(run, findings) +
          identity_html(run) + "</section>\n";
  html += section("Motion of the platform", figures.motion, true);
  html += section("Forces on the platform", figures.force, true);
  html += section("Books of the run", figures.books, false);
  return html + kNotes + "</body>\n</html>\n";
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

}  // namespace gem
