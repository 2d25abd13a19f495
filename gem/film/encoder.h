// A film file, made by the program ffmpeg from pictures.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <string>

#include "gem/film/canvas.h"

namespace gem::film {

/// Hands pictures to ffmpeg through a pipe, never through a shell. The film is made beside its place, and the
/// destructor removes what was not finished.
class Encoder {
 public:
  /// `output` ends in .mp4 (H.264) or .webm (VP9). Throws Error(usage) without ffmpeg.
  Encoder(std::string output, int width, int height, double frames_per_second);
  ~Encoder();
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  /// Throws Error(file_system) with the reason that ffmpeg gives.
  void add(const Canvas& picture);
  /// Ends the film and gives it its name. Throws as add().
  void finish();

 private:
  void start(int width, int height, double frames_per_second);
  int end_program();
  [[noreturn]] void refuse();

  std::string output_, draft_;
  pid_t program_ = -1;
  int pipe_ = -1;
  std::FILE* messages_ = nullptr;  // of ffmpeg
};

}  // namespace gem::film
