// A TOML document as a plain tree that knows the place of every value. Only this file and its source use the TOML
// library.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gem {

/// Place of a key or value in its text. Line and column count from 1; 0 means unknown.
struct TomlPlace {
  std::shared_ptr<const std::string> file;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

/// "file:line:column", or the file alone where the line is unknown.
std::string to_string(const TomlPlace& place);

enum class TomlKind { table, list, text, integer, number, flag, date };

struct TomlNode {
  TomlKind kind = TomlKind::table;
  TomlPlace place;      ///< of the value
  TomlPlace key_place;  ///< of its key; for items of a list, the place of the value
  std::string old_key;  ///< the old name used in the document; empty if the name is current
  std::string text;
  std::int64_t integer = 0;
  double number = 0.0;
  bool flag = false;
  std::vector<TomlNode> items;                            ///< of a list
  std::vector<std::pair<std::string, TomlNode>> entries;  ///< of a table, in the order of the file

  // Defined where the pair is complete; clang 14 asks for that in C++20.
  TomlNode();
  TomlNode(const TomlNode&);
  TomlNode(TomlNode&&) noexcept;
  TomlNode& operator=(const TomlNode&);
  TomlNode& operator=(TomlNode&&) noexcept;
  ~TomlNode();

  const TomlNode* find(const std::string& key) const;
  TomlNode* find(const std::string& key);
};

/// Limits on a document, so that no input can exhaust memory or stack.
inline constexpr std::size_t toml_bytes_maximum = 16u << 20;
inline constexpr int toml_depth_maximum = 16;
inline constexpr std::size_t toml_text_maximum = 4096;

/// Parses TOML 1.0 without multi-line strings. `origin` names the text in messages.
/// Throws Error(scene_rejected) "origin:line:column: key: problem" at the first fault of syntax.
TomlNode parse_toml(const std::string& text, const std::string& origin);

/// Merges `later` over `base`: tables key by key, anything else is replaced.
void merge_toml(TomlNode& base, const TomlNode& later);

/// The node at a dotted path, or null.
const TomlNode* find_path(const TomlNode& root, const std::string& path);

/// A document in which only the dotted path is given.
TomlNode nested_toml(const std::string& path, const TomlNode& value);

/// The value as a person would write it, shortened, for messages.
std::string describe(const TomlNode& node);

}  // namespace gem
