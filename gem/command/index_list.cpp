// Parsing of --index.
#include "gem/command/index_list.h"

#include <charconv>
#include <set>

#include "gem/base/error.h"

namespace gem {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& why, std::size_t count) {
  throw Error(ExitCode::usage, "--index " + text + " is not a list of runs (" + why + "); give numbers from 1 to " +
                                   std::to_string(count) + " as in 3 or 1-4,7; see `gem sweep list`");
}

std::size_t number(const std::string& part, const std::string& text, std::size_t count) {
  std::size_t value = 0;
  const auto [end, fault] = std::from_chars(part.data(), part.data() + part.size(), value);
  if (fault != std::errc{} || end != part.data() + part.size())
    refuse(text, "'" + part + "' is not a whole number", count);
  if (value < 1 || value > count) refuse(text, "there is no run " + part, count);
  return value;
}

}  // namespace

std::vector<std::size_t> parse_index_list(const std::string& text, std::size_t count) {
  std::set<std::size_t> chosen;
  if (text.empty())
    for (std::size_t i = 0; i < count; ++i) chosen.insert(i);
  for (std::size_t begin = 0; begin < text.size() || (begin == text.size() && begin > 0);) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, comma - begin);
    const std::size_t dash = part.find('-');
    const std::size_t first = number(part.substr(0, dash), text, count);
    const std::size_t last = dash == std::string::npos ? first : number(part.substr(dash + 1), text, count);
    if (last < first) refuse(text, "'" + part + "' has its ends in the wrong order", count);
    for (std::size_t i = first; i <= last; ++i) chosen.insert(i - 1);
    begin = comma + 1;
  }
  return {chosen.begin(), chosen.end()};
}

}  // namespace gem
