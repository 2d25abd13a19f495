// Every run of runs.txt must give its row of the golden table, on the cpu engine and, if a GPU is usable, on cuda.
// `gem_regression_tests --write` writes the table again. GEM_THREADS sets the threads of the cpu engine; they change no
// bit.
#include <gtest/gtest.h>

#include <exception>
#include <fstream>
#include <iostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gem/base/error.h"
#include "gem/engine/cuda/cuda_engine.h"
#include "gem/engine/testing/threads_asked.h"
#include "gem/field/field.h"
#include "validation/regression/measured_run.h"
#include "validation/regression/run_list.h"
#include "validation/regression/table.h"

namespace gem::regression {
namespace {

EngineOptions cpu_options() {
  EngineOptions options;
  options.threads = test::threads_asked(1);
  return options;
}

EngineOptions cuda_options() {
  EngineOptions options;
  options.name = "cuda";
  return options;
}

std::vector<Row> golden_table() { return parse_table(text_of(table_path()), table_path()); }

/// A run without the expected contacts would test nothing of them.
void expect_touch(const ListedRun& listed, const MeasuredRun& run) {
  EXPECT_EQ(run.contacts > 0, listed.touches != Touches::nothing) << run.contacts << " contacts";
  EXPECT_EQ(run.platform_contacts > 0, listed.touches == Touches::platform)
      << run.platform_contacts << " contacts of the platform";
}

void expect_golden_row(const ListedRun& listed, const EngineOptions& options) {
  const std::vector<Row> golden = golden_table();
  const Row* row = row_of(golden, listed.name);
  const MeasuredRun run = measured(listed, options);
  expect_touch(listed, run);
  ASSERT_NE(row, nullptr) << "golden.csv has no row " << listed.name << ": gem_regression_tests --write makes it";
  const std::string changes = difference(*row, run.row);
  if (changes.empty()) return;
  const bool same_state = row->cells.front().text == run.row.cells.front().text;
  ADD_FAILURE() << (same_state ? "the last state is the golden one, but other numbers are reported\n"
                               : "the run ends in another state than the golden one\n")
                << changes;
}

/// One run on one engine.
class RunTest : public testing::Test {
 public:
  RunTest(ListedRun listed, EngineOptions options) : listed_(std::move(listed)), options_(std::move(options)) {}

 protected:
  void SetUp() override {
    if (options_.name != "cuda") return;
    if (scene_of(listed_).contact.solver == ContactSolver::compliant) GTEST_SKIP() << "cuda has no compliant contacts";
    try {
      usable_cuda_device();
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  void TestBody() override { expect_golden_row(listed_, options_); }

 private:
  ListedRun listed_;
  EngineOptions options_;
};

void register_runs(const std::string& suite, const std::vector<ListedRun>& runs, const EngineOptions& options) {
  for (const ListedRun& run : runs)
    testing::RegisterTest(suite.c_str(), run.name.c_str(), nullptr, nullptr, __FILE__, __LINE__,
                          [run, options] { return new RunTest(run, options); });
}

/// The names that occur more often in `a` than in `b`, for a message.
std::string only_in(const std::multiset<std::string>& a, const std::multiset<std::string>& b) {
  std::string names;
  for (const std::string& name : std::set<std::string>(a.begin(), a.end()))
    if (a.count(name) > b.count(name)) names += " " + name;
  return names;
}

TEST(RegressionTable, HasOneRowForEachRun) {
  std::multiset<std::string> rows, runs;
  for (const Row& row : golden_table()) rows.insert(row.run);
  for (const ListedRun& run : listed_runs()) runs.insert(run.name);
  EXPECT_EQ(only_in(rows, runs), "") << "rows of golden.csv without a run in runs.txt";
  EXPECT_EQ(only_in(runs, rows), "") << "runs of runs.txt without a row in golden.csv";
}

TEST(RegressionTable, IsReadAsItWasWritten) {
  const std::string text = text_of(table_path());
  EXPECT_EQ(table_text(parse_table(text, "golden.csv")), text);
}

TEST(RegressionTable, AFullDiskIsAnError) {
  if (!std::ofstream("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  EXPECT_THROW(write_text("/dev/full", "run,state_hash\n"), std::runtime_error);
  EXPECT_THROW(write_text(testing::TempDir() + "no_such_folder/golden.csv", "run\n"), std::runtime_error);
}

TEST(RegressionThreads, AreANumberOrRefused) {
  EXPECT_EQ(test::threads_in(nullptr, 1), 1);
  EXPECT_EQ(test::threads_in("2", 1), 2);
  for (const char* text : {"two", "", "0", "-1", "2x", "2.5"}) EXPECT_THROW(test::threads_in(text, 1), Error) << text;
}

TEST(RegressionTable, ShowsEachChange) {
  const Row golden{"jam", {{"state_hash", "00ff"}, {"steps", "10"}, {"force_N", "200"}, {"drag_J", "0"}}};
  EXPECT_EQ(difference(golden, golden), "");
  Row now = golden;
  now.cells[2].text = "201";
  now.cells[3].text = "5";
  const std::string changes = difference(golden, now);
  EXPECT_NE(changes.find("+0.005"), std::string::npos) << changes;
  EXPECT_NE(changes.find("changed"), std::string::npos) << changes;
  now.cells.pop_back();
  EXPECT_NE(difference(golden, now).find("-"), std::string::npos) << "a lost column is a change";
}

TEST(RegressionList, RefusesWhatItDoesNotKnow) {
  const auto is_refused = [](const std::string& text) {
    try {
      parse_runs(text, "list");
    } catch (const std::runtime_error& fault) {
      return std::string(fault.what());
    }
    return std::string();
  };
  EXPECT_EQ(is_refused("a\n  case x.toml\n"), "");
  EXPECT_EQ(is_refused("a\n  case x.toml\n  touch floes\n").substr(0, 7), "list:3:");
  EXPECT_EQ(is_refused("a\n  case x.toml\na\n").substr(0, 7), "list:3:");
  EXPECT_EQ(is_refused("a\n  touches ice\n").substr(0, 7), "list:2:");
  EXPECT_NE(is_refused("a\n  touches floes\n").find("no case"), std::string::npos);
}

/// Writes golden.csv from the cpu engine and prints the changes.
int write_table() {
  std::vector<Row> before, rows;
  if (std::ifstream(table_path())) before = golden_table();
  const std::vector<ListedRun> runs = listed_runs();
  for (const ListedRun& listed : runs) make_field(scene_of(listed));  // a refused case fails before the long runs start
  int changed = 0;
  for (const ListedRun& listed : runs) {
    rows.push_back(measured(listed, cpu_options()).row);
    const Row* golden = row_of(before, listed.name);
    const std::string changes = golden ? difference(*golden, rows.back()) : listed.name + " is new\n";
    changed += changes.empty() ? 0 : 1;
    std::cout << changes;
  }
  write_text(table_path(), table_text(rows));
  std::cout << rows.size() << " rows written, " << changed << " of them new or changed\n";
  return 0;
}

}  // namespace
}  // namespace gem::regression

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  try {
    if (argc == 2 && std::string(argv[1]) == "--write") return gem::regression::write_table();
    const auto runs = gem::regression::listed_runs();
    gem::regression::register_runs("Regression", runs, gem::regression::cpu_options());
    gem::regression::register_runs("RegressionCuda", runs, gem::regression::cuda_options());
  } catch (const std::exception& fault) {
    std::cerr << fault.what() << "\n";
    return 1;
  }
  return RUN_ALL_TESTS();
}
