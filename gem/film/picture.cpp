// Metres to pixels, colours, and the order in which things are drawn.
#include "gem/film/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/column_pieces.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/scene/scene_mooring.h"

namespace gem::film {

namespace {

constexpr Colour water = {203, 224, 236}, land = {165, 175, 185}, hull = {223, 229, 234}, ink = {31, 37, 48},
                 rim = {70, 82, 96}, load = {211, 84, 0}, mooring = {11, 99, 181}, chain = {179, 0, 27},
                 slack = {120, 130, 140};

/// The map viridis (CC0), at nine places.
constexpr std::array<Colour, 9> viridis = {{{68, 1, 84},
                                            {71, 44, 122},
                                            {59, 81, 139},
                                            {44, 113, 142},
                                            {33, 144, 141},
                                            {39, 173, 129},
                                            {92, 200, 99},
                                            {170, 220, 50},
                                            {253, 231, 37}}};

/// Speed at the end of the colours [m/s].
double fastest_shown(const SceneDef& scene) {
  const TransitDef& transit = scene.transit;
  return std::max(
      {1.1 * length(scene.current.velocity_m_per_s), transit.speed_m_per_s, transit.open_water_speed_m_per_s, 0.05});
}

Colour colour_of(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (viridis.size() - 1);
  const auto n = std::min<std::size_t>(static_cast<std::size_t>(at), viridis.size() - 2);
  const auto mix = [&](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a + (at - double(n)) * (b - a)));
  };
  const Colour p = viridis[n], q = viridis[n + 1];
  return {mix(p.red, q.red), mix(p.green, q.green), mix(p.blue, q.blue)};
}

Vec2 pixel(const Canvas& canvas, const Window& window, Vec2 place) {
  return {0.5 * canvas.width() + window.scale * (place.x - window.centre.x),
          0.5 * canvas.height() - window.scale * (place.y - window.centre.y)};
}

std::vector<Vec2> placed_pixels(const Canvas& canvas, const Window& window, const std::vector<Vec2>& outline,
                                Vec2 position, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<Vec2> corners;
  for (const Vec2 p : outline)
    corners.push_back(pixel(canvas, window, {position.x + c * p.x - s * p.y, position.y + s * p.x + c * p.y}));
  return corners;
}

void arrow(Canvas& canvas, Vec2 from, Vec2 to, Colour colour) {
  const double size = length(to - from);
  if (size < 4.0) return;
  const Vec2 along = (1.0 / size) * (to - from), across = turned_left(along);
  canvas.line({from, to - 8.0 * along}, 3.0, colour);
  canvas.fill({to, to - 12.0 * along + 6.0 * across, to - 12.0 * along - 6.0 * across}, colour);
}

double largest_of(const RunFile& file, const std::string& name) {
  if (!file.has("platform/" + name + "_x")) return 0.0;
  double largest = 0.0;
  for_each_piece(file, {"platform/" + name + "_x", "platform/" + name + "_y"}, [&](const ColumnPiece& piece) {
    const auto &x = piece.values[0], &y = piece.values[1];
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
      if (std::isfinite(x[i]) && std::isfinite(y[i])) largest = std::max(largest, std::hypot(x[i], y[i]));
  });
  return largest;
}

/// A force that few of some frames exceed.
double strong_force(const ContactRecord& record, const std::vector<double>& times) {
  std::vector<double> sizes;
  const std::size_t stride = std::max<std::size_t>(1, times.size() / 20);
  for (std::size_t n = 0; n < times.size(); n += stride)
    for (const ContactForce& c : record.at(times[n])) sizes.push_back(length(c.force));
  if (sizes.empty()) return 1.0;
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(0.98 * double(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  return std::max(*at, 1.0);
}

std::string clock_text(double seconds) {
  const long whole = std::lround(std::floor(std::max(0.0, seconds)));
  char text[40];
  std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  return text;
}

}  // namespace

namespace {

/// A tow, the thrust of a ship in transit with what holds it on its path, and the ground give back each hit in one time
/// step, so their largest force is no measure for arrows.
double largest_load(const RunFile& file, const std::string& holder) {
  const bool gives_back_hits = holder == "tow" || holder == "thrust" || holder == "ground";
  const double held = gives_back_hits ? 0.0 : largest_of(file, "mooring_force");
  return std::max({largest_of(file, "ice_force_mean"), held, 1.0});
}

}  // namespace

Picture::Picture(const RunFile& file, FilmPoses& poses)
    : poses_(poses),
      contacts_(file),
      lines_(file, stored_scene(file)),
      outlines_(file.floe_outlines()),
      fixed_(file.boundary_outlines()),
      platform_(file.platform_pieces()),
      title_(file.attribute("title").substr(0, 60)),
      first_floe_(static_cast<std::size_t>(contacts_.first_floe())),
      holder_(holder_of(stored_scene(file))),
      fastest_(fastest_shown(stored_scene(file))),
      largest_load_(largest_load(file, holder_)),
      strong_force_(strong_force(contacts_, file.column("floes/time"))) {
  if (outlines_.size() != file.floe_count())
    throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (" + std::to_string(outlines_.size()) +
                                           " outlines for " + std::to_string(file.floe_count()) +
                                           " floes); the file may be damaged");
  for (const std::vector<Vec2>& piece : platform_)
    for (const Vec2 p : piece)
      if (std::isfinite(length(p))) diameter_ = std::max(diameter_, 2.0 * length(p));
}

Window Picture::whole_field(double time, const Canvas& canvas) {
  Vec2 low{1e30, 1e30}, high{-1e30, -1e30};
  const auto add = [&](Vec2 p, double radius) {
    low = {std::min(low.x, p.x - radius), std::min(low.y, p.y - radius)};
    high = {std::max(high.x, p.x + radius), std::max(high.y, p.y + radius)};
  };
  const std::vector<FloePose> floes = poses_.floes_at(time);
  for (std::size_t i = 0; i < floes.size(); ++i) {
    double radius = 0.0;
    for (const Vec2 p : outlines_[i]) radius = std::max(radius, length(p));
    if (floes[i].there && std::isfinite(radius)) add(floes[i].position, radius);
  }
  if (poses_.has_platform()) add(poses_.platform_at(time).position, 0.5 * diameter_);
  if (!(high.x > low.x && high.y > low.y)) return {{0.0, 0.0}, 1.0};
  const double scale = 0.94 * std::min(canvas.width() / (high.x - low.x), canvas.height() / (high.y - low.y));
  return {0.5 * (low + high), scale};
}

Window Picture::near_platform(double time, const Canvas& canvas) const {
  const double size = std::max(diameter_, 1.0);
  return {poses_.platform_at(time).position, std::min(canvas.width(), canvas.height()) / (3.5 * size)};
}

void Picture::draw_floes(Canvas& canvas, const Window& window) {
  for (std::size_t i = 0; i < floes_.size(); ++i) {
    if (!floes_[i].there) continue;
    const std::vector<Vec2> corners = placed_pixels(canvas, window, outlines_[i], floes_[i].position, floes_[i].angle);
    canvas.fill(corners, colour_of(floes_[i].speed / fastest_));
    canvas.line(corners, 0.7, rim, true);
  }
}

void Picture::draw_fixed(Canvas& canvas, const Window& window) const {
  for (const std::vector<Vec2>& outline : fixed_) {
    const std::vector<Vec2> corners = placed_pixels(canvas, window, outline, {}, 0.0);
    canvas.fill(corners, land);
    canvas.line(corners, 1.0, ink, true);
  }
}

void Picture::draw_chains(Canvas& canvas, const Window& window, double time) const {
  const auto centre = [&](std::int32_t body, Vec2& place) {
    const std::size_t floe = static_cast<std::size_t>(body) - first_floe_;
    const bool is_floe = static_cast<std::size_t>(body) >= first_floe_ && floe < floes_.size() && floes_[floe].there;
    if (is_floe) place = floes_[floe].position;
    if (body == 0 && poses_.has_platform()) place = poses_.platform_at(time).position;
    return is_floe || (body == 0 && poses_.has_platform());
  };
  for (const ContactForce& contact : contacts_.at(poses_.frame_time(time))) {
    const double width = 9.0 * std::sqrt(std::min(1.0, length(contact.force) / strong_force_));
    if (width < 0.6) continue;
    Vec2 a, b;
    if (!centre(contact.b, b)) continue;
    std::vector<Vec2> line = {pixel(canvas, window, contact.point), pixel(canvas, window, b)};
    if (centre(contact.a, a)) line.insert(line.begin(), pixel(canvas, window, a));
    canvas.line(line, width, chain);
  }
}

/// As wide as the tension is large. A slack line is thin and grey, of a broken one a stub is left at its anchor.
void Picture::draw_lines(Canvas& canvas, const Window& window, double time) const {
  constexpr double usual = 2.5, narrowest = 1.0, widest = 8.0, stub = 0.2;
  if (!poses_.has_platform()) return;
  const PlatformPose pose = poses_.platform_at(time);
  if (!std::isfinite(pose.position.x + pose.position.y + pose.angle)) return;
  for (const DrawnLine& line : lines_.at(pose.position, pose.angle, time)) {
    const Vec2 anchor = pixel(canvas, window, line.anchor);
    const Vec2 end =
        line.state == LineState::broken ? line.anchor + stub * (line.fairlead - line.anchor) : line.fairlead;
    const double width = std::clamp(usual * line.tension / lines_.usual_tension(), narrowest, widest);
    canvas.line({anchor, pixel(canvas, window, end)}, line.state == LineState::broken ? 2.0 : width,
                line.state == LineState::holds   ? mooring
                : line.state == LineState::slack ? slack
                                                 : chain);
  }
}

void Picture::draw_platform(Canvas& canvas, const Window& window, double time) const {
  if (!poses_.has_platform()) return;
  const PlatformPose pose = poses_.platform_at(time);
  for (const std::vector<Vec2>& piece : platform_) {
    const std::vector<Vec2> corners = placed_pixels(canvas, window, piece, pose.position, pose.angle);
    canvas.fill(corners, hull);
    canvas.line(corners, 1.5, ink, true);
  }
  const double metres = diameter_ / largest_load_;
  const auto show = [&](Vec2 force, Colour colour) {
    if (!std::isfinite(force.x + force.y)) return;
    arrow(canvas, pixel(canvas, window, pose.position), pixel(canvas, window, pose.position + metres * force), colour);
  };
  show(pose.mooring, mooring);
  show(pose.ice_force, load);
}

void Picture::draw_texts(Canvas& canvas, const Window& window, double time) const {
  const double high = std::max(9.0, canvas.height() / 50.0), margin = high;
  const auto label = [&](const std::string& text, Vec2 at, Colour colour) {
    const double width = Canvas::text_width(text, high), pad = 0.4 * high;
    canvas.fill(
        {at + Vec2{-pad, pad}, at + Vec2{width, pad}, at + Vec2{width, -high - pad}, at + Vec2{-pad, -high - pad}},
        {255, 255, 255});
    canvas.text(text, at, high, colour);
  };
  label(title_ + "  " + clock_text(time), {margin, margin + high}, ink);
  if (poses_.has_platform()) {
    const PlatformPose pose = poses_.platform_at(time);
    label("ice " + fixed_text(length(pose.ice_force) / 1e3, 0) + " kN", {margin, margin + 3.2 * high}, load);
    const std::string holder = holder_ == "tow" || holder_ == "thrust" ? holder_ + " and hold" : holder_;
    label(holder + " " + fixed_text(length(pose.mooring) / 1e3, 0) + " kN", {margin, margin + 5.4 * high}, mooring);
  }
  // colours
  const double width = 0.2 * canvas.width(), bottom = canvas.height() - margin;
  for (int x = 0; x < int(width); ++x) {
    const double left = margin + x;
    canvas.fill({{left, bottom - high}, {left + 1, bottom - high}, {left + 1, bottom}, {left, bottom}},
                colour_of(x / width));
  }
  label("speed 0 to " + number_text(fastest_, 2) + " m/s", {margin, bottom - 1.8 * high}, ink);
  // scale
  double metres = std::pow(10.0, std::floor(std::log10(0.2 * canvas.width() / window.scale)));
  for (const double n : {5.0, 2.0})
    if (n * metres * window.scale <= 0.2 * canvas.width()) {
      metres *= n;
      break;
    }
  const double right = canvas.width() - margin, left = right - metres * window.scale;
  canvas.line({{left, bottom - 6}, {left, bottom}, {right, bottom}, {right, bottom - 6}}, 2.0, ink);
  const std::string text = number_text(metres, 3) + " m";
  label(text, {right - Canvas::text_width(text, high), bottom - high}, ink);
}

void Picture::draw(Canvas& canvas, const Window& window, double time) {
  floes_ = poses_.floes_at(time);
  canvas.clear(water);
  draw_floes(canvas, window);
  draw_fixed(canvas, window);
  draw_chains(canvas, window, time);
  draw_lines(canvas, window, time);
  draw_platform(canvas, window, time);
  draw_texts(canvas, window, time);
}

}  // namespace gem::film
