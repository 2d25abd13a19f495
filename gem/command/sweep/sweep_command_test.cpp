// Sweeps as users start them: interrupted, killed, partly failing, several processes on one folder.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/command/index_list.h"
#include "gem/command/sweep/folder/sweep_folder.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/summary/summary_file.h"

namespace gem {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

/// Eight floes drift onto a moored platform for two seconds, at three current speeds and with two masses.
const char* const scene = R"([run]
duration_s = 2.0
[floes]
source = "listed"
[boundary]
present = false
[platform]
diameter_m = 20.0
mass_kg = 4e6
[output]
platform_interval_s = 0.02
floes_interval_s = 0.5
[numerics]
time_step_s = 0.01
[sweep]
mode = "product"
name = "{speed}_{mass}"
speed = ["slow", "middle", "fast"]
mass = [4000000, 5000000]
map = { mass = "platform.mass_kg" }
set.speed.slow.current.velocity_m_per_s = [0.4, 0.0]
set.speed.middle.current.velocity_m_per_s = [0.5, 0.0]
set.speed.fast.current.velocity_m_per_s = [0.6, 0.0]
)";

std::string sweep_text() {
  std::string text = scene;
  for (const char* x : {"-12.2", "-16.4"})
    for (const char* y : {"-9.0", "-4.5", "0.0", "4.5"})
      text += "[[floe]]\noutline_m = [[-2, -2], [2, -2], [2, 2], [-2, 2]]\nposition_m = [" + std::string(x) + ", " + y +
              "]\nvelocity_m_per_s = [0.5, 0.0]\n";
  return text;
}

class SweepCommandTest : public testing::Test {
 protected:
  void SetUp() override { std::ofstream(folder_ / "tiny.toml") << sweep_text(); }

  /// Starts gem in the test's folder; its outputs go to out_TAG and err_TAG.
  pid_t start(const Words& arguments, const std::string& tag = "") {
    const pid_t child = fork();
    if (child != 0) return child;
    if (chdir(folder_.c_str()) != 0 || freopen(("out_" + tag).c_str(), "w", stdout) == nullptr ||
        freopen(("err_" + tag).c_str(), "w", stderr) == nullptr)
      _exit(99);
    std::vector<char*> pointers = {const_cast<char*>("gem")};
    for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    execv(GEM_PROGRAM, pointers.data());
    _exit(99);
  }
  static int ended(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  int gem(const Words& arguments) { return ended(start(arguments)); }
  int sweep(const std::string& out, const Words& more = {}) { return ended(start_sweep(out, more)); }
  pid_t start_sweep(const std::string& out, const Words& more = {}, const std::string& tag = "") {
    Words words = {"sweep", "run", "tiny.toml", "--out", out, "--threads", "1", "--jobs", "2", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return start(words, tag);
  }

  std::string text_of(const std::string& name) const {
    std::ifstream file(folder_ / name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Maps each run's name to one field of its row in `gem sweep status`.
  std::map<std::string, std::string> status(const std::string& out, const std::string& field) {
    EXPECT_EQ(gem({"sweep", "status", out, "--json"}), 0) << text_of("err_");
    std::map<std::string, std::string> all;
    for (const Json& row : Json::parse(text_of("out_"))) all[row.at("name")] = row.at(field);
    return all;
  }
  std::size_t count(const std::string& out, const std::string& wanted) {
    std::size_t found = 0;
    for (const auto& [name, value] : status(out, "status")) found += value == wanted ? 1 : 0;
    return found;
  }

  /// Waits until one run is done and another is running.
  void wait_for_first(const std::string& out) {
    for (int tries = 0; tries < 600; ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      if (!fs::exists(folder_ / out / "manifest.json")) continue;
      if (count(out, "done") >= 1 && count(out, "running") >= 1) return;
    }
    FAIL() << "no run was done within half a minute";
  }

  /// Waits until a run of `endless_` has begun.
  void wait_for_start(const std::string& out) {
    for (int tries = 0; tries < 600; ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      if (fs::exists(folder_ / out / "manifest.json") && count(out, "running") >= 1) return;
    }
    FAIL() << "no run began within half a minute";
  }

  ScratchFolder scratch_{"gem sweep"};
  const fs::path& folder_ = scratch_.path();
  /// Makes each run take long enough to be interrupted.
  const Words slow_ = {"--set", "numerics.time_step_s=1.2e-5", "--set", "output.platform_interval_s=0.02"};
  /// No run comes to its end, however loaded the machine.
  const Words endless_ = {slow_[0], slow_[1], slow_[2], slow_[3], "--set", "run.duration_s=1000"};
};

TEST_F(SweepCommandTest, StrictCountsTheBadRuns) {
  EXPECT_EQ(sweep("fine", {"--strict"}), 0) << text_of("err_");
  const Json fine = Json::parse(text_of("out_"));
  EXPECT_EQ(fine.at("bad"), 0);
  EXPECT_EQ(fine.at("good").get<int>() + fine.at("doubtful").get<int>(), 6);
  const Words once = {"--set", "contact.solver=coupled",       "--set", "numerics.iteration=gradient",
                      "--set", "numerics.iterations_maximum=1"};
  EXPECT_EQ(sweep("nonsense", once), 0) << text_of("err_");
  EXPECT_EQ(Json::parse(text_of("out_")).at("bad"), 6);
  EXPECT_EQ(sweep("nonsense", {once[0], once[1], once[2], once[3], once[4], once[5], "--strict"}), 6)
      << "runs done before count too";
  EXPECT_NE(text_of("err_").find("6 of 6 runs are bad"), std::string::npos) << text_of("err_");
  for (const auto& [name, verdict] : status("nonsense", "verdict")) EXPECT_EQ(verdict, "bad") << name;
  EXPECT_EQ(gem({"sweep", "status", "nonsense"}), 0);
  EXPECT_NE(text_of("out_").find("bad"), std::string::npos) << text_of("out_");
  for (const auto& [name, doubts] : status("nonsense", "doubts")) {
    EXPECT_NE(doubts, "") << name;
    EXPECT_NE(text_of("out_").find(doubts), std::string::npos) << text_of("out_");
  }
  ASSERT_EQ(gem({"sweep", "collect", "nonsense", "--out", "s.h5"}), 0) << text_of("err_");
  const SummaryTable table = read_summary(path("s.h5"));
  ASSERT_NE(table.column("verdict"), nullptr);
  EXPECT_EQ(table.column("verdict")->texts, Words(6, "bad"));
  ASSERT_NE(table.column("verdict_residual"), nullptr);
  for (const double share : table.column("verdict_residual")->numbers) EXPECT_GT(share, 0.2);
}

TEST_F(SweepCommandTest, EveryRunHasTheBitsThatItHasAlone) {
  ASSERT_EQ(sweep("d"), 0) << text_of("err_");
  const Json object = Json::parse(text_of("out_"));
  EXPECT_EQ(object.at("done"), 6);
  EXPECT_EQ(object.at("failed"), 0);
  const auto hashes = status("d", "state_hash");
  ASSERT_EQ(hashes.size(), 6u);
  int index = 0;
  for (const char* speed : {"slow", "middle", "fast"})
    for (const char* mass : {"4000000", "5000000"}) {
      const std::string name = std::string(speed) + "_" + mass;
      const RunFile file(path("d/" + name + ".h5"));
      EXPECT_GT(file.shape("events/time").at(0), 0u) << name << ": no floe hit the platform";
      ASSERT_EQ(
          gem({"run", "tiny.toml", "--index", std::to_string(++index), "--quiet", "--out", "alone.h5", "--overwrite"}),
          0);
      EXPECT_EQ(hashes.at(name), RunFile(path("alone.h5")).attribute("gem_state_hash")) << name;
    }
  ASSERT_EQ(sweep("d"), 0);
  EXPECT_EQ(Json::parse(text_of("out_")).at("done_before"), 6);
}

TEST_F(SweepCommandTest, AKilledSweepGoesOnToTheSameHashes) {
  ASSERT_EQ(sweep("whole", slow_), 0) << text_of("err_");
  const auto hashes = status("whole", "state_hash");
  const pid_t child = start_sweep("cut", slow_, "cut");
  wait_for_first("cut");
  kill(child, SIGKILL);
  ASSERT_EQ(ended(child), -SIGKILL);
  // The workers die with the sweep, but a little later.
  for (int tries = 0; tries < 200 && count("cut", "running") > 0; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(count("cut", "running"), 0u);
  const std::size_t done = count("cut", "done");
  ASSERT_GE(done, 1u);
  ASSERT_LT(done, 6u) << "the kill came too late to cut anything";
  ASSERT_EQ(sweep("cut", slow_), 0) << text_of("err_");
  // a run that is killed in its first second leaves a draft only, which the next one takes over
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "cut"))
    EXPECT_NE(entry.path().extension(), ".new") << entry.path();
  EXPECT_EQ(Json::parse(text_of("out_")).at("done_before"), done);
  EXPECT_EQ(status("cut", "state_hash"), hashes);
}

TEST_F(SweepCommandTest, AnInterruptStopsAllRunsInOrder) {
  const pid_t child = start_sweep("d", endless_);
  wait_for_start("d");
  double furthest = 0.0;  // that the status says of a run in progress
  for (int tries = 0; tries < 200 && furthest == 0.0; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(gem({"sweep", "status", "d", "--json"}), 0);
    for (const Json& row : Json::parse(text_of("out_"))) {
      if (row.at("status") == "running") furthest = std::max(furthest, row.at("time_s").get<double>());
    }
  }
  EXPECT_GT(furthest, 0.0);
  kill(child, SIGINT);
  EXPECT_EQ(ended(child), 130);
  EXPECT_EQ(count("d", "running"), 0u);
  EXPECT_GE(count("d", "stopped"), 1u);
  EXPECT_EQ(sweep("d"), 4) << "with other settings: what there is of the former case is kept";
  for (const auto& [name, error] : status("d", "error"))
    EXPECT_TRUE(error.empty() || error == "stopped:SIGINT") << error;
}

TEST_F(SweepCommandTest, AFailingRunStopsNoOther) {
  // A platform of 40 m overlaps the floes, so the fields of those runs are refused.
  std::string text = sweep_text();
  const std::string slow = "set.speed.slow.current.velocity_m_per_s = [0.4, 0.0]\n";
  text.insert(text.find(slow), "set.speed.slow.platform.diameter_m = 40.0\n");
  std::ofstream(folder_ / "tiny.toml") << text;
  EXPECT_EQ(sweep("d"), 8) << text_of("err_");
  EXPECT_EQ(count("d", "done"), 4u);
  EXPECT_EQ(count("d", "failed"), 2u);
  EXPECT_NE(status("d", "error").at("slow_4000000").find("overlap"), std::string::npos);
  EXPECT_EQ(sweep("d", {"--index", "1"}), 3) << "a single run has its own code";
  EXPECT_EQ(sweep("d", {"--index", "3-6"}), 0);
}

/// The processes that this one has started and that still run.
std::vector<pid_t> children_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/task/" + std::to_string(process) + "/children");
  return {std::istream_iterator<pid_t>(file), {}};
}

TEST_F(SweepCommandTest, ARunWhoseProcessCrashedHasFailed) {
  const pid_t sweep = start_sweep("d", {"--index", "1-2", endless_[0], endless_[1], endless_[4], endless_[5]}, "crash");
  // With a draft of its file a run has the handler that turns a crash into an exit code.
  const auto drafts = [&] {
    return std::count_if(fs::directory_iterator(folder_ / "d"), fs::directory_iterator(),
                         [](const auto& entry) { return entry.path().string().find(".h5") != std::string::npos; });
  };
  wait_for_start("d");
  for (int tries = 0; tries < 600 && drafts() < 2; ++tries) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const std::vector<pid_t> workers = children_of(sweep);
  ASSERT_FALSE(workers.empty());
  for (const pid_t worker : workers) kill(worker, SIGSEGV);
  EXPECT_EQ(ended(sweep), 8);
  EXPECT_EQ(Json::parse(text_of("out_crash")).at("failed"), 2) << text_of("out_crash");
  EXPECT_NE(text_of("err_crash").find("its process ended before the run did"), std::string::npos)
      << text_of("err_crash");
}

TEST_F(SweepCommandTest, IndexRunsOnlyWhatIsChosen) {
  EXPECT_EQ(sweep("d", {"--index", "2"}), 0);
  EXPECT_EQ(count("d", "done"), 1u);
  EXPECT_EQ(status("d", "status").at("slow_5000000"), "done");
  EXPECT_EQ(count("d", "missing"), 5u);
  EXPECT_EQ(sweep("d", {"--index", "4-5,2"}), 0);
  EXPECT_EQ(count("d", "done"), 3u);
  EXPECT_EQ(sweep("d", {"--index", "7"}), 2);
  EXPECT_EQ(sweep("d", {"--dry-run"}), 0);
  EXPECT_EQ(Json::parse(text_of("out_")).at("to_do"), 3);
}

TEST_F(SweepCommandTest, SeveralProcessesShareOneFolder) {
  std::vector<pid_t> children;
  for (const char* tag : {"a", "b", "c"}) children.push_back(start_sweep("d", {}, tag));
  for (const pid_t child : children) EXPECT_EQ(ended(child), 0);
  std::size_t made = 0;
  for (const char* tag : {"out_a", "out_b", "out_c"}) {
    const Json object = Json::parse(text_of(tag));
    made += object.at("done").get<std::size_t>() - object.at("done_before").get<std::size_t>();
  }
  EXPECT_EQ(made, 6u) << "each run is made once";
  EXPECT_EQ(count("d", "done"), 6u);
  const Json manifest = Json::parse(text_of("d/manifest.json"));
  ASSERT_EQ(manifest.at("runs").size(), 6u);
  for (const Json& row : manifest.at("runs")) EXPECT_EQ(row.at("status"), "done");
}

TEST_F(SweepCommandTest, ASweepOfOtherCasesIsRefusedWhileOneRuns) {
  const pid_t child = start_sweep("d", endless_, "first");
  wait_for_start("d");
  EXPECT_EQ(sweep("d", {"--set", "run.duration_s=1.0", "--index", "5-6"}), 4);
  EXPECT_NE(text_of("err_").find("another sweep runs in"), std::string::npos) << text_of("err_");
  kill(child, SIGHUP);
  EXPECT_EQ(ended(child), 129);
  EXPECT_GE(count("d", "stopped"), 1u);
  EXPECT_EQ(sweep("d", {"--set", "run.duration_s=1.0", "--index", "5-6", "--overwrite"}), 0) << text_of("err_");
}

TEST_F(SweepCommandTest, WhatIsNotThisSweepsIsKept) {
  ASSERT_EQ(sweep("d", {"--index", "1"}), 0);
  const std::string former = status("d", "state_hash").at("slow_4000000");
  EXPECT_EQ(sweep("d", {"--set", "run.duration_s=1.0"}), 4);
  EXPECT_NE(text_of("err_").find("another case"), std::string::npos) << text_of("err_");
  EXPECT_EQ(status("d", "state_hash").at("slow_4000000"), former);
  EXPECT_EQ(sweep("d", {"--index", "1", "--set", "run.duration_s=1.0", "--overwrite"}), 0);
  EXPECT_NE(status("d", "state_hash").at("slow_4000000"), former);
  std::ofstream(folder_ / "d" / "fast_4000000.h5") << "half a file";
  EXPECT_EQ(sweep("d", {"--index", "5"}), 0);
  EXPECT_NE(text_of("err_").find("is run again"), std::string::npos) << text_of("err_");
  EXPECT_EQ(status("d", "status").at("fast_4000000"), "done");
  EXPECT_EQ(gem({"sweep", "status", "tiny.toml"}), 2);
  EXPECT_EQ(gem({"sweep", "status", "."}), 4);
  EXPECT_EQ(gem({"sweep", "status", "tiny.toml", "--out", "d"}), 0);
  EXPECT_NE(text_of("out_").find("1 other"), std::string::npos) << text_of("out_");
}

TEST_F(SweepCommandTest, CollectAsksForAllRuns) {
  ASSERT_EQ(sweep("d", {"--index", "1-3"}), 0);
  EXPECT_EQ(gem({"sweep", "collect", "d", "--out", "s.h5"}), 4);
  EXPECT_NE(text_of("err_").find("3 done runs of 6"), std::string::npos) << text_of("err_");
  EXPECT_EQ(gem({"sweep", "collect", "d", "--out", "s.h5", "--partial"}), 0) << text_of("err_");
  EXPECT_NE(text_of("out_").find("3 runs"), std::string::npos) << text_of("out_");
  EXPECT_EQ(gem({"sweep", "collect", "d", "--out", "s.h5", "--partial"}), 4);
}

/// Columns of the summary that begin with one of the names.
std::size_t columns_of(const std::string& path, const Words& beginnings) {
  std::size_t found = 0;
  for (const SummaryColumn& column : read_summary(path).columns)
    for (const std::string& beginning : beginnings) found += column.name.starts_with(beginning) ? 1 : 0;
  return found;
}

TEST_F(SweepCommandTest, CollectLeavesOutTheSwingOfAShipOnItsWay) {
  const Words swing = {"x_", "y_", "orbit_"};
  ASSERT_EQ(sweep("d", {"--index", "1"}), 0) << text_of("err_");
  ASSERT_EQ(gem({"sweep", "collect", "d", "--out", "d.h5", "--partial"}), 0) << text_of("err_");
  EXPECT_GT(columns_of(path("d.h5"), swing), 5U) << "a moored platform swings";
  ASSERT_EQ(sweep("t", {"--index", "1", "--set", "mooring.stiffness_N_per_m=0", "--set", "transit.bollard_thrust_N=1e5",
                        "--set", "transit.open_water_speed_m_per_s=1.0"}),
            0)
      << text_of("err_");
  ASSERT_EQ(gem({"sweep", "collect", "t", "--out", "t.h5", "--partial"}), 0) << text_of("err_");
  EXPECT_EQ(columns_of(path("t.h5"), swing), 0U);
  const SummaryTable table = read_summary(path("t.h5"));
  ASSERT_NE(table.column("resistance_mean_N"), nullptr);
  EXPECT_GT(table.column("resistance_mean_N")->numbers[0], 0.0) << "ice hits it";
  ASSERT_NE(table.column("transit_speed_mean_m_per_s"), nullptr);
  EXPECT_EQ(table.column("transit_speed_mean_m_per_s")->units, "m/s");
}

TEST_F(SweepCommandTest, CollectKeepsNoMoreThanWasRecorded) {
  ASSERT_EQ(sweep("d", {"--index", "1"}), 0);
  const auto collect = [&](const Words& more) {
    Words words = {"sweep", "collect", "d", "--out", "s.h5", "--partial", "--overwrite"};
    words.insert(words.end(), more.begin(), more.end());
    return gem(words);
  };
  EXPECT_EQ(collect({"--series", "1e-9"}), 2);
  EXPECT_NE(text_of("err_").find("0.02 s"), std::string::npos) << text_of("err_");
  EXPECT_EQ(collect({"--series", "0.02"}), 0) << text_of("err_");
  EXPECT_EQ(collect({"--series", "0"}), 0) << text_of("err_");
  EXPECT_EQ(collect({"--series", "0", "--exact"}), 2);
}

TEST(IndexList, NumbersAndRanges) {
  using Places = std::vector<std::size_t>;
  EXPECT_EQ(parse_index_list("", 3), (Places{0, 1, 2}));
  EXPECT_EQ(parse_index_list("3", 3), (Places{2}));
  EXPECT_EQ(parse_index_list("5,1-3,2", 6), (Places{0, 1, 2, 4}));
  for (const char* text : {"0", "7", "a", "1,", ",1", "3-1", "1-", "-2", "1 2", "+1"})
    EXPECT_THROW(parse_index_list(text, 6), Error) << text;
}

}  // namespace
}  // namespace gem
