// Starts ffmpeg by POSIX calls.
#include "gem/film/encoder.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <vector>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/record/output/output_path.h"
#include "gem/report/plain_text.h"

extern char** environ;

namespace gem::film {

namespace {

/// Beside the output, with the same ending: ffmpeg chooses the format by it.
std::string draft_beside(const std::string& output) {
  const std::filesystem::path path(output);
  return (path.parent_path() / ("." + path.stem().string() + ".new" + path.extension().string())).string();
}

std::vector<std::string> command_for(const std::string& draft, int width, int height, double frames_per_second) {
  std::vector<std::string> command = {"ffmpeg",    "-hide_banner",
                                      "-loglevel", "error",
                                      "-nostdin",  "-y",
                                      "-f",        "rawvideo",
                                      "-pix_fmt",  "rgb24",
                                      "-s",        std::to_string(width) + "x" + std::to_string(height),
                                      "-r",        number_text(frames_per_second),
                                      "-i",        "pipe:0",
                                      "-an",       "-pix_fmt",
                                      "yuv420p"};
  const bool webm = draft.ends_with(".webm");
  for (const char* part : webm ? std::vector<const char*>{"-c:v", "libvpx-vp9", "-crf", "32", "-b:v", "0", "-deadline",
                                                          "realtime", "-cpu-used", "7", "-row-mt", "1"}
                               : std::vector<const char*>{"-c:v", "libx264", "-preset", "veryfast", "-crf", "20",
                                                          "-movflags", "+faststart"})
    command.emplace_back(part);
  // a name with a colon or a dash at its beginning is a file all the same
  command.push_back("file:" + draft);
  return command;
}

/// A program that ends early must not end this one.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &ignore, &before_);
  }
  ~NoPipeSignal() { sigaction(SIGPIPE, &before_, nullptr); }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  struct sigaction before_ {};
};

}  // namespace

Encoder::Encoder(std::string output, int width, int height, double frames_per_second)
    : output_(std::move(output)), draft_(draft_beside(output_)) {
  start(width, height, frames_per_second);
}

void Encoder::start(int width, int height, double frames_per_second) {
  messages_ = std::tmpfile();
  std::array<int, 2> ends{};
  if (messages_ == nullptr || ::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error(ExitCode::resource_limit, "cannot start ffmpeg (no file or pipe left); close other programs");
  const std::vector<std::string> command = command_for(draft_, width, height, frames_per_second);
  std::vector<char*> arguments;
  for (const std::string& part : command) arguments.push_back(const_cast<char*>(part.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(messages_), STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // Ctrl-C reaches this process alone
  const int failed = ::posix_spawnp(&program_, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[0]);
  pipe_ = ends[1];
  if (failed == 0) return;
  program_ = -1;
  ::close(pipe_);
  std::fclose(messages_);
  if (failed == ENOENT)
    throw Error(ExitCode::usage,
                "cannot make a film (the program ffmpeg was not found); install the package ffmpeg, or record the film "
                "in the browser: gem view");
  throw Error(ExitCode::resource_limit,
              "cannot start ffmpeg (" + std::generic_category().message(failed) + "); close other programs");
}

void Encoder::add(const Canvas& picture) {
  const NoPipeSignal quiet;
  const std::uint8_t* next = picture.pixels().data();
  for (std::size_t left = picture.pixels().size(); left > 0;) {
    const ssize_t written = ::write(pipe_, next, left);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) refuse();
    next += written;
    left -= static_cast<std::size_t>(written);
  }
}

int Encoder::end_program() {
  if (pipe_ >= 0) ::close(pipe_);
  pipe_ = -1;
  int status = 0;
  while (::waitpid(program_, &status, 0) < 0 && errno == EINTR) {
  }
  program_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

void Encoder::refuse() {
  if (program_ > 0) end_program();
  std::array<char, 300> text{};
  std::rewind(messages_);
  const std::size_t read = std::fread(text.data(), 1, text.size(), messages_);
  std::string why = plain_text(std::string(text.data(), read));
  for (char& c : why)
    if (c == '\n') c = ' ';
  throw Error(ExitCode::file_system, "cannot write " + shown(output_) +
                                         " (ffmpeg: " + (why.empty() ? "it gave no reason" : why) +
                                         "); make room, or try the other ending (.mp4 or .webm)");
}

void Encoder::finish() {
  if (end_program() != 0) refuse();
  std::error_code fault;
  std::filesystem::rename(draft_, output_, fault);
  if (fault)
    throw Error(ExitCode::file_system,
                "cannot write " + shown(output_) + " (" + fault.message() + "); choose another place");
}

Encoder::~Encoder() {
  if (program_ > 0) {
    ::kill(program_, SIGKILL);
    end_program();
  }
  if (messages_ != nullptr) std::fclose(messages_);
  std::error_code ignored;
  std::filesystem::remove(draft_, ignored);
}

}  // namespace gem::film
