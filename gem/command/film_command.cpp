// gem film: a run as a film file, by ffmpeg.
#include <charconv>
#include <memory>

#include "gem/base/error.h"
#include "gem/command/command.h"
#include "gem/command/time_option.h"
#include "gem/film/make_film.h"
#include "gem/record/output/output_path.h"
#include "gem/run/run_signals.h"

namespace gem {

namespace {

struct FilmChoice {
  film::FilmOptions options;
  std::string from, to, size = "1280x720";
};

/// Two even numbers, as most films want them.
void read_size(const std::string& text, film::FilmOptions& options) {
  const char* const end = text.data() + text.size();
  const auto wide = std::from_chars(text.data(), end, options.width);
  const bool parted = wide.ec == std::errc{} && wide.ptr != end && *wide.ptr == 'x';
  const auto high = parted ? std::from_chars(wide.ptr + 1, end, options.height) : wide;
  const auto fits = [](int pixels) { return pixels >= 64 && pixels <= 7680 && pixels % 2 == 0; };
  if (parted && high.ec == std::errc{} && high.ptr == end && fits(options.width) && fits(options.height)) return;
  throw Error(ExitCode::usage, "--size " + shown(text) +
                                   " is no size of a film (it takes two even numbers from 64 to 7680); give e.g. "
                                   "--size 1280x720");
}

int film_chosen(FilmChoice choice) {
  if (choice.options.output.empty())
    throw Error(ExitCode::usage, "the film has no name (NAME.mp4 or NAME.webm); give it after the run file");
  read_size(choice.size, choice.options);
  if (!choice.from.empty()) choice.options.from_s = time_of_option("--from", choice.from);
  if (!choice.to.empty()) choice.options.to_s = time_of_option("--to", choice.to);
  const StopSignals signals;
  print_about_file(film::make_film(choice.options, [] { return StopSignals::received() != 0; }));
  return exit_code_of_signal(StopSignals::received());
}

}  // namespace

void add_film_command(CLI::App& app, Chosen& chosen) {
  const auto choice = std::make_shared<FilmChoice>();
  CLI::App* command = app.add_subcommand("film", "write a run as a film; needs ffmpeg");
  film::FilmOptions& options = choice->options;
  command->add_option("file", options.run_file, "run file")->required()->type_name("RUNFILE");
  CLI::Option* place =
      command->add_option("out", options.output, "NAME.mp4 (H.264) or NAME.webm (VP9)")->check(not_empty());
  command->add_option("-o,--out", options.output, "the same, as in other commands")
      ->type_name("FILM")
      ->check(not_empty())
      ->excludes(place);
  command->add_option("--speed", options.speed, "simulated over film time; default: the film lasts half a minute")
      ->check(CLI::Range(1e-3, 1e6));
  command->add_option("--from", choice->from, "begin of the film, e.g. 20min; default: 0")->type_name("TIME");
  command->add_option("--to", choice->to, "end of the film; default: the last frame")->type_name("TIME");
  command->add_flag("--follow", options.follow, "keep the platform in the middle, and go near it");
  command->add_option("--size", choice->size, "width and height in pixels")
      ->type_name("WIDTHxHEIGHT")
      ->capture_default_str();
  command->add_option("--fps", options.frames_per_second, "pictures a second")
      ->check(CLI::Range(1.0, 120.0))
      ->capture_default_str();
  command->add_flag("--overwrite", options.overwrite, "replace an existing file");
  command->add_flag("--allow-incomplete", options.allow_incomplete, "film an incomplete run");
  command->footer("Forces between bodies are drawn if the run recorded them (output.contact_forces).");
  command->callback([choice, &chosen] {
    chosen.reading = {{choice->options.run_file}, false};  // ffmpeg may take long
    chosen.action = [choice] { return film_chosen(*choice); };
  });
}

}  // namespace gem
