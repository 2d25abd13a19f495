// Starts a process and waits for it, by POSIX calls.
#include "gem/report/figures/run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "gem/base/error.h"

namespace gem {
namespace {

/// Reads the pipe to its end, as one line.
std::string read_line_of(int pipe_end) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t got = 1; got != 0;) {
    got = ::read(pipe_end, buffer.data(), buffer.size());
    if (got < 0 && errno != EINTR) break;
    if (got > 0 && text.size() < 300) text.append(buffer.data(), static_cast<std::size_t>(got));
  }
  text = text.substr(0, 300);
  for (char& c : text)
    if (c == '\n' || c == '\t') c = ' ';
  return text;
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& command, const std::filesystem::path& folder) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error(ExitCode::resource_limit, "cannot start " + command.front() + " (no pipe left); close other programs");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& part : command) arguments.push_back(const_cast<char*>(part.c_str()));
  arguments.push_back(nullptr);

  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (failed != 0) {
    ::close(ends[0]);
    if (failed == ENOENT) return {false, 127, ""};
    throw Error(ExitCode::resource_limit, "cannot start " + command.front() + " (" +
                                              std::generic_category().message(failed) + "); close other programs");
  }
  ProgramResult result;
  result.output = read_line_of(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

}  // namespace gem
