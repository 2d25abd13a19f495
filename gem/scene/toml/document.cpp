// Includes are followed depth first. A file is parsed once for each place that includes it.
#include "gem/scene/toml/document.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "gem/base/error.h"
#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/toml_text.h"
#include "gem/scene/toml/value_fault.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t include_depth_maximum = 16;
constexpr std::size_t include_files_maximum =
    256;  // of one case; files that include each other twice double with depth

/// The files that are being read, innermost last, and how many were read.
struct Reading {
  std::vector<fs::path> open;
  std::size_t files = 0;
};

/// The path without links. A pipe such as /dev/fd/63 and a loop of links have none; reading says what is wrong.
fs::path resolved_path(const fs::path& path) {
  std::error_code fault;
  const fs::path resolved = fs::weakly_canonical(path, fault);
  return fault ? path : resolved;
}

std::string read_text(const std::string& path) {
  std::error_code code;
  if (fs::is_directory(path, code))
    throw Error(ExitCode::file_system, "cannot read " + quoted_text(path) + " (it is a directory); name a case file");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Error(ExitCode::file_system,
                "cannot read " + quoted_text(path) + " (" + std::strerror(errno) + "); check the path");
  // Reading one byte more than allowed is enough to refuse a file of any size.
  std::string text(toml_bytes_maximum + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (file.bad()) throw Error(ExitCode::file_system, "cannot read " + quoted_text(path) + " (input error)");
  return text;
}

/// Makes every floes.path in the document relative to the document's folder.
void anchor_paths(TomlNode& node, const fs::path& folder) {
  for (auto& [key, value] : node.entries) {
    anchor_paths(value, folder);
    TomlNode* path = key == "floes" ? value.find("path") : nullptr;
    if (path != nullptr && path->kind == TomlKind::text && !path->text.empty())
      path->text = (folder / path->text).lexically_normal().string();
  }
  for (TomlNode& item : node.items) anchor_paths(item, folder);
}

/// The current name of a dotted path.
std::string current_path(const std::string& path) {
  for (const RenamedKey& key : renamed_keys())
    if (path == std::string(key.section) + "." + key.old_name) return std::string(key.section) + "." + key.name;
  return path;
}

/// Replaces old keys by their current names, wherever their section stands, and records the old names.
void rename_old_keys(TomlNode& node) {
  for (auto& [section, table] : node.entries) {
    rename_old_keys(table);
    if (section == "map" && table.kind == TomlKind::table)  // of a sweep: maps axes to paths of options
      for (auto& entry : table.entries) entry.second.text = current_path(entry.second.text);
    for (auto& [name, value] : table.entries)
      for (const RenamedKey& key : renamed_keys())
        if (section == key.section && name == key.old_name) {
          value.old_key = name;
          name = key.name;
        }
  }
  for (TomlNode& item : node.items) rename_old_keys(item);
}

/// Parses a text and replaces old keys.
TomlNode parse_document(const std::string& text, const std::string& origin) {
  TomlNode document = parse_toml(text, origin);
  rename_old_keys(document);
  return document;
}

TomlNode with_includes(TomlNode document, const fs::path& folder, Reading& reading);

TomlNode load_file(const fs::path& path, Reading& reading) {
  reading.open.push_back(resolved_path(path));
  ++reading.files;
  TomlNode document = parse_document(read_text(path.string()), path.string());
  anchor_paths(document, path.parent_path());
  document = with_includes(std::move(document), path.parent_path(), reading);
  reading.open.pop_back();
  return document;
}

[[noreturn]] void reject_include(const TomlNode& node, const std::string& problem) {
  throw Error(ExitCode::scene_rejected, to_string(node.place) + ": include: " + problem);
}

TomlNode with_includes(TomlNode document, const fs::path& folder, Reading& reading) {
  const TomlNode* include = document.find("include");
  if (include == nullptr) return document;
  if (include->kind != TomlKind::list)
    reject_include(*include, "expected a list of file names, got " + describe(*include));
  TomlNode merged;
  merged.place = document.place;
  for (const TomlNode& item : include->items) {
    if (item.kind != TomlKind::text) reject_include(item, "expected a file name, got " + describe(item));
    const fs::path path = folder / item.text;
    if (std::find(reading.open.begin(), reading.open.end(), resolved_path(path)) != reading.open.end())
      reject_include(item, "the file includes itself (value " + describe(item) + ")");
    if (reading.open.size() >= include_depth_maximum)
      reject_include(item, "includes are nested too deep (allowed " + std::to_string(include_depth_maximum) + ")");
    if (reading.files >= include_files_maximum)
      reject_include(item, "too many files (allowed " + std::to_string(include_files_maximum) + ")");
    merge_toml(merged, load_file(path, reading));
  }
  merge_toml(merged, document);
  std::erase_if(merged.entries, [](const auto& entry) { return entry.first == "include"; });
  return merged;
}

}  // namespace

TomlNode load_document(const std::string& path) {
  Reading reading;
  return load_file(path, reading);
}

TomlNode load_text(const std::string& text, const std::string& origin) {
  TomlNode document = parse_document(text, origin);
  if (const TomlNode* include = document.find("include"))
    reject_include(*include, "only a file can include others; paths in a text from elsewhere are not opened");
  return document;
}

namespace {

/// An override is one line and its message names the option, so line numbers would not help.
void forget_lines(TomlNode& node) {
  node.place.line = node.key_place.line = 0;
  for (auto& entry : node.entries) forget_lines(entry.second);
  for (TomlNode& item : node.items) forget_lines(item);
}

/// Adds the quotes that a shell removes from `key="word"`: an unquoted word is a text unless it is a TOML value.
std::string with_quotes(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals + 1 == assignment.size()) return assignment;
  const std::string value = assignment.substr(equals + 1);
  const auto in_word = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  if (!std::isalpha(static_cast<unsigned char>(value[0])) || !std::all_of(value.begin(), value.end(), in_word))
    return assignment;
  for (const char* known : {"true", "false", "inf", "nan"})
    if (value == known) return assignment;
  return assignment.substr(0, equals + 1) + '"' + value + '"';
}

}  // namespace

TomlNode parse_override(const std::string& text) {
  const std::size_t space = text.starts_with("--") ? text.find(' ') : std::string::npos;
  const std::string assignment = space == std::string::npos ? text : text.substr(space + 1);
  const std::string given = space == std::string::npos
                                ? "--set " + text
                                : text.substr(0, space + 1) + assignment.substr(assignment.find('=') + 1);
  try {
    TomlNode tree = parse_document(with_quotes(assignment), given);
    forget_lines(tree);
    return tree;
  } catch (const Error& error) {
    const std::string key = assignment.substr(0, assignment.find('='));
    if (const ValueFault fault = value_fault(key, assignment); !fault.problem.empty())
      throw Error(error.code(),
                  given + ": " + key + ": " + fault.problem +
                      (fault.text.empty() ? "" : ", in a shell --set '" + key + "=" + quoted_text(fault.text) + "'"));
    const bool is_indexed = key.find('[') != std::string::npos;
    throw Error(error.code(), std::string(error.what()) +
                                  (is_indexed ? " (--set cannot change one entry of a list); give the whole list, e.g. "
                                                "'ice.class=[{name=\"thin\", thickness_m=0.7, tenths=4}]'"
                                              : " (--set takes key=value in TOML syntax; text that is not one word "
                                                "needs quotes)"));
  }
}

void apply_overrides(TomlNode& document, const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) {
    const TomlNode later = parse_override(text);
    if (const TomlNode* include = later.find("include"))
      reject_include(*include, "only a file can include others; write include in the case file");
    merge_toml(document, later);
  }
}

}  // namespace gem
