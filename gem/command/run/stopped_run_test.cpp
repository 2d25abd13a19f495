// Runs that are stopped, interrupted or killed, and go on.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <string>

#include "gem/command/command_fixture.h"
#include "gem/record/run_file/run_file.h"

namespace gem {
namespace {

TEST_F(CommandTest, ARunGoesOnWhereItStopped) {
  ASSERT_EQ(shell("gem run swing.toml --out whole.h5 -q && gem run swing.toml --until 7 --out parts.h5"), 0);
  EXPECT_NE(text_of("err").find("it can go on: gem run --continue parts.h5"), std::string::npos) << text_of("err");
  EXPECT_NE(text_of("err").find("100 %"), std::string::npos) << "of the way to --until\n" << text_of("err");
  EXPECT_EQ(RunFile(path("parts.h5")).status(), "stopped:until");
  EXPECT_EQ(RunFile(path("parts.h5")).column("platform/time").back(), 7.0);
  ASSERT_EQ(shell("gem run --continue parts.h5 --until 0.2min -q && gem run --continue parts.h5"), 0) << text_of("err");
  EXPECT_NE(text_of("err").find("goes on from 12 s to 20 s"), std::string::npos) << text_of("err");
  const RunFile whole(path("whole.h5")), parts(path("parts.h5"));
  EXPECT_EQ(parts.status(), "complete");
  EXPECT_EQ(parts.attribute("gem_state_hash"), whole.attribute("gem_state_hash"));
  EXPECT_EQ(parts.attribute("gem_case_sha256"), whole.attribute("gem_case_sha256"));
  EXPECT_EQ(parts.column("platform/x"), whole.column("platform/x"));
  EXPECT_FALSE(exists("parts.h5.checkpoint-a") || exists("parts.h5.checkpoint-b"));
  ASSERT_EQ(shell("gem info parts.h5"), 0);
  EXPECT_EQ(text_of("out").find("\\x0a"), std::string::npos) << text_of("out");
  EXPECT_NE(text_of("out").find("\n                      20"), std::string::npos) << "lines of the history\n"
                                                                                  << text_of("out");
  EXPECT_EQ(shell("gem run --continue parts.h5"), 0);
  EXPECT_NE(text_of("err").find("nothing to continue"), std::string::npos) << text_of("err");
}

TEST_F(CommandTest, AnEndBeyondThatOfTheCaseIsSaid) {
  ASSERT_EQ(shell("gem run swing.toml --until 21 --out long.h5"), 0);
  EXPECT_NE(text_of("err").find("--until 21 is beyond the end of the case (20 s)"), std::string::npos)
      << text_of("err");
  EXPECT_EQ(RunFile(path("long.h5")).column("platform/time").back(), 21.0);
}

TEST_F(CommandTest, WhatCannotGoOnSaysWhy) {
  ASSERT_EQ(shell("gem run swing.toml --until 7 --out parts.h5 -q"), 0);
  ASSERT_EQ(shell("gem run swing.toml --until 7 --out bare.h5 -q --checkpoint-every 0"), 0);
  const struct {
    const char* line;
    int code;
    const char* message;
  } rows[] = {
      {"gem run swing.toml --out parts.h5", 4, "go on with gem run --continue parts.h5"},
      {"gem run swing.toml --out bare.h5", 4, "the file exists"},
      {"gem run --continue missing.h5", 4, "no such file"},
      {"gem run --continue swing.toml", 4, "not an HDF5 file"},
      {"gem run --continue bare.h5", 4, "there is no checkpoint beside it"},
      {"gem run --continue parts.h5 --until 5", 2, "allowed above 7, the time of the checkpoint, up to 20"},
      {"gem run --continue parts.h5 --until 21", 2, "is not a time to go on to"},
      {"gem run --continue parts.h5 --until soon", 2, "--until soon is not a time"},
      {"gem run swing.toml --continue parts.h5", 2, "--continue"},
      {"gem run --continue parts.h5 --set run.seed=2", 2, "--set"},
      {"gem run --continue parts.h5 --out other.h5", 2, "--out"},
      {"gem run --continue parts.h5 --checkpoint-every -1", 2, "--checkpoint-every"},
      {"gem run --continue parts.h5 --flush-every -1", 2, "--flush-every"},
  };
  for (const auto& row : rows) {
    EXPECT_EQ(shell(row.line), row.code) << row.line << "\n" << text_of("err");
    EXPECT_NE(text_of("err").find(row.message), std::string::npos) << row.line << "\n" << text_of("err");
  }
  EXPECT_EQ(shell("gem run --continue parts.h5 -q"), 0) << text_of("err");
}

// Before anything is said or shown in a browser. The file is read before: a complete one that somebody reads is no
// error.
TEST_F(CommandTest, ARunThatIsWrittenIsLeftAlone) {
  ASSERT_EQ(shell("gem run swing.toml --until 7 --out parts.h5 -q"), 0) << text_of("err");
  const int writer = open(path("parts.h5").c_str(), O_RDWR | O_CLOEXEC);
  for (const int held :
       {LOCK_SH, LOCK_EX}) {  // by a run that writes the file; by one that goes on, until its first flush
    ASSERT_EQ(flock(writer, held | LOCK_NB), 0);
    EXPECT_EQ(shell("gem run --continue parts.h5"), 4);
    EXPECT_EQ(text_of("err").find("goes on"), std::string::npos) << text_of("err");
    EXPECT_NE(text_of("err").find("wait for its end"), std::string::npos) << text_of("err");
  }
  close(writer);
  EXPECT_EQ(shell("gem run --continue parts.h5"), 0) << text_of("err");
}

TEST_F(CommandTest, AnInterruptedRunGoesOn) {
  ASSERT_TRUE(WIFEXITED(signalled(SIGTERM, 700)));
  const double before = RunFile(path("swing.h5"), true).column("platform/time").back();
  EXPECT_EQ(shell("gem run --continue swing.h5 -q --until " + std::to_string(before + 1.0)), 0) << text_of("err");
  EXPECT_EQ(RunFile(path("swing.h5")).status(), "stopped:until");
  EXPECT_GT(RunFile(path("swing.h5")).column("platform/time").back(), before);
}

TEST_F(CommandTest, FirstInterruptEndsInOrder) {
  const int status = signalled(SIGINT, 700);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(RunFile(path("swing.h5"), true).status(), "stopped:SIGINT");
}

TEST_F(CommandTest, TerminateEndsInOrder) {
  const int status = signalled(SIGTERM, 700);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 143);
  EXPECT_EQ(RunFile(path("swing.h5"), true).status(), "stopped:SIGTERM");
}

TEST_F(CommandTest, HangUpEndsInOrder) {
  const int status = signalled(SIGHUP, 700);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 129);
  EXPECT_EQ(RunFile(path("swing.h5"), true).status(), "stopped:SIGHUP");
}

// How far a run gets before the kill depends on the machine's load, so each try gives the run more time. A run that is
// killed in its first second leaves no file.
TEST_F(CommandTest, AKilledRunIsReadableToTheLastFlush) {
  for (int attempt = 1; attempt <= 6 && !exists("swing.h5"); ++attempt)
    ASSERT_TRUE(WIFSIGNALED(signalled(SIGKILL, 2500 * attempt)));
  // a copy without a checkpoint, and the file with one, which a slow disk may have kept from being written
  ASSERT_EQ(shell("cp swing.h5 copy.h5 && touch swing.h5.checkpoint-a && gem info swing.h5"), 0) << text_of("err");
  const std::string known = "the run has not ended in order, and no program has this file open; ";
  EXPECT_NE(text_of("out").find(known + "go on with gem run --continue swing.h5\n"), std::string::npos)
      << text_of("out");
  ASSERT_EQ(shell("gem info copy.h5"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find(known + "without a checkpoint beside it, run the case again"), std::string::npos)
      << text_of("out");
  const RunFile file(path("swing.h5"), true);
  EXPECT_EQ(file.status(), "running");
  EXPECT_GE(file.column("floes/time").size(), 16u);
  EXPECT_GE(file.column("platform/x").size(), 1024u);
  EXPECT_EQ(shell("gem info swing.h5"), 0);
  EXPECT_NE(text_of("out").find("not judged"), std::string::npos) << text_of("out");
  // an incomplete run has no state hash, so the message names none
  const double late = file.column("platform/time").back() - 50.0;
  EXPECT_EQ(shell("gem analyse --allow-incomplete swing.h5 swing.h5 --from " + std::to_string(late)), 2);
  EXPECT_NE(text_of("err").find("the same run as swing.h5 (several runs"), std::string::npos) << text_of("err");
}

// Without the option a run has no file in its first second. A loaded machine may need more than one try.
TEST_F(CommandTest, ARunShowsItsRowsAsOftenAsAsked) {
  const std::string killed_early =
      "timeout -s KILL 0.9 '" GEM_PROGRAM "' run swing.toml --until 1e8 --force --threads 1 -q --out early.h5";
  EXPECT_NE(shell(killed_early), 0);
  EXPECT_FALSE(exists("early.h5"));
  for (int attempt = 0; attempt < 5 && !exists("early.h5"); ++attempt) shell(killed_early + " --flush-every 0");
  EXPECT_TRUE(exists("early.h5"));
}

}  // namespace
}  // namespace gem
