// Only the page that has the key, from this machine by its own name, gets an answer.
#include "gem/view/server/gate.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "gem/base/scratch_folder.h"
#include "gem/view/server/site.h"

namespace gem::view {
namespace {

const std::string token(32, 'a');

bool passes(const Asked& asked) { return Gate(token, 8080).refusal(asked).empty(); }

TEST(Gate, LetsThePagePass) {
  const std::string path = "/" + token + "/";
  EXPECT_TRUE(passes({"GET", path, "127.0.0.1:8080", ""}));
  EXPECT_TRUE(passes({"GET", path + "state", "localhost:8080", "http://localhost:8080"}));
  EXPECT_EQ(Gate(token, 8080).place({"GET", path + "state", "", ""}), "state");
  EXPECT_EQ(Gate(token, 8080).address(), "http://127.0.0.1:8080" + path);
}

TEST(Gate, RefusesForeignNamesOriginsAndKeys) {
  const std::string path = "/" + token + "/";
  EXPECT_FALSE(passes({"GET", path, "", ""}));
  EXPECT_FALSE(passes({"GET", path, "127.0.0.1", ""}));
  EXPECT_FALSE(passes({"GET", path, "127.0.0.1:8081", ""}));
  EXPECT_FALSE(passes({"GET", path, "evil.example:8080", ""}));
  EXPECT_FALSE(passes({"GET", path, "127.0.0.1:8080.evil.example", ""}));
  EXPECT_FALSE(passes({"POST", path, "127.0.0.1:8080", "http://evil.example"}));
  EXPECT_FALSE(passes({"POST", path, "127.0.0.1:8080", "null"}));
  EXPECT_FALSE(passes({"POST", path, "127.0.0.1:8080", "https://127.0.0.1:8080"}));
  for (const std::string& wrong : {std::string("/"), std::string(), "/" + token, "/" + std::string(32, 'b') + "/",
                                   "//" + token + "/", "/" + token.substr(1) + "//"})
    EXPECT_FALSE(passes({"GET", wrong, "127.0.0.1:8080", ""})) << wrong;
}

TEST(Gate, KeysAreLongAndNeverTheSame) {
  const std::string one = new_token(), two = new_token();
  EXPECT_EQ(one.size(), 32U);
  EXPECT_EQ(one.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(one, two);
}

TEST(Site, CommandsOfThePageReachTheRun) {
  const ScratchFolder folder("gem site");
  LiveControl control;
  control.duration_s = 20.0;
  Site site((folder.path() / "none.h5").string(), true, &control);
  EXPECT_EQ(site.answer("POST", "pause", {}).status, 204);
  EXPECT_TRUE(control.paused);
  EXPECT_NE(site.answer("GET", "state", {}).body.find("\"paused\":true"), std::string::npos);
  EXPECT_EQ(site.answer("POST", "go_on", {}).status, 204);
  EXPECT_FALSE(control.paused);
  EXPECT_EQ(site.answer("GET", "stop", {}).status, 503);
  EXPECT_FALSE(control.stop);
  EXPECT_EQ(site.answer("POST", "stop", {}).status, 204);
  EXPECT_TRUE(control.stop);
  EXPECT_EQ(site.answer("POST", "delete", {}).status, 404);
  EXPECT_EQ(site.answer("GET", "", {}).status, 200);  // the page asks until the run has a file
  EXPECT_EQ(site.answer("GET", "description", {}).status, 503);
  EXPECT_EQ(site.answer("POST", "leave", {}).status, 204);
  EXPECT_TRUE(control.gone);
  EXPECT_EQ(site.answer("GET", "state", {}).status, 200);
  EXPECT_FALSE(control.gone) << "another page still asks";
}

TEST(Site, TheStateIsSaidAtOnceWhenTheRunEnds) {
  const ScratchFolder folder("gem site");
  LiveControl control;
  Site site((folder.path() / "none.h5").string(), true, &control);
  const auto seconds = [&] {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(site.answer("GET", "wait", {}).status, 200);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  EXPECT_GE(seconds(), 0.9);
  control.running = false;
  EXPECT_LT(seconds(), 0.9);
}

TEST(Site, TheFileOfAnEarlierRunIsNotLookedAt) {
  const ScratchFolder folder("gem site");
  const std::string path = folder.write("run.h5", "of an earlier run");
  LiveControl control;
  Site site(path, true, &control);
  EXPECT_NE(site.answer("GET", "description", {}).body.find("no file yet"), std::string::npos);
  std::filesystem::rename(folder.write("new.h5", "of this run, and damaged"), path);
  EXPECT_EQ(site.answer("GET", "description", {}).body.find("no file yet"), std::string::npos);
}

TEST(Site, AFileThatNobodyWritesTakesNoCommands) {
  const ScratchFolder folder("gem site");
  Site site(folder.write("bad.h5", "no run file"), false, nullptr);
  EXPECT_EQ(site.answer("POST", "stop", {}).status, 404);
  EXPECT_EQ(site.answer("GET", "", {}).status, 500);
}

}  // namespace
}  // namespace gem::view
