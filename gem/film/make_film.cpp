// From the times of a run to the pictures of a film.
#include "gem/film/make_film.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/film/encoder.h"
#include "gem/film/picture.h"
#include "gem/record/output/output_path.h"

namespace gem::film {

namespace {

constexpr double usual_film_s = 30.0;
constexpr double pictures_maximum = 200'000.0;  // two hours at 30 a second

void check_film_options(const FilmOptions& options, const FilmPoses& poses, double to) {
  const auto refuse = [](const std::string& text) { throw Error(ExitCode::usage, text); };
  if (!(to > options.from_s))
    refuse("the film would end before it begins (from " + number_text(options.from_s) + " s to " + number_text(to) +
           " s; the record ends at " + number_text(poses.end()) + " s); choose other times");
  if (options.follow && !poses.has_platform())
    refuse("--follow has no effect on " + shown(options.run_file) + " (it has no platform); leave it out");
}

}  // namespace

std::string make_film(const FilmOptions& options, const std::function<bool()>& stopped) {
  const std::string ending = std::filesystem::path(options.output).extension().string();
  if (ending != ".mp4" && ending != ".webm")
    throw Error(ExitCode::usage,
                "cannot write " + shown(options.output) + " (its ending names no film); allowed are .mp4 and .webm");
  check_output_path(options.output, options.overwrite);
  const RunFile file(options.run_file, options.allow_incomplete);
  FilmPoses poses(file);
  const double to = options.to_s < 0.0 ? poses.end() : std::min(options.to_s, poses.end());
  check_film_options(options, poses, to);
  const double span = to - options.from_s;
  const double speed = options.speed > 0.0 ? options.speed : std::max(1.0, span / usual_film_s);
  const double pictures = std::floor(span / speed * options.frames_per_second) + 1.0;
  if (pictures > pictures_maximum)
    throw Error(ExitCode::usage, "the film would have " + fixed_text(pictures, 0) + " pictures (at most " +
                                     fixed_text(pictures_maximum, 0) + "); choose a larger --speed");
  Canvas canvas(options.width, options.height);
  Picture picture(file, poses);
  Encoder encoder(options.output, options.width, options.height, options.frames_per_second);
  Window window = picture.whole_field(options.from_s, canvas);
  for (double n = 0.0; n < pictures; n += 1.0) {
    if (stopped()) return "";
    const double time = options.from_s + n * speed / options.frames_per_second;
    if (options.follow) window = picture.near_platform(time, canvas);
    picture.draw(canvas, window, time);
    encoder.add(canvas);
  }
  encoder.finish();
  return shown(options.output) + ": " + fixed_text(pictures, 0) + " pictures, " +
         number_text(pictures / options.frames_per_second, 3) + " s, " + number_text(speed, 3) +
         " times as fast as the run\n";
}

}  // namespace gem::film
