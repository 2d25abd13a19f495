// Pictures of the field to scale: outlines in metres, with one colour scale for speed.
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "gem/analysis/statistics/moments.h"
#include "gem/base/number_text.h"
#include "gem/report/display.h"
#include "gem/report/figures/figures.h"

namespace gem {
namespace {

struct View {
  double x_low, x_high, y_low, y_high;
};

bool inside(const View& view, double x, double y, double margin) {
  return x > view.x_low - margin && x < view.x_high + margin && y > view.y_low - margin && y < view.y_high + margin;
}

/// The area that floes and platform cover in any frame, with a margin that shows the inner edge of the boundary.
View channel_view(const RunData& run) {
  View view{0.0, 0.0, 0.0, 0.0};
  for (const Vec2 p : run.platform_outline)
    view = {std::min(view.x_low, p.x), std::max(view.x_high, p.x), std::min(view.y_low, p.y),
            std::max(view.y_high, p.y)};
  for (const FloeFrame& frame : run.frames)
    for (std::size_t i = 0; i < frame.x.size(); ++i)
      if (std::isfinite(frame.x[i]))
        view = {std::min(view.x_low, frame.x[i]), std::max(view.x_high, frame.x[i]), std::min(view.y_low, frame.y[i]),
                std::max(view.y_high, frame.y[i])};
  const double rim = 0.02 * (view.x_high - view.x_low) + 5.0;
  return {view.x_low - rim, view.x_high + rim, view.y_low - rim, view.y_high + rim};
}

/// One colour scale for all pictures: from zero to the 99.5 % quantile of floe speeds, but at least the current speed.
double speed_scale(const RunData& run) {
  double top = run.current_speed;
  for (const FloeFrame& frame : run.frames) {
    std::vector<double> speeds;
    std::copy_if(frame.speed.begin(), frame.speed.end(), std::back_inserter(speeds),
                 [](double value) { return std::isfinite(value); });
    top = std::max(top, percentile(speeds, 0.995));
  }
  const double decade = std::pow(10.0, std::floor(std::log10(std::max(top, 1e-6))));
  for (const double nice : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (top <= nice * decade * (1.0 + 1e-9)) return nice * decade;
  return 10.0 * decade;
}

Csv floes_csv(const RunData& run, const FloeFrame& frame, const View& view) {
  Csv csv("x [m],y [m],speed [m/s]");
  for (std::size_t i = 0; i < run.floe_outlines.size() && i < frame.x.size(); ++i) {
    if (!std::isfinite(frame.x[i]) || !inside(view, frame.x[i], frame.y[i], 20.0)) continue;
    const Rotation turn{std::cos(frame.theta[i]), std::sin(frame.theta[i])};
    const Corners& outline = run.floe_outlines[i];
    // The first corner is repeated at the end, so that the rows draw a closed line.
    for (std::size_t c = 0; c <= outline.size(); ++c) {
      const Vec2 p = Vec2{frame.x[i], frame.y[i]} + rotate(turn, outline[c % outline.size()]);
      csv.row({p.x, p.y, frame.speed[i]});
    }
    csv.gap();
  }
  return csv;
}

Csv outlines_csv(const std::vector<Corners>& outlines) {
  Csv csv("x [m],y [m]");
  for (const Corners& outline : outlines) {
    for (const Vec2 p : outline) csv.row({p.x, p.y});
    csv.gap();
  }
  return csv;
}

/// What of an outline lies where `depth` of a point is not negative; `depth` is linear (Sutherland and Hodgman 1974).
template <class Depth>
Corners cut(const Corners& outline, Depth depth) {
  Corners kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    const double in_a = depth(a), in_b = depth(b);
    if (in_a >= 0.0) kept.push_back(a);
    if ((in_a < 0.0) != (in_b < 0.0)) kept.push_back(a + (in_a / (in_a - in_b)) * (b - a));
  }
  return kept;
}

/// The fixed bodies as far as they are in view: gnuplot draws outlines wrongly that leave it.
Csv fixed_csv(const RunData& run, const View& view) {
  std::vector<Corners> seen;
  for (Corners outline : run.fixed) {
    outline = cut(outline, [&](Vec2 p) { return p.x - view.x_low; });
    outline = cut(outline, [&](Vec2 p) { return view.x_high - p.x; });
    outline = cut(outline, [&](Vec2 p) { return p.y - view.y_low; });
    outline = cut(outline, [&](Vec2 p) { return view.y_high - p.y; });
    if (outline.size() > 2) seen.push_back(outline);
  }
  return outlines_csv(seen);
}

/// The outlines of the platform's pieces at a time.
std::vector<Corners> platform_at(const RunData& run, double time) {
  const auto& times = run.platform.time;
  const auto at = std::min<std::size_t>(std::lower_bound(times.begin(), times.end(), time) - times.begin(),
                                        std::max<std::size_t>(times.size(), 1) - 1);
  const Vec2 place = times.empty() ? run.rest : Vec2{run.platform.x[at], run.platform.y[at]};
  const double yaw = run.platform.yaw.empty() || !std::isfinite(run.platform.yaw[at]) ? 0.0 : run.platform.yaw[at];
  std::vector<Corners> pieces = run.platform_pieces;
  if (pieces.empty()) pieces = {run.platform_outline};
  for (Corners& piece : pieces)
    for (Vec2& p : piece) p = place + rotate({std::cos(yaw), std::sin(yaw)}, p);
  return pieces;
}

struct FieldPicture {
  std::string name;
  std::string title;
  View view;
  PlotSize size;
  bool floe_edges = false;  // thin white lines between floes, only if a floe is many pixels wide
};

Figure draw_field(const RunData& run, const FloeFrame& frame, const FieldPicture& picture, double top_speed,
                  const PlotFolder& folder) {
  folder.write_csv(picture.name, floes_csv(run, frame, picture.view));
  const std::string fixed_name = picture.name + "_fixed";
  folder.write_csv(fixed_name, fixed_csv(run, picture.view));
  const std::string platform_name = picture.name + "_platform";
  folder.write_csv(platform_name, outlines_csv(platform_at(run, frame.time)));
  std::ostringstream commands;
  commands
      << "set size ratio -1\nset lmargin 8\nset rmargin 1\nset border 15\nunset grid\n"
      << "set label 1 " << quoted("t = " + time_text(frame.time)) << " at graph 0, graph 1 offset 0,0.8 front\n"
      << "set xlabel 'x [m]' offset 0,0.4\nset ylabel 'y [m]' offset 1,0\n"
      << "set xrange [" << rounded_text(picture.view.x_low, 5) << ':' << rounded_text(picture.view.x_high, 5)
      << "]\nset yrange [" << rounded_text(picture.view.y_low, 5) << ':' << rounded_text(picture.view.y_high, 5)
      << "]\nset cbrange [0:" << rounded_text(top_speed, 3) << "]\n"
      << "set cblabel 'speed [m/s]' offset -0.5,0\nset colorbox noborder\n"
      << "set object 1 rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '#eef2f5' fillstyle solid noborder\n"
      << "plot " << quoted(fixed_name + ".csv") << " using 1:2 with filledcurves closed fillcolor rgb '#b9bec6', \\\n"
      << "  " << quoted(picture.name + ".csv") << " using 1:2:3 with filledcurves closed fillcolor palette, \\\n";
  if (picture.floe_edges)
    commands << "  " << quoted(picture.name + ".csv") << " using 1:2 with lines lc rgb '#ffffff' lw 0.8, \\\n";
  commands << "  " << quoted(platform_name + ".csv") << " using 1:2 with filledcurves closed fillcolor rgb '#c2571a'\n";
  return folder.draw({picture.name, picture.title, "", ""}, picture.size, commands.str());
}

/// Height that leaves no empty band above or below a view with equal axes.
PlotSize channel_size(const View& view) {
  const double drawn_width = 1000.0 - 175.0;
  const double height = drawn_width * (view.y_high - view.y_low) / (view.x_high - view.x_low) + 85.0;
  return {1000, static_cast<int>(std::clamp(height, 160.0, 800.0))};
}

View close_view(const RunData& run) {
  double reach = 30.0;
  for (const Vec2 p : run.platform_outline) reach = std::max(reach, 3.0 * length(p));
  // A platform is looked at from its rest, a ship in transit where it is.
  Vec2 centre = run.rest;
  const auto& times = run.platform.time;
  if (run.transit.present && !times.empty() && run.frames.size() > 1) {
    const auto next = std::lower_bound(times.begin(), times.end(), run.frames[1].time);
    const std::size_t at = std::min<std::size_t>(next - times.begin(), times.size() - 1);
    centre = {run.platform.x[at], run.platform.y[at]};
  }
  return {centre.x - 1.4 * reach, centre.x + reach, centre.y - reach, centre.y + reach};
}

}  // namespace

Figure field_figure(const RunData& run, const std::string& name, const std::string& title, const PlotFolder& folder) {
  const View whole = channel_view(run);
  return draw_field(run, run.frames[1], {name, title, whole, channel_size(whole)}, speed_scale(run), folder);
}

Figure small_field_figure(const RunData& run, const std::string& name, const std::string& title,
                          const PlotFolder& folder) {
  const View view = close_view(run);
  const FloeFrame& frame = run.frames[1];
  folder.write_csv(name, floes_csv(run, frame, view));
  folder.write_csv(name + "_fixed", fixed_csv(run, view));
  folder.write_csv(name + "_platform", outlines_csv(platform_at(run, frame.time)));
  std::ostringstream commands;
  commands << "set size ratio -1\nunset border\nunset tics\nunset grid\nunset colorbox\nset margins 0, 0, 0, 0\n"
           << "set xrange [" << rounded_text(view.x_low, 5) << ':' << rounded_text(view.x_high, 5) << "]\nset yrange ["
           << rounded_text(view.y_low, 5) << ':' << rounded_text(view.y_high, 5)
           << "]\nset cbrange [0:" << rounded_text(speed_scale(run), 3) << "]\n"
           << "set object 1 rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '#eef2f5' fillstyle solid "
              "noborder\nset label 1 "
           << quoted(time_text(frame.time))
           << " at graph 0.02, graph 0.92 front font ',22' textcolor rgb '#3c4149'\nplot "
           << quoted(name + "_fixed.csv") << " using 1:2 with filledcurves closed fillcolor rgb '#b9bec6', "
           << quoted(name + ".csv") << " using 1:2:3 with filledcurves closed fillcolor palette, "
           << quoted(name + "_platform.csv") << " using 1:2 with filledcurves closed fillcolor rgb '#c2571a'\n";
  constexpr int width = 300;
  const double height = width * (view.y_high - view.y_low) / (view.x_high - view.x_low);
  return folder.draw({name, title, "", ""}, {width, static_cast<int>(height)}, commands.str());
}

std::vector<Figure> field_figures(const RunData& run, const PlotFolder& folder) {
  if (run.frames.size() < 3 || run.floe_outlines.empty()) return {};
  const double top = speed_scale(run);
  const View whole = channel_view(run);
  const char* names[] = {"field_start", run.at_s ? "field_at" : "field_middle", "field_end"};
  const std::string chosen = run.at_s ? "at " + time_text(run.frames[1].time) : "at the middle of the run";
  const std::string when[] = {"at the start of the run", chosen, "at the end of the run"};
  std::vector<Figure> figures;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string title = "The field " + when[i];
    figures.push_back(draw_field(run, run.frames[i], {names[i], title, whole, channel_size(whole)}, top, folder));
    figures.back().caption = title + ", to scale; floes coloured by speed, platform orange, fixed bodies grey.";
  }
  if (run.platform_outline.empty()) return figures;
  figures.push_back(draw_field(run, run.frames[1],
                               {"field_platform", "Ice around the platform", close_view(run), {1000, 760}, true}, top,
                               folder));
  figures.back().caption = "Ice around the platform " + chosen + ", on the same colour scale.";
  return figures;
}

}  // namespace gem
