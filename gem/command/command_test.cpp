// The program as its users start it: exit codes, messages, closed outputs.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "gem/command/command_fixture.h"
#include "gem/record/run_file/run_file.h"

namespace gem {
namespace {

TEST_F(CommandTest, AMessageThatQuotesAFileDoesNotSteerTheTerminal) {
  std::ofstream(path("f.csv")) << "floe,x,y\n1,\x1b[2J,0\n";
  EXPECT_EQ(shell("gem case check swing.toml --set floes.source=file --set 'floes.path=\"f.csv\"'"), 3);
  EXPECT_NE(text_of("err").find("\\x1b[2J"), std::string::npos) << text_of("err");
  EXPECT_EQ(text_of("err").find('\x1b'), std::string::npos);
}

TEST_F(CommandTest, RunWritesAFileAndASummary) {
  ASSERT_EQ(shell("gem run swing.toml"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("state hash"), std::string::npos);
  EXPECT_NE(text_of("err").find("100 %"), std::string::npos);
  EXPECT_EQ(RunFile(path("swing.h5")).status(), "complete");
  ASSERT_EQ(shell("gem info swing.h5 --json"), 0);
  EXPECT_NE(text_of("out").find("\"platform_samples\": 201"), std::string::npos) << text_of("out");
}

// The full jam before the platform, and what makes nonsense of it.
const std::string jam = "gem run " GEM_SOURCE_DIR
                        "/cases/table1.toml --index 27 --threads 1 --set floes.count=400 "
                        "--set floes.length_m=300.0 --set floes.width_m=200.0 --set floes.start_x_m=-351.0 ";

TEST_F(CommandTest, NonsenseIsBad) {
  const struct {
    const char* change;
    const char* reason;
  } rows[] = {
      {"--until 60 --set contact.solver=coupled --set numerics.iteration=gradient --set numerics.iterations_maximum=1",
       "residual"},
      {"--until 60 --set contact.solver=independent --set "
       "'ice.class=[{name=\"thin\",thickness_m=0.01,tenths=4.0},{name=\"thick\",thickness_m=10.0,tenths=4.0}]'",
       "floe_speed"},
  };
  for (const auto& row : rows) {
    ASSERT_EQ(shell(jam + "--overwrite --out bad.h5 " + row.change), 0) << text_of("err");
    EXPECT_NE(text_of("out").find("stopped:until"), std::string::npos);
    EXPECT_NE(text_of("err").find("warning: the run 400_200_100 is bad ("), std::string::npos) << text_of("err");
    EXPECT_NE(text_of("out").find("verdict               bad\n"), std::string::npos) << text_of("out");
    EXPECT_NE(text_of("out").find(std::string("bad         ") + row.reason), std::string::npos) << text_of("out");
    EXPECT_EQ(shell(jam + "--overwrite --out bad.h5 --strict --json -q " + row.change), 6) << text_of("err");
    EXPECT_EQ(nlohmann::json::parse(text_of("out")).at("verdict"), "bad");
    EXPECT_NE(text_of("err").find("is bad ("), std::string::npos) << text_of("err");
    EXPECT_NE(text_of("err").find(row.reason), std::string::npos) << text_of("err");
    EXPECT_EQ(RunFile(path("bad.h5")).status(), "stopped:until");
    ASSERT_EQ(shell("gem info bad.h5 --json"), 0);
    const auto info = nlohmann::json::parse(text_of("out"));
    EXPECT_EQ(info.at("verdict"), "bad");
    bool found = false;
    for (const auto& one : info.at("verdict_criteria"))
      if (one.at("criterion") == row.reason)
        found = one.at("grade") == "bad" && one.at("value").get<double>() > one.at("bad_above").get<double>();
    EXPECT_TRUE(found) << text_of("out");
    ASSERT_EQ(shell("gem info bad.h5"), 0);
    EXPECT_NE(text_of("out").find(std::string("bad         ") + row.reason), std::string::npos) << text_of("out");
  }
}

TEST_F(CommandTest, AHealthyRunIsNotBad) {
  EXPECT_EQ(
      shell("gem run " GEM_SOURCE_DIR "/cases/004_400_25.toml --until 60 --threads 1 --strict --json --out run.h5"), 0)
      << text_of("err");
  const auto summary = nlohmann::json::parse(text_of("out"));
  EXPECT_GT(summary.at("contacts"), 100);
  EXPECT_EQ(summary.at("verdict"), "good");
  for (const auto& one : summary.at("verdict_criteria"))
    EXPECT_TRUE(one.at("grade") != "doubtful" && one.at("grade") != "bad") << one;
  EXPECT_EQ(shell("gem run swing.toml --strict"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("verdict               good\n"), std::string::npos) << text_of("out");
}

TEST_F(CommandTest, ThePathMayHoldAnyCharacter) {
  ASSERT_EQ(shell("mkdir -p 'a b' && gem run swing.toml -q --out $'a b/\xe6\xb5\xb7\\nice.h5'"), 0) << text_of("err");
  EXPECT_TRUE(exists("a b/\xe6\xb5\xb7\nice.h5"));
}

TEST_F(CommandTest, FaultsHaveTheirExitCodeOneLineAndNoFile) {
  const struct {
    const char* line;
    int code;
    const char* message;
  } rows[] = {
      {"gem", 2, "Subcommands"},
      {"gem fly", 2, "fly"},
      {"gem run swing.toml --fast", 2, "--fast"},
      {"gem run swing.toml --engine gpu", 2, "--engine"},
      {"gem run swing.toml --threads two", 2, "--threads two"},
      {"gem run swing.toml --threads 0", 2, "--threads 0"},
      {"gem run swing.toml --threads -2", 2, "--threads -2"},
      {"gem run swing.toml --threads -99999999999999999999", 2,
       "--threads -99999999999999999999 is not a number of threads"},
      {"gem run swing.toml --threads 2 --engine reference", 2, "--threads 2 has no effect on the engine reference"},
      {"gem run swing.toml --until 10 --set run.duration_s=20", 2, "--until 10 and --set run.duration_s=20"},
      {"gem run swing.toml --index 1", 2, "single case"},
      {"gem run", 2, "no case (gem run computes the case of a file); name one, e.g. gem run cases/first.toml"},
      {"gem run -q --out run.h5", 2, "no case"},
      {"gem run --index 1", 2, "--index"},
      {"gem run swing.toml --set run.duration=1", 3, "run.duration"},
      {"gem run swing.toml --until 10mins", 2, "--until 10mins is not a time"},
      {"gem run swing.toml --until nan", 2, "--until nan is not a time"},
      {"gem run swing.toml --until -1", 2, "--until -1 is not a time"},
      {"gem run swing.toml --until 1e12", 3, "duration_s"},
      {"gem run missing.toml", 4, "missing.toml"},
      {"gem run swing.toml --out missing/run.h5", 4, "No such file"},
      {"gem run swing.toml --out .", 4, "directory"},
      {"gem run swing.toml --out /proc/run.h5", 4, "folder /proc: it takes no files"},
      {"gem run --until 1e8", 7, "--force"},
      {"gem info swing.toml", 4, "not an HDF5 file"},
      {"gem report missing.h5", 4, "missing.h5"},
      {"gem case check missing.toml", 4, "missing.toml"},
      {"gem sweep list swing.toml", 3, "sweep"},
      {": > empty.toml; gem run empty.toml", 3, "empty.toml: no settings (the file is empty)"},
      {"ln -sf b.toml a.toml; ln -sf a.toml b.toml; gem case check a.toml", 4, "Too many levels of symbolic links"},
      {"ln -sf b.toml a.toml; ln -sf a.toml b.toml; gem sweep status a.toml", 2, "is not a folder"},
      {"gem run swing.toml --out ''", 2, "--out: it is empty"},
      {"gem report swing.toml --out ''", 2, "--out: it is empty"},
      {"gem sweep run swing.toml --out ''", 2, "--out: it is empty"},
      {"ln -sf nowhere.h5 link.h5; gem run swing.toml --out link.h5", 4, "a link to a file that does not exist"},
      {"gem run swing.toml --set 'include=[\"a.toml\"]'", 3, "only a file can include others"},
      {"gem case check swing.toml --set floe='[{outline_m=[[0,0],[1,0],[1,1]],angle_rad=45}]'", 3,
       "angle_rad: out of range"},
  };
  for (const auto& row : rows) {
    EXPECT_EQ(shell(row.line), row.code) << row.line << "\n" << text_of("err");
    EXPECT_NE(text_of("err").find(row.message), std::string::npos) << row.line << "\n" << text_of("err");
    EXPECT_FALSE(exists("swing.h5") || exists("run.h5")) << row.line;
  }
}

TEST_F(CommandTest, AnExistingFileIsKeptUnlessOverwritten) {
  std::ofstream(folder_ / "swing.h5") << "precious";
  EXPECT_EQ(shell("gem run swing.toml"), 4);
  EXPECT_NE(text_of("err").find("--overwrite"), std::string::npos);
  EXPECT_EQ(text_of("swing.h5"), "precious");
  EXPECT_EQ(shell("gem run swing.toml --overwrite"), 4) << "not a file of gem's";
  EXPECT_EQ(shell("gem run swing.toml --overwrite --out swing.toml"), 4);
  EXPECT_EQ(text_of("swing.h5"), "precious");
  EXPECT_EQ(shell("rm swing.h5 && gem run swing.toml --until 1 && gem run swing.toml --overwrite"), 0)
      << text_of("err");
  EXPECT_EQ(RunFile(path("swing.h5")).status(), "complete");
}

TEST_F(CommandTest, DryRunComputesNothing) {
  EXPECT_EQ(shell("gem run swing.toml --dry-run --json"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("\"memory_bytes\""), std::string::npos);
  EXPECT_FALSE(exists("swing.h5"));
  EXPECT_EQ(text_of("out").find("\"auto\""), std::string::npos) << text_of("out");
  EXPECT_EQ(shell("gem run swing.toml --dry-run --engine reference"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("reference, 1 thread\n"), std::string::npos) << text_of("out");
}

// The two checkpoints of a run, and the draft of the next one.
TEST_F(CommandTest, TheDiskThatARunNeedsHoldsItsCheckpoints) {
  const auto need = [&](const std::string& more) {
    EXPECT_EQ(shell("gem run --dry-run --json " + more), 0) << text_of("err");
    return nlohmann::json::parse(text_of("out")).at("disk_bytes").get<double>();
  };
  ASSERT_EQ(shell("gem run --until 1 --out run.h5 -q --threads 1"), 0) << text_of("err");
  const auto size = std::filesystem::file_size(path("run.h5.checkpoint-a"));
  EXPECT_GT(size, 10000u);
  EXPECT_GE(need("") - need("--checkpoint-every 0"), 3.0 * double(size));
}

TEST_F(CommandTest, ABaselinesSettingsAreRefusedByOtherEngines) {
  if (shell("gem run --help | grep -q velocity-iterations") != 0) GTEST_SKIP() << "built without a baseline";
  for (const char* engine : {"cpu", "auto", "reference"}) {
    EXPECT_EQ(shell(std::string("gem run swing.toml --velocity-iterations 3 --engine ") + engine), 2);
    EXPECT_NE(text_of("err").find("--velocity-iterations has no effect on the engine"), std::string::npos);
  }
  EXPECT_EQ(shell("gem run swing.toml -q --velocity-iterations 3 --engine box2d --set contact.solver=coupled"), 0)
      << text_of("err");
}

TEST_F(CommandTest, FullDiskIsExitCodeFour) {
  EXPECT_EQ(shell("ulimit -f 1500; gem run swing.toml --until 200000 --force -q --threads 1"), 4);
  EXPECT_NE(text_of("err").find("swing.h5"), std::string::npos);
  EXPECT_NE(text_of("err").find("saved"), std::string::npos) << text_of("err");
}

TEST_F(CommandTest, ClosedOutputsDoNotStopARun) {
  EXPECT_EQ(shell("gem run swing.toml >&- 2>&-"), 0);
  EXPECT_EQ(RunFile(path("swing.h5")).status(), "complete");
  EXPECT_EQ(shell("set -o pipefail; gem run swing.toml --overwrite | true"), 0) << text_of("err");
}

TEST_F(CommandTest, AClosedOutputIsExitCodeFourWhereTheTextIsAll) {
  ASSERT_EQ(shell("gem run swing.toml -q"), 0);
  for (const char* words : {"info swing.h5", "analyse swing.h5", "case explain", "--version"}) {
    EXPECT_EQ(shell(std::string("gem ") + words + " >&-"), 4) << words;
    EXPECT_NE(text_of("err").find("cannot write to standard output (it is closed)"), std::string::npos)
        << words << "\n"
        << text_of("err");
    EXPECT_EQ(shell(std::string("set -o pipefail; gem ") + words + " | true"), 0) << words << ": it has read enough";
  }
}

TEST_F(CommandTest, WithoutACaseItSaysWhatAndHowLong) {
  EXPECT_EQ(shell("gem run --dry-run"), 0);
  EXPECT_NE(text_of("err").find("120 min of drift; gem run FILE runs another"), std::string::npos) << text_of("err");
}

TEST_F(CommandTest, ARunWithoutIceOnThePlatformIsWarnedOf) {
  const std::string floe = " --set 'floe=[{outline_m=[[0,0],[5,0],[5,5],[0,5]],position_m=[";
  ASSERT_EQ(shell("gem run swing.toml --out far.h5" + floe + "250,0]}]'"), 0) << text_of("err");
  EXPECT_NE(text_of("err").find("no ice touched the platform"), std::string::npos) << text_of("err");
  ASSERT_EQ(shell("gem run swing.toml --out near.h5" + floe + "-60,0],velocity_m_per_s=[0.5,0]}]'"), 0)
      << text_of("err");
  EXPECT_GT(RunFile(path("near.h5")).shape("events/time").at(0), 0u);
  EXPECT_EQ(text_of("err").find("no ice touched the platform"), std::string::npos) << text_of("err");
}

TEST_F(CommandTest, NumbersForPeopleAreShort) {
  ASSERT_EQ(shell("gem run swing.toml --until 0.3 --set numerics.time_step_s=0.1 && gem info swing.h5"), 0);
  EXPECT_NE(text_of("out").find("0.3 s in 3 time steps"), std::string::npos) << text_of("out");
  EXPECT_EQ(text_of("out").find("0.30000000000000004"), std::string::npos) << text_of("out");
}

TEST_F(CommandTest, TextThatCannotBeWrittenIsExitCodeFour) {
  for (const char* words : {"case schema", "case explain", "--help", "run --help", "--version", "manual"}) {
    EXPECT_EQ(shell(std::string("gem ") + words + " > /dev/full"), 4) << words;
    EXPECT_NE(text_of("err").find("cannot write to standard output (No space left on device)"), std::string::npos)
        << words << "\n"
        << text_of("err");
  }
}

// A closed descriptor must not become the run file, into which messages would then be written.
TEST_F(CommandTest, AnyStandardStreamMayBeClosed) {
  for (const char* closed : {"<&-", ">&-", "2>&-", "<&- >&-", "<&- 2>&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
    EXPECT_EQ(shell(std::string("gem run swing.toml --overwrite --progress line ") + closed), 0) << closed;
    EXPECT_EQ(shell("gem analyse swing.h5"), 0) << closed << "\n" << text_of("err");
    EXPECT_EQ(RunFile(path("swing.h5")).column("platform/x").size(), 201u) << closed;
  }
}

TEST_F(CommandTest, QuietAndJsonLogs) {
  EXPECT_EQ(shell("gem run swing.toml -q"), 0);
  EXPECT_EQ(text_of("err") + text_of("out"), "");
  EXPECT_EQ(shell("gem run swing.toml --overwrite --log-format json --json"), 0);
  std::istringstream lines(text_of("err"));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_EQ(line.front(), '{') << line;
    EXPECT_EQ(line.back(), '}') << line;
  }
  EXPECT_GE(count, 7);
  EXPECT_EQ(text_of("out").front(), '{');
  EXPECT_EQ(shell("gem run swing.toml --log-format json --progress none"), 4) << "the file exists";
  const auto fault = nlohmann::json::parse(text_of("err").substr(text_of("err").rfind('{')));
  EXPECT_EQ(fault.at("level"), "error");
  EXPECT_EQ(fault.at("exit_code"), 4);
  EXPECT_NE(fault.at("message").get<std::string>().find("--overwrite"), std::string::npos) << text_of("err");
}

TEST_F(CommandTest, SillyThreadCountsAreClamped) {
  EXPECT_EQ(shell("OMP_NUM_THREADS=1000 gem run swing.toml"), 0);
  EXPECT_NE(text_of("err").find("OMP_NUM_THREADS=1000 is out of range"), std::string::npos) << text_of("err");
  EXPECT_EQ(shell("OMP_NUM_THREADS=0 gem run swing.toml --overwrite"), 0);
  EXPECT_NE(text_of("err").find("OMP_NUM_THREADS=0 is out of range"), std::string::npos) << text_of("err");
}

TEST_F(CommandTest, ACaseNamesTheIceOfItsFile) {
  const std::string one = "floe,x,y\n1,-100,0\n1,-90,0\n1,-95,10\n", other = "floe,x,y\n1,-100,0\n1,-80,0\n1,-95,10\n";
  std::ofstream(folder_ / "ice.csv") << one;
  std::ofstream(folder_ / "sweep.toml") << "[run]\nduration_s = 5.0\n[floes]\nsource = \"file\"\npath = \"ice.csv\"\n"
                                           "[boundary]\npresent = false\n[sweep]\nmode = \"product\"\nname = \"m{m}\"\n"
                                           "m = [1, 2]\nmap = { m = \"run.seed\" }\n";
  ASSERT_EQ(shell("gem sweep run sweep.toml -q --out runs"), 0) << text_of("err");
  // the same from elsewhere, and with the same floes in another text
  ASSERT_EQ(shell("sed -i 's/-100,0/-100.0, 0/' ice.csv && cd / && gem sweep run '" + path("sweep.toml") +
                  "' --dry-run --out '" + path("runs") + "'"),
            0)
      << text_of("err");
  EXPECT_NE(text_of("out").find("0 of 2 runs"), std::string::npos) << text_of("out");
  std::ofstream(folder_ / "ice.csv") << other;
  EXPECT_EQ(shell("gem sweep run sweep.toml -q --out runs"), 4);
  EXPECT_NE(text_of("err").find("holds another case"), std::string::npos) << text_of("err");
  EXPECT_NE(text_of("err").find("; sha256 = "), std::string::npos) << "says which setting differs\n" << text_of("err");
  // the stored case runs elsewhere with the same ice, or says why not
  ASSERT_EQ(shell("mkdir away && gem info runs/m1.h5 --case > away/again.toml"), 0);
  EXPECT_EQ(shell("cd away && gem run again.toml -q"), 3);
  EXPECT_NE(text_of("err").find("holds other floes than the case names"), std::string::npos) << text_of("err");
  EXPECT_EQ(shell("mv ice.csv gone && cd away && gem run again.toml -q"), 4);
  EXPECT_NE(text_of("err").find("ice.csv: cannot read the floes"), std::string::npos) << text_of("err");
  EXPECT_FALSE(exists("away/m1.h5"));
  std::ofstream(folder_ / "ice.csv") << one;
  ASSERT_EQ(shell("cd away && gem run again.toml -q"), 0) << text_of("err");
  for (const char* name : {"gem_state_hash", "gem_case_sha256"})
    EXPECT_EQ(RunFile(path("away/m1.h5")).attribute(name), RunFile(path("runs/m1.h5")).attribute(name)) << name;
}

TEST_F(CommandTest, TheAdviceOnADamagedManifestLosesNoRun) {
  std::ofstream(folder_ / "sweep.toml") << text_of("swing.toml")
                                        << "[sweep]\nmode = \"list\"\n[[sweep.run]]\nname = \"a\"\n";
  ASSERT_EQ(shell("gem sweep run sweep.toml -q --out runs --threads 1"), 0) << text_of("err");
  ASSERT_EQ(shell("cp runs/a.h5 before.h5 && echo '{' > runs/manifest.json && gem sweep status runs"), 4);
  EXPECT_NE(text_of("err").find("rename it; then `gem sweep status SWEEPFILE --out runs`"), std::string::npos)
      << text_of("err");
  ASSERT_EQ(shell("mv runs/manifest.json runs/damaged && gem sweep status sweep.toml --out runs"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("1 runs: 1 done"), std::string::npos) << text_of("out");
  ASSERT_EQ(shell("gem sweep run sweep.toml -q --out runs && cmp before.h5 runs/a.h5 && gem sweep status runs"), 0)
      << text_of("err");
  EXPECT_NE(text_of("out").find("1 runs: 1 done"), std::string::npos) << text_of("out");
}

TEST_F(CommandTest, ASweepOnAMissingGpuIsRefusedAsARunIs) {
  std::ofstream(folder_ / "sweep.toml")
      << "[run]\nduration_s = 5.0\n[sweep]\nmode = \"list\"\n[[sweep.run]]\nname = \"a\"\n";
  if (shell("gem run swing.toml --dry-run --engine cuda") == 0) GTEST_SKIP() << "there is a GPU";
  for (const char* line : {"gem sweep run sweep.toml --dry-run --engine cuda --out runs",
                           "gem sweep run sweep.toml --engine cuda --out runs"}) {
    EXPECT_EQ(shell(line), 5) << line;
    EXPECT_NE(text_of("err").find("no GPU"), std::string::npos) << text_of("err");
    EXPECT_FALSE(exists("runs/a.h5"));
  }
}

TEST_F(CommandTest, FloesThatAreGivenAreNotCounted) {
  ASSERT_EQ(shell("gem case check swing.toml --set floes.count=100"), 0);
  EXPECT_NE(text_of("out").find("floes.count: has no effect (value 100"), std::string::npos) << text_of("out");
}

TEST_F(CommandTest, TheCheckSaysThePlatformsDragAndTheFixedBodies) {
  ASSERT_EQ(shell("gem case check swing.toml"), 0) << text_of("err");
  EXPECT_EQ(text_of("out").find("platform drag"), std::string::npos) << text_of("out");
  EXPECT_EQ(text_of("out").find("fixed bodies"), std::string::npos) << text_of("out");
  const std::string drag = "gem case check swing.toml --set platform_drag.present=true";
  ASSERT_EQ(shell(drag + " --set platform_drag.draft_m=8"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("platform drag     round, coefficient 0.8, draft 8 m, relative to still water\n"),
            std::string::npos)
      << text_of("out");
  ASSERT_EQ(shell(drag + " --set platform_drag.law=by_axis --set platform_drag.water=current" +
                  " --set 'fixed=[{outline_m=[[200,0],[210,0],[200,10]]},{outline_m=[[200,50],[210,50],[200,60]]}]'"),
            0)
      << text_of("err");
  EXPECT_NE(text_of("out").find("platform drag     by axis, coefficients 0.1 (surge), 0.7 (sway), 0.7 (yaw), "
                                "draft 12.42 m, relative to the current\n"),
            std::string::npos)
      << text_of("out");
  EXPECT_NE(text_of("out").find("fixed bodies      2\n"), std::string::npos) << text_of("out");
}

TEST_F(CommandTest, ACaseMayComeThroughAPipe) {
  for (const char* line : {"gem case check <(cat swing.toml)", "cat swing.toml | gem case check /dev/stdin",
                           "cat swing.toml | gem run /dev/stdin -q"})
    EXPECT_EQ(shell(line), 0) << line << "\n" << text_of("err");
  EXPECT_TRUE(exists("swing.h5"));
}

TEST_F(CommandTest, CaseAndSweepCommands) {
  EXPECT_EQ(shell("gem case check swing.toml --json"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("\"floes\": 0"), std::string::npos);
  EXPECT_EQ(shell("gem case resolve swing.toml > again.toml && gem case resolve again.toml | diff - again.toml"), 0);
  EXPECT_EQ(shell("gem case explain mooring.stiffness_N_per_m --json && gem case schema && gem devices --json"), 0);
  EXPECT_EQ(shell("gem sweep list '" GEM_SOURCE_DIR "/cases/table1.toml' --json"), 0);
  EXPECT_NE(text_of("out").find("004_400_25"), std::string::npos);
  EXPECT_EQ(shell("gem run '" GEM_SOURCE_DIR "/cases/table1.toml' --dry-run"), 2);
  EXPECT_NE(text_of("err").find("--index"), std::string::npos);
  EXPECT_EQ(shell("gem run swing.toml --index -1"), 2);
}

TEST_F(CommandTest, ARunFileIsAFieldForAnotherRun) {
  // The end of a long floe turns into the side of another floe. The distance at which contacts are searched must follow
  // the spin.
  std::ofstream(folder_ / "one.toml") << "[run]\nname = \"one\"\nduration_s = 5.0\n[floes]\nsource = \"listed\"\n"
                                         "[boundary]\npresent = false\n[platform]\npresent = false\n"
                                         "[current]\nvelocity_m_per_s = [0, 0]\n[numerics]\ntime_step_s = 0.05\n"
                                         "[output]\nfloes_interval_s = 0.05\n"
                                         "[[floe]]\noutline_m = [[-1, -6], [1, -6], [1, 6], [-1, 6]]\n"
                                         "position_m = [-30, 3]\nspin_rad_per_s = 0.5\n"
                                         "[[floe]]\noutline_m = [[-5, -5], [5, -5], [5, 5], [-5, 5]]\n"
                                         "position_m = [-22, 3]\n";
  ASSERT_EQ(shell("gem run one.toml -q"), 0) << text_of("err");
  EXPECT_EQ(shell("gem analyse one.h5"), 2);
  EXPECT_NE(text_of("err").find("no samples of a platform"), std::string::npos) << text_of("err");
  const std::string as_file = " --set 'floes.source=\"file\"' --set 'floe=[]' --set 'floes.path=";
  ASSERT_EQ(shell("gem run one.toml -q --out two.h5" + as_file + "\"one.h5\"'"), 0) << text_of("err");
  EXPECT_EQ(RunFile(path("two.h5")).column("floes/x"), RunFile(path("one.h5")).column("floes/x"));
  EXPECT_EQ(RunFile(path("two.h5")).attribute("gem_state_hash"), RunFile(path("one.h5")).attribute("gem_state_hash"));
  const std::vector<double> contacts = RunFile(path("one.h5")).column("stats/contacts");
  EXPECT_GT(*std::max_element(contacts.begin(), contacts.end()), 0.0) << "the floes never met";
  EXPECT_EQ(shell("gem case check one.toml --json" + as_file + "\"one.h5\"'"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("\"floes\": 2"), std::string::npos) << text_of("out");
  const std::string too_long = "\"one.h5\"' --set numerics.time_step_s=0.2 --set output.floes_interval_s=0.2";
  for (const std::string line : {"gem run one.toml -q --out no.h5", "gem case check one.toml"}) {
    EXPECT_EQ(shell(line + as_file + too_long), 3) << line;
    EXPECT_NE(text_of("err").find("numerics.time_step_s: the time step is too long"), std::string::npos)
        << text_of("err");
  }
  ASSERT_EQ(shell("gem run swing.toml -q"), 0) << text_of("err");
  EXPECT_EQ(shell("gem run one.toml -q --out no.h5" + as_file + "\"swing.h5\"'"), 3);
  EXPECT_NE(text_of("err").find("no floes"), std::string::npos) << text_of("err");
}

}  // namespace
}  // namespace gem
