// Checks the limits of a text, parses it with toml++ and copies the result into the plain tree.
#include "gem/scene/toml/toml_tree.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "gem/base/error.h"
#include "gem/scene/toml/toml_text.h"

// Header-only, because it then reads numbers with std::from_chars; the packaged library reads them through a stream.
// Its assertions are off in every build: bad input reaches them, and the code behind them reports it properly.
#define TOML_HEADER_ONLY 1
#define TOML_ASSERT(expr) static_assert(true)
#define TOML_FLOAT_CHARCONV 1
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

namespace gem {
namespace {

using File = std::shared_ptr<const std::string>;

[[noreturn]] void reject(const TomlPlace& place, const std::string& problem) {
  throw Error(ExitCode::scene_rejected, to_string(place) + ": " + problem);
}

std::string trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return std::string(text);
}

/// The dotted key assigned in the given line, found without parsing, so that a syntax error can name its key.
std::string key_near_line(std::string_view text, std::uint32_t line) {
  std::string section;
  std::string key;
  for (std::uint32_t number = 1; number <= line; ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string current = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t equals = current.find('=');
    if (!current.empty() && current.front() == '[') {
      const std::size_t first = current.find_first_not_of('[');
      const std::size_t last = current.find(']');
      if (first != std::string::npos && last != std::string::npos && last > first && equals == std::string::npos &&
          current.find(',') == std::string::npos) {
        section = trimmed(std::string_view(current).substr(first, last - first));
        key.clear();
      }
    } else if (equals != std::string::npos && equals > 0 && equals <= 80) {
      key = trimmed(std::string_view(current).substr(0, equals));
    }
  }
  if (section.empty() || key.empty()) return section + key;
  return section + "." + key;
}

/// Refuses deep brackets, long dotted keys and long strings before the library spends stack or memory on them. Refuses
/// letters outside ASCII where TOML has none: toml++ 3.3 has undefined behaviour there.
class LimitScanner {
 public:
  explicit LimitScanner(const File& file) : place_{file, 1, 0} {}

  void scan(std::string_view text) {
    const std::size_t byte_order_mark = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    for (std::size_t i = byte_order_mark; i < text.size(); ++i) {
      const char c = text[i];
      if (c == '\n') {
        new_line();
      } else if (++place_.column; quote_ != 0) {
        inside_string(c);
      } else if (!comment_) {
        if (text.substr(i, 3) == "\"\"\"" || text.substr(i, 3) == "'''")
          reject(place_, "multi-line strings are not allowed; write it on one line");
        outside_string(c);
      }
    }
  }

 private:
  void new_line() {
    ++place_.line;
    place_.column = 0;
    quote_ = 0;
    comment_ = false;
    dots_ = 0;
    last_ = 0;
    if (open_.empty()) value_ = false;
  }

  void inside_string(char c) {
    if (++length_ > toml_text_maximum)
      reject(place_, "a string is too long (allowed " + std::to_string(toml_text_maximum) + " bytes)");
    if (escaped_)
      escaped_ = false;
    else if (c == '\\' && quote_ == '"')
      escaped_ = true;
    else if (c == quote_)
      quote_ = 0;
  }

  bool begins_word() const { return last_ == 0 || std::string_view("=,[{").find(last_) != std::string_view::npos; }

  /// The library reads on behind a quote in the middle of a word, as if no string began there. A quote may follow a
  /// point in a key only.
  void open_string(char quote) {
    if (!begins_word() && !(last_ == '.' && !value_))
      reject(place_, "a quote in the middle of a key or value; it may stand only at the beginning and at the end");
    quote_ = quote;
    length_ = 0;
    escaped_ = false;
  }

  /// A brace begins with a key. A bracket holds values, or the key of a header.
  void open_bracket(char c) {
    if (!begins_word()) reject(place_, "a bracket in the middle of a key or value; it may stand only at the beginning");
    open_.push_back(c);
    if (c == '{') value_ = false;
  }

  void close_bracket(char c) {
    const char opening = c == ']' ? '[' : '{';
    if (open_.empty() || open_.back() != opening)
      reject(place_, std::string("malformed: '") + c + "' without its '" + opening + "'");
    open_.pop_back();
    value_ = true;
  }

  void outside_string(char c) {
    if (c == '#') comment_ = true;
    if (static_cast<unsigned char>(c) > 0x7f)
      reject(place_, "a character outside ASCII; it may stand only between quotes and in comments");
    if (c == '"' || c == '\'') open_string(c);
    if (c == '[' || c == '{') open_bracket(c);
    if (c == ']' || c == '}') close_bracket(c);
    if (c == '=') value_ = true;
    if (c == ',') value_ = !open_.empty() && open_.back() == '[';
    if (c == '.') ++dots_;
    if (c == '=' || c == ',' || c == '[' || c == '{') dots_ = 0;
    if (c != ' ' && c != '\t' && c != '\r') last_ = c;
    if (open_.size() > toml_depth_maximum || dots_ > toml_depth_maximum)
      reject(place_, "values are nested too deep (allowed " + std::to_string(toml_depth_maximum) + " levels)");
  }

  TomlPlace place_;
  char quote_ = 0;
  bool escaped_ = false;
  bool comment_ = false;
  bool value_ = false;  // what stands here is a value, not a key
  std::string open_;    // brackets that are still open, the innermost last
  std::size_t dots_ = 0;
  char last_ = 0;  // character of this line outside of strings that is no blank; 0: none
  std::size_t length_ = 0;
};

TomlPlace place_of(const toml::source_region& region, const File& file) {
  return {file, static_cast<std::uint32_t>(region.begin.line), static_cast<std::uint32_t>(region.begin.column)};
}

TomlNode converted(const toml::node& node, const File& file);

void fill_table(TomlNode& out, const toml::table& table, const File& file) {
  out.kind = TomlKind::table;
  for (const auto& [key, value] : table) {
    out.entries.emplace_back(std::string(key.str()), converted(value, file));
    out.entries.back().second.key_place = place_of(key.source(), file);
  }
  // The library sorts keys alphabetically; a sweep needs them in the order of the file.
  std::sort(out.entries.begin(), out.entries.end(), [](const auto& a, const auto& b) {
    const TomlPlace& p = a.second.key_place;
    const TomlPlace& q = b.second.key_place;
    return p.line != q.line ? p.line < q.line : p.column < q.column;
  });
}

TomlNode converted(const toml::node& node, const File& file) {
  TomlNode out;
  out.place = place_of(node.source(), file);
  out.key_place = out.place;
  out.kind = TomlKind::date;
  if (const auto* table = node.as_table()) fill_table(out, *table, file);
  if (const auto* list = node.as_array()) {
    out.kind = TomlKind::list;
    for (const auto& item : *list) out.items.push_back(converted(item, file));
  }
  if (const auto* text = node.as_string()) out.kind = TomlKind::text, out.text = text->get();
  if (const auto* integer = node.as_integer()) out.kind = TomlKind::integer, out.integer = integer->get();
  if (const auto* number = node.as_floating_point()) out.kind = TomlKind::number, out.number = number->get();
  if (const auto* flag = node.as_boolean()) out.kind = TomlKind::flag, out.flag = flag->get();
  return out;
}

}  // namespace

TomlNode::TomlNode() = default;
TomlNode::TomlNode(const TomlNode&) = default;
TomlNode::TomlNode(TomlNode&&) noexcept = default;
TomlNode& TomlNode::operator=(const TomlNode&) = default;
TomlNode& TomlNode::operator=(TomlNode&&) noexcept = default;
TomlNode::~TomlNode() = default;

std::string to_string(const TomlPlace& place) {
  const std::string file = place.file ? *place.file : std::string("scene");
  if (place.line == 0) return file;
  return file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

const TomlNode* TomlNode::find(const std::string& key) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.first == key; });
  return found == entries.end() ? nullptr : &found->second;
}

TomlNode* TomlNode::find(const std::string& key) {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.first == key; });
  return found == entries.end() ? nullptr : &found->second;
}

TomlNode parse_toml(const std::string& text, const std::string& origin) {
  const File file = std::make_shared<const std::string>(origin);
  if (text.size() > toml_bytes_maximum)
    reject({file, 0, 0}, "the file is too large (" + std::to_string(text.size()) + " bytes, allowed " +
                             std::to_string(toml_bytes_maximum) + ")");
  if (text.find('\0') != std::string::npos)
    reject({file, 0, 0}, text.starts_with("\x89HDF")
                             ? "an HDF5 file, not a case; `gem info FILE --case` prints the case of a run"
                             : "not a text file (it holds a zero byte)");
  LimitScanner(file).scan(text);
  try {
    TomlNode root = converted(toml::parse(text), file);
    root.place = root.key_place = {file, 0, 0};
    return root;
  } catch (const toml::parse_error& error) {
    const TomlPlace place = place_of(error.source(), file);
    std::string key = key_near_line(text, place.line);
    if (!key.empty()) key += ": ";
    std::string problem(error.description());
    if (const std::string opening = "Error while parsing "; problem.starts_with(opening))
      problem.replace(0, opening.size(), "malformed ");
    std::replace(problem.begin(), problem.end(), '\n', ' ');
    reject(place, key + problem);
  }
}

void merge_toml(TomlNode& base, const TomlNode& later) {
  for (const auto& [key, value] : later.entries) {
    TomlNode* old = base.find(key);
    if (old == nullptr)
      base.entries.emplace_back(key, value);
    else if (old->kind == TomlKind::table && value.kind == TomlKind::table)
      merge_toml(*old, value);
    else
      *old = value;
  }
}

const TomlNode* find_path(const TomlNode& root, const std::string& path) {
  const TomlNode* node = &root;
  for (std::size_t begin = 0; node != nullptr && begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    node = node->find(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return node;
}

TomlNode nested_toml(const std::string& path, const TomlNode& value) {
  const std::size_t dot = path.find('.');
  TomlNode table;
  table.place = table.key_place = value.place;
  const bool last = dot == std::string::npos;
  table.entries.emplace_back(path.substr(0, dot), last ? value : nested_toml(path.substr(dot + 1), value));
  return table;
}

std::string describe(const TomlNode& node) {
  switch (node.kind) {
    case TomlKind::table:
      return "a table";
    case TomlKind::list:
      return "a list of " + std::to_string(node.items.size());
    case TomlKind::text:
      return quoted_text(node.text.size() <= 60 ? node.text : node.text.substr(0, 60) + "...");
    case TomlKind::integer:
      return std::to_string(node.integer);
    case TomlKind::number:
      return toml_number_text(node.number);
    case TomlKind::flag:
      return node.flag ? "true" : "false";
    case TomlKind::date:
      return "a date";
  }
  return "";
}

}  // namespace gem
