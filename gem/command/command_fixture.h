// The program as its users start it, for tests.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

#include "gem/base/scratch_folder.h"

namespace gem {

/// A folder with a small case, and the program in it.
class CommandTest : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "swing.toml")
        << "[run]\nname = \"swing\"\nduration_s = 20.0\n[floes]\nsource = \"listed\"\n"
           "[boundary]\npresent = false\n[platform]\nstart_offset_m = [1.0, 0.0]\n";
  }

  /// Runs a shell line in the test's folder; `gem` is replaced by the program. Output goes to the files out and err.
  int shell(const std::string& line) {
    const std::string all = "cd '" + folder_.string() + "' && gem() { '" GEM_PROGRAM "' \"$@\"; } && { " + line +
                            " ; } >'" + folder_.string() + "/out' 2>'" + folder_.string() + "/err'";
    const int status = std::system(("bash -c \"" + escaped(all) + "\"").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  static std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
      if (c == '"' || c == '$' || c == '\\' || c == '`') out += '\\';
      out += c;
    }
    return out;
  }
  std::string text_of(const std::string& name) const {
    std::ifstream file(folder_ / name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Starts a run that would take hours and sends it a signal after wait_ms. Returns the wait status.
  int signalled(int signal_number, int wait_ms) {
    const pid_t child = fork();
    if (child == 0) {
      std::signal(signal_number, SIG_DFL);  // under nohup a run would ignore a hang-up, and never end
      if (chdir(folder_.c_str()) != 0) _exit(99);
      execl(GEM_PROGRAM, "gem", "run", "swing.toml", "--until", "1e8", "--quiet", "--force", "--threads", "1", "--set",
            "output.floes_interval_s=1.0", "--set", "mooring.stiffness_N_per_m=0", "--set",
            "platform.start_velocity_m_per_s=[0.01, 0]", nullptr);
      _exit(99);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    kill(child, signal_number);
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  }

  ScratchFolder scratch_{"gem command \xc3\xbc"};
  const std::filesystem::path& folder_ = scratch_.path();
};

}  // namespace gem
