// Starts xdg-open with a small file that leads to the address.
#include "gem/view/server/open_browser.h"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

extern char** environ;

namespace gem::view {

namespace {

bool has_desktop() { return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr; }

}  // namespace

OpenedBrowser::OpenedBrowser(const std::string& address) {
  if (!has_desktop()) return;
  std::error_code fault;
  file_ = (std::filesystem::temp_directory_path(fault) / "gem-view-XXXXXX.html").string();
  const int file = mkstemps(file_.data(), 5);
  if (file < 0) return;
  const std::string page = "<!DOCTYPE html><meta http-equiv=\"refresh\" content=\"0; url=" + address + "\">\n";
  const bool written = write(file, page.data(), page.size()) == ssize_t(page.size());
  close(file);
  if (!written) return;
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", O_RDWR, 0);
  std::string program = "xdg-open";
  char* arguments[] = {program.data(), file_.data(), nullptr};
  pid_t child = 0;
  is_open_ = posix_spawnp(&child, program.c_str(), &quiet, nullptr, arguments, environ) == 0;
  posix_spawn_file_actions_destroy(&quiet);
}

OpenedBrowser::~OpenedBrowser() {
  if (!file_.empty()) unlink(file_.c_str());
}

}  // namespace gem::view
