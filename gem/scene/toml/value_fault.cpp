// Looks at the words of a line that the TOML library refused.
#include "gem/scene/toml/value_fault.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "gem/scene/problems.h"
#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/scene_tree.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

bool is_text_without_quotes(std::string_view word) {
  constexpr std::string_view values[] = {"true", "false", "inf", "nan"};
  return !word.empty() && (is_letter(word[0]) || std::string_view("_/~.").find(word[0]) != std::string_view::npos) &&
         std::find(std::begin(values), std::end(values), word) == std::end(values);
}

/// The first value of the line for which `is_wrong`, or nothing. Values follow =, and [ and , within a list.
template <class Test>
std::string_view find_value(std::string_view line, const Test& is_wrong) {
  std::string open;  // brackets, the innermost last
  char quote = 0;
  bool has_key = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0) {
      if (c == '\\' && quote == '"') ++i;
      if (c == quote) quote = 0;
      continue;
    }
    if (c == '#') return {};
    if (c == '"' || c == '\'') quote = c;
    if (c == '[' || c == '{') open.push_back(c);
    if ((c == ']' || c == '}') && !open.empty()) open.pop_back();
    has_key = has_key || c == '=';
    const bool in_list = !open.empty() && open.back() == '[';
    if (!has_key || !(c == '=' || ((c == '[' || c == ',') && in_list))) continue;
    const std::size_t end = std::min(line.find_first_of(open.empty() ? "#" : ",[]{}#", i + 1), line.size());
    if (const std::string_view value = without_blanks(line.substr(i + 1, end - i - 1)); is_wrong(value)) return value;
  }
  return {};
}

const OptionInfo* option_of(const std::string& key) {
  const auto& options = scene_options();
  const auto found = std::find_if(options.begin(), options.end(), [&](const auto& o) { return o.path == key; });
  return found == options.end() ? nullptr : &*found;
}

/// A text that lacks its quotes.
ValueFault text_fault(const std::string& value, const std::vector<std::string>& choices) {
  if (choices.empty()) return {"a text needs quotes (value " + value + "); write " + quoted_text(value), value};
  std::string allowed;
  for (const std::string& name : choices) allowed += (allowed.empty() ? "" : ", ") + name;
  const std::string nearest = nearest_name(value, choices), text = nearest.empty() ? choices.front() : nearest;
  return {"a text needs quotes (value " + value + ", allowed " + allowed + "); write " +
              (nearest.empty() ? "one of them in quotes, e.g. " : "") + quoted_text(text),
          text};
}

}  // namespace

bool is_number_with_unit(std::string_view text) {
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
  if (text.empty() || !(is_digit(text[0]) || text[0] == '.')) return false;
  double number = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (read.ptr == text.data()) return false;
  const std::string_view digits = text.substr(0, static_cast<std::size_t>(read.ptr - text.data()));
  const std::string_view rest = text.substr(digits.size()), unit = without_blanks(rest);
  if (unit.empty() || !(is_letter(unit[0]) || unit[0] == '%') || unit.find('_') != std::string_view::npos) return false;
  const bool is_other_base = digits == "0" && std::string_view("xob").find(rest[0]) != std::string_view::npos;
  const bool is_exponent = (rest[0] == 'e' || rest[0] == 'E') && (rest.size() == 1 || !is_letter(rest[1]));
  return !is_other_base && !is_exponent;
}

ValueFault value_fault(const std::string& key, std::string_view line) {
  const OptionInfo* option = option_of(key);
  const bool holds_text = option != nullptr && (option->type == OptionType::text || option->type == OptionType::choice);
  const std::string value(find_value(
      line, [&](std::string_view word) { return is_text_without_quotes(word) || is_number_with_unit(word); }));
  if (value.empty()) return {};
  if (is_number_with_unit(value) && !holds_text)
    return {"a number with a unit (value " + value + "); write the number alone; the unit is in the key's name", ""};
  if (option != nullptr && !holds_text)
    return {"wrong type (value " + value + ", expected " + expected_text(*option) + ")", ""};
  return text_fault(value, option == nullptr ? std::vector<std::string>{} : option->choices);
}

}  // namespace gem
