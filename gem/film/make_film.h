// A run as a film file.
#pragma once

#include <functional>
#include <string>

namespace gem::film {

struct FilmOptions {
  std::string run_file, output;
  bool overwrite = false, allow_incomplete = false;
  bool follow = false;  ///< keep the platform in the middle
  double speed = 0.0;   ///< simulated over film time; 0: so that the film lasts half a minute
  double from_s = 0.0;  ///< [s]
  double to_s = -1.0;   ///< [s]; negative: the last frame
  int width = 1280, height = 720;
  double frames_per_second = 30.0;
};

/// Makes the film and returns a line for people. Asks `stopped` before each picture; after a stop nothing is left, and
/// the line is empty. Throws Error(usage) for options that do not fit the run and without ffmpeg, Error(file_system) if
/// the run cannot be read or the film not be written.
std::string make_film(const FilmOptions& options, const std::function<bool()>& stopped);

}  // namespace gem::film
