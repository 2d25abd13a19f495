// One picture of a film: floes by speed, fixed bodies, platform, forces, time and scale.
#pragma once

#include <string>
#include <vector>

#include "gem/film/canvas.h"
#include "gem/film/film_poses.h"
#include "gem/record/run_file/contact_record.h"
#include "gem/record/run_file/run_file.h"
#include "gem/report/run/drawn_lines.h"

namespace gem::film {

/// What of the field a picture shows.
struct Window {
  Vec2 centre;         // [m]
  double scale = 1.0;  // pixels per metre
};

/// Draws pictures of one run. Everything throws Error(file_system) if the file is damaged.
class Picture {
 public:
  Picture(const RunFile& file, FilmPoses& poses);

  /// The window that holds all floes at `time` and the platform.
  Window whole_field(double time, const Canvas& canvas);
  /// The window of the platform and what is near it.
  Window near_platform(double time, const Canvas& canvas) const;
  void draw(Canvas& canvas, const Window& window, double time);

 private:
  void draw_floes(Canvas& canvas, const Window& window);
  void draw_fixed(Canvas& canvas, const Window& window) const;
  void draw_chains(Canvas& canvas, const Window& window, double time) const;
  void draw_lines(Canvas& canvas, const Window& window, double time) const;
  void draw_platform(Canvas& canvas, const Window& window, double time) const;
  void draw_texts(Canvas& canvas, const Window& window, double time) const;

  FilmPoses& poses_;
  ContactRecord contacts_;
  DrawnLines lines_;
  std::vector<std::vector<Vec2>> outlines_, fixed_;
  std::vector<std::vector<Vec2>> platform_;  // pieces
  std::vector<FloePose> floes_;              // of the picture that is drawn
  std::string title_;
  std::size_t first_floe_;
  std::string holder_;     // what the platform is held by
  double fastest_;         // end of the colour scale [m/s]
  double largest_load_;    // of ice and what holds the platform [N]
  double strong_force_;    // between bodies: the widest line [N]
  double diameter_ = 0.0;  // of the platform [m]
};

}  // namespace gem::film
