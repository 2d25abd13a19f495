// What a run file says stays text in the page, and the policy of the page fits its script.
#include "gem/view/page_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace gem::view {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(PageText, ANameCannotBecomeHtml) {
  const std::string evil = "</script></title><b>@script@@data@<!--<script>";
  const std::string page = whole_page({{"name", evil}}, {"\x01\x02"});
  const std::string plain = whole_page({{"name", "run"}}, {"\x01\x02"});
  for (const char* tag : {"</script>", "<script", "<b>", "<!--", "</title>"})
    EXPECT_EQ(count(page, tag), count(plain, tag)) << tag;
  EXPECT_EQ(count(page, page_script), 1U);
}

TEST(PageText, PagesWithTheirDataAskNobody) {
  const std::string page = whole_page({{"name", "run"}}, {});
  EXPECT_NE(page.find("connect-src 'none'"), std::string::npos);
  EXPECT_NE(served_page("run", true).find("connect-src 'self'"), std::string::npos);
  EXPECT_EQ(content_security_policy(true).find("unsafe"), std::string::npos);
}

TEST(PageText, ModulesAreOneScript) {
  EXPECT_EQ(page_script.find("\nimport "), std::string::npos);
  EXPECT_EQ(page_script.find("\nexport "), std::string::npos);
  EXPECT_EQ(page_script.find("</script"), std::string::npos);
  EXPECT_NE(page_script.find("uPlot 1.6.32"), std::string::npos);
  EXPECT_NE(page_script.find("Permission is hereby granted"), std::string::npos);
}

}  // namespace
}  // namespace gem::view
