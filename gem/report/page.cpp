// The sections of the page of a run, and its notes.
#include "gem/report/page.h"

#include "gem/record/run_file/run_file.h"
#include "gem/report/page_frame.h"
#include "gem/report/page_tables.h"

namespace gem {
namespace {

constexpr const char* kNotes = R"(<section><h2>How to read the numbers</h2>
<div class="notes">
<p>x and y are the axes of the case; motion is measured from where the mooring pulls nothing. Forces and impulses act on
the platform.</p>
<p>Ice loads are three quantities that are never mixed. The <em>impulse of a hit</em> is what
one floe gives from first touch to release; a floe that rests against the platform may press for minutes. An <em>average</em>
is the impulse over a stated time, divided by that time. The <em>force of a hit</em> is that of the ice, which springs and
crushes, in steps of milliseconds. Rigid ice has a <em>crushing peak</em> instead: it is the closed-form force at the end of the
crushing of one hit, from closing speed, effective mass, thickness and contact width, of the two bodies alone. Floes that
push from behind add to a hit, so an average over a short time may be larger. Against a flat side the peak is pressure times
contact area whatever the speed, and lasts milliseconds. It is a local load, not a load on the mooring. <em>Not converged</em> stands beside
loads of a short time if the verdict doubts the run for its unfinished time steps: there the iterations ended above their
tolerance, so that a contact gave part of its impulse later.</p>
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

std::string force_title(const RunData& run) {
  if (run.on_fixed.force.empty()) return "Forces on the platform";
  return run.platform.time.empty() ? "Forces on fixed bodies" : "Forces on the platform and on fixed bodies";
}

}  // namespace

std::string page_title(const std::string& run) { return escaped(run) + " - run report"; }

std::string page_html(const RunData& run, const RunFindings& findings, const std::vector<Finding>& analysis,
                      const PageFigures& figures) {
  const std::string name = escaped(run.identity.name);
  const std::string loads_on = run.platform.time.empty() && !run.on_fixed.force.empty() ? "fixed bodies" : "a platform";
  std::string html =
      "<header><h1>" + name + "</h1>\n<p>Ice loads on " + loads_on + ": report of one run</p></header>\n";
  html += warning(run.identity) + bad_warning(run.verdict) + headline_html(run, findings, analysis);
  html += figures.field.empty() ? no_field_html(run) : figure_section("The field", figures.field, false);
  html += "<section><h2 class=\"page\">The run in numbers</h2>\n" + verdict_html(run.verdict) +
          motion_html(run, findings, analysis) + loads_html(run, findings, analysis) + sides_html(run) +
          lines_html(run) + dp_html(run) + fixed_html(run) + quality_html(run, findings) + identity_html(run) +
          "</section>\n";
  html += figure_section("Motion of the platform", figures.motion, true);
  html += figure_section(force_title(run), figures.force, true);
  html += figure_section("Books of the run", figures.books, false);
  return html_page(page_title(run.identity.name), html + kNotes);
}

}  // namespace gem
