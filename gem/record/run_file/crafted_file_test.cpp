// Run files that somebody made to do harm. Every command that reads one must refuse it, or show it as text: no foreign
// program runs, no other file is opened, and nothing is written outside the output folder.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "gem/base/scratch_folder.h"
#include "gem/record/run_file/crafted_structures.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

constexpr const char* base_case = R"([run]
name = "base"
duration_s = 20.0
[boundary]
present = false
[floes]
source = "listed"
[output]
floes_interval_s = 5.0
[platform]
start_offset_m = [1.0, 0.0]
[[floe]]
outline_m = [[-5, -5], [5, -5], [5, 5], [-5, 5]]
position_m = [-60, 0]
[[floe]]
outline_m = [[-5, -5], [5, -5], [5, 5], [-5, 5]]
position_m = [-75, 0]
)";

/// Texts that act where they are not quoted. `touch` would leave a file behind.
const std::string hostile_texts[] = {
    "a\nsystem(\"touch touched\")\n#",
    "'",
    "''; system('touch touched'); '",
    "' . system(\"touch touched\") . '",
    "\"; system 'touch touched'; \"",
    "`touch touched`",
    "$(touch touched)",
    "| touch touched",
    "; touch touched",
    "@touch \\",
    "<script>alert(1)</script>",
    "<img src=x onerror=alert(1)>",
    "\"><a href=\"javascript:alert(1)\">x</a>",
    "]]></style></svg><script>alert(1)</script>",
    "../../../../etc/passwd",
    "/etc/passwd",
    "\x1b]0;title\x07\x1b[31mred",
    "\xc2\x9b\x33\x31mred",
    "caf\xe9 \xff\xfe",
    "\xe2\x80\xae txt.exe",
    std::string("before\0after", 12),
    std::string(1000000, 'A'),
    "%s%n%s%n",
};

class CraftedFile : public testing::Test {
 protected:
  void SetUp() override {
    scratch_.write("base.toml", base_case);
    fs::create_directory(folder());
    ASSERT_EQ(call({"run", "../base.toml", "-q", "--threads", "1", "--out", "../base.h5"}), 0) << text_of("err");
    has_strace_ = std::system("strace -f -o /dev/null true 2>/dev/null") == 0;
    stops_seldom_ = std::system("strace -f --seccomp-bpf -o /dev/null true 2>/dev/null") == 0;
  }

  fs::path folder() const { return scratch_.path() / "work"; }

  std::string text_of(const std::string& name) const {
    std::ifstream file(scratch_.path() / name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  /// Calls gem in the folder, watched by strace if it is there. Returns the exit code, 128 + signal if it was killed.
  int call(std::vector<std::string> words) const {
    words.insert(words.begin(), GEM_PROGRAM);
    const std::string log = (scratch_.path() / "calls").string();
    if (has_strace_) {
      for (const char* word :
           {log.c_str(), "-o", "-etrace=execve,openat,open,creat,unlink,rename,connect", "-qq", "-f"})
        words.insert(words.begin(), word);
      if (stops_seldom_) words.insert(words.begin(), "--seccomp-bpf");
      words.insert(words.begin(), "strace");
    }
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const char* asan = getenv("ASAN_OPTIONS");
    const std::string watched = std::string(asan != nullptr ? asan : "") + ":detect_leaks=0";
    const pid_t child = fork();
    if (child == 0) {
      // the leak check of a sanitized program cannot work under strace
      if (has_strace_) setenv("ASAN_OPTIONS", watched.c_str(), 1);
      const auto to = [&](const char* name) {
        return open((scratch_.path() / name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      };
      if (chdir(folder().c_str()) != 0 || dup2(to("out"), 1) < 0 || dup2(to("err"), 2) < 0) _exit(99);
      execvp(arguments[0], arguments.data());
      _exit(99);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  /// The calls of the last command that should not be: another program, a file written elsewhere, a file of the system.
  std::string wrong_calls() const {
    std::istringstream lines(has_strace_ ? text_of("calls") : "");
    std::string wrong;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t quote = line.find('"');
      if (quote == std::string::npos || line.find(" = -1 ") != std::string::npos) continue;
      const std::string path = line.substr(quote + 1, line.find('"', quote + 1) - quote - 1);
      const std::string program = fs::path(path).filename();
      const bool writes = line.find("O_WRONLY") != std::string::npos || line.find("O_RDWR") != std::string::npos;
      const bool inside = path.starts_with(scratch_.path().string()) || !path.starts_with("/");
      if (line.find("execve(") != std::string::npos && program != "gem" && program != "gnuplot" &&
          program != "gnuplot-nox" && program != "gnuplot-qt" && program != "gnuplot-x11" && program != "strace")
        wrong += line + "\n";
      if (writes && !inside && path != "/dev/null" && !path.starts_with("/tmp/gnuplot")) wrong += line + "\n";
      if (path.ends_with("secret.h5") || path.ends_with("secret")) wrong += line + "\n";
    }
    return wrong;
  }

  /// Every command on the file. `message`: of the refusal; empty if the report must succeed.
  void check(const std::string& file, const std::string& message, const std::string& what) {
    bool refused = false;
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"info", file},
             {"info", file, "--json"},
             {"info", file, "--case"},
             {"analyse", file, "--allow-incomplete"},
             {"report", file, "--allow-incomplete", "--out", "page"},
             {"view", file, "--allow-incomplete", "--out", "page.html"},
             {"run", "../base.toml", "-q", "--dry-run", "--set", "floe=[]", "--set", "floes.source=\"file\"", "--set",
              "floes.path=\"" + std::string("crafted.h5") + "\""}}) {
      const int code = call(words);
      EXPECT_TRUE(code == 0 || (code >= 2 && code <= 4)) << what << ": " << words[0] << ": " << code << "\n"
                                                         << text_of("err");
      EXPECT_EQ(wrong_calls(), "") << what << ": " << words[0];
      if (has_strace_ && words[0] == "report" && code == 0) {
        EXPECT_NE(text_of("calls").find("gnuplot"), std::string::npos) << "nothing was watched";
      }
      const std::string error = text_of("err");
      EXPECT_EQ(code == 0, error.empty()) << what << ": " << words[0] << "\n" << error;
      EXPECT_LT(error.size(), 4000u) << what;
      for (const std::string& text : {error, words.back() == "--json" ? std::string() : text_of("out")})
        EXPECT_EQ(text.find_first_of("\x1b\x07"), std::string::npos) << what << ": " << words[0];
      refused = refused || (!message.empty() && error.find(message) != std::string::npos);
      if (words[0] == "report" && message.empty()) {
        EXPECT_EQ(code, 0) << what << "\n" << error;
      }
    }
    EXPECT_EQ(refused, !message.empty()) << what << ": nobody said \"" << message << "\"; the last: " << text_of("err");
    EXPECT_FALSE(fs::exists(folder() / "touched") || fs::exists(folder() / "page/figures/touched")) << what;
    const std::string page = read(folder() / "page/index.html");
    for (const char* active : {"<script", "<img", "<a href=\"javascript"})
      EXPECT_EQ(page.find(active), std::string::npos) << what;
    fs::remove_all(folder() / "page");
  }

  static std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  void craft(const std::function<void(hid_t)>& change) const {
    const fs::path path = folder() / "crafted.h5";
    fs::copy_file(scratch_.path() / "base.h5", path, fs::copy_options::overwrite_existing);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    change(file);
    H5Fclose(file);
  }

  ScratchFolder scratch_{"gem_crafted"};
  bool has_strace_ = false;
  bool stops_seldom_ = false;  // strace stops only at the calls that it prints: a quarter less time
};

TEST_F(CraftedFile, TextsAreShownAndNeverAct) {
  for (const std::string& text : hostile_texts) {
    craft([&](hid_t file) {
      for (const char* name : {"title", "source", "history", "gem_build", "gem_engine", "gem_solver", "gem_seed",
                               "gem_threads", "gem_status", "gem_verdict", "gem_state_hash"})
        put_text(file, name, text, text.size() < 60000 && text.size() % 2 == 0);
    });
    check("crafted.h5", "", text.substr(0, 40));
  }
}

TEST_F(CraftedFile, StructuresAreRefusedOrRead) {
  for (const Crafted& crafted : crafted_structures()) {
    craft(crafted.change);
    check("crafted.h5", crafted.message, crafted.name);
  }
}

TEST_F(CraftedFile, TheNameOfTheFileMayHoldAnything) {
  for (const std::string name :
       {"a\nb.h5", "'.h5", "\".h5", "`touch touched`.h5", "$(touch touched).h5", "| touch touched.h5",
        "; touch touched;.h5", "<script>.h5", "javascript:alert(1).h5", "..h5", "\x1b[31m.h5", "%n%s.h5"}) {
    fs::copy_file(scratch_.path() / "base.h5", folder() / name);
    fs::copy_file(scratch_.path() / "base.h5", folder() / "crafted.h5", fs::copy_options::overwrite_existing);
    check("./" + name, "", name);
    fs::remove(folder() / name);
  }
}

}  // namespace
}  // namespace gem
