// The manual page and the completion hold what --help says; --version --json holds the build.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "gem/command/command_fixture.h"
#include "gem/command/pages/completion.h"
#include "gem/command/pages/manual_page.h"

namespace gem {
namespace {

class Pages : public CommandTest {
 protected:
  /// What bash offers for a line that ends in the cursor.
  std::string offered(const std::string& words, int cursor) {
    EXPECT_EQ(shell("gem completion > completion; source completion; compopt() { :; }; COMP_WORDS=(" + words +
                    "); COMP_CWORD=" + std::to_string(cursor) + "; _gem; echo \"${COMPREPLY[*]}\""),
              0)
        << text_of("err");
    EXPECT_EQ(text_of("err"), "");
    const std::string text = text_of("out");
    return text.substr(0, text.find('\n'));
  }
  /// Options of each command by --help; "sweep list" is a command of a command.
  std::map<std::string, std::vector<std::string>> help() {
    EXPECT_EQ(shell("commands() { gem $1 --help | sed '1,/^Subcommands/d' | grep -oE '^  [a-z]+'; }; "
                    "all() { for c in $(commands); do subs=$(commands $c); "
                    "if [ -z \"$subs\" ]; then echo $c; else for s in $subs; do echo $c $s; done; fi; done; }; "
                    "all | while read -r c; do echo \"$c:\" $(gem $c --help | grep -oE '^  (-[a-zA-Z],)?--[a-z-]+' | "
                    "grep -oE -- '--[a-z-]+'); done"),
              0);
    std::istringstream lines(text_of("out"));
    std::map<std::string, std::vector<std::string>> commands;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t colon = line.find(':');
      std::istringstream words(line.substr(colon + 1));
      std::vector<std::string>& options = commands[line.substr(0, colon)];
      for (std::string word; words >> word;) options.push_back(word);
    }
    return commands;
  }
};

std::string with_roff_dashes(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '-' ? std::string("\\-") : std::string(1, c);
  return result;
}

TEST_F(Pages, TheManualPageHasEveryCommandAndOptionOfTheHelp) {
  const auto commands = help();
  ASSERT_GT(commands.size(), 10u);
  ASSERT_EQ(shell("gem manual"), 0);
  const std::string page = text_of("out");
  for (const auto& [command, options] : commands) {
    const std::size_t begin = page.find(".SS \\fBgem " + command + "\\fR");
    ASSERT_NE(begin, std::string::npos) << command;
    const std::string section = page.substr(begin, page.find("\n.S", begin) - begin);
    for (const std::string& option : options) {
      if (option == "--help") continue;
      EXPECT_NE(section.find("\\fB" + with_roff_dashes(option) + "\\fR"), std::string::npos)
          << command << " " << option;
    }
  }
}

TEST_F(Pages, TheManualPageIsCleanRoff) {
  if (shell("command -v groff") != 0) GTEST_SKIP() << "groff is not installed";
  EXPECT_EQ(shell("gem manual > gem.1 && groff -man -ww -Tascii -P-cbou gem.1 > page"), 0);
  EXPECT_EQ(text_of("err"), "");
  EXPECT_NE(text_of("page").find("--overwrite"), std::string::npos);
}

TEST(ManualPage, NoTextIsTakenForARequest) {
  const CommandText program{"", "Loads.", ".so /etc/passwd\n'x \\n", {}, {{"run", ".ig `a`", "", {}, {}}}};
  const std::string page = manual_page(program, "1");
  EXPECT_NE(page.find("\n\\&.so /etc/passwd\n\\&'x \\en\n"), std::string::npos) << page;
  EXPECT_NE(page.find("\n\\&.ig \\fBa\\fR\n"), std::string::npos) << page;
}

TEST_F(Pages, TheCompletionOffersEveryCommandAndOptionOfTheHelp) {
  const auto commands = help();
  ASSERT_GT(commands.size(), 10u);
  std::string first = " " + offered("gem ''", 1) + " ", lines;
  for (const auto& [command, options] : commands) {
    EXPECT_NE(first.find(" " + command.substr(0, command.find(' ')) + " "), std::string::npos) << command;
    const std::string cursor = command.find(' ') == std::string::npos ? "2" : "3";
    lines += "COMP_WORDS=(gem " + command + " --); COMP_CWORD=" + cursor + "; _gem; echo \" ${COMPREPLY[*]} \"; ";
  }
  ASSERT_EQ(shell("source completion; " + lines + "true"), 0) << text_of("err");
  std::istringstream answers(text_of("out"));
  for (const auto& [command, options] : commands) {
    std::string answer;
    std::getline(answers, answer);
    for (const std::string& option : options)
      EXPECT_NE(answer.find(" " + option + " "), std::string::npos) << command << " " << option;
  }
}

TEST_F(Pages, TheCompletionKnowsValuesKeysAndFiles) {
  EXPECT_EQ(offered("gem run --engine c", 3), "cuda cpu");
  EXPECT_EQ(offered("gem run --engine = c", 4), "cuda cpu") << "--engine=c, as bash splits it";
  EXPECT_EQ(offered("gem sweep st", 2), "status");
  EXPECT_EQ(offered("gem case explain mooring.stiff", 3), "mooring.stiffness_N_per_m");
  EXPECT_EQ(offered("gem case explain moor", 3).substr(0, 8), "mooring ");
  EXPECT_EQ(offered("gem run a.toml --set mooring.stiff", 4), "mooring.stiffness_N_per_m=");
  ASSERT_EQ(shell("touch 'one run.h5' other.txt; mkdir more"), 0);
  EXPECT_EQ(offered("gem info ''", 2), "one run.h5 more");
  EXPECT_EQ(offered("gem run ''", 2), "") << "any file: left to bash";
  EXPECT_EQ(offered("gem info -", 2).find("one"), std::string::npos);
}

TEST_F(Pages, TheVersionIsSaidForPeopleAndPrograms) {
  ASSERT_EQ(shell("gem --version"), 0);
  const std::string text = text_of("out");
  ASSERT_EQ(shell("gem --version --json"), 0) << text_of("err");
  const auto object = nlohmann::json::parse(text_of("out"));
  EXPECT_EQ("gem " + object.at("version").get<std::string>() + " " + object.at("commit").get<std::string>() + " " +
                object.at("build_type").get<std::string>() + " " + object.at("compiler").get<std::string>() + "\n",
            text);
  EXPECT_EQ(object.at("engines").at(0), "reference");
  for (const char* library : {"HDF5", "GSL", "CLI11", "Eigen3", "nlohmann_json", "tomlplusplus"})
    EXPECT_GE(std::stoi(object.at("libraries").at(library).get<std::string>()), 1) << library;
  EXPECT_TRUE(object.at("installed_files").is_null()) << "this program is in its build folder";
  EXPECT_EQ(shell("gem --json"), 2);
}

}  // namespace
}  // namespace gem
