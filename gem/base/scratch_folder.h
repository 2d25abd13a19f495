/// A folder of a test's own: no other process sees its name, and it goes with the object.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace gem {

/// An empty folder in the system's place for temporary files, removed with all that is in it.
/// Tests of one program run side by side as processes of their own, so a fixed name would be shared by them.
class ScratchFolder {
 public:
  /// `label` stands in its name. Throws std::runtime_error where no folder can be made.
  explicit ScratchFolder(const std::string& label = "gem") {
    std::string pattern = (std::filesystem::temp_directory_path() / (label + "-XXXXXX")).string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make the folder " + pattern);
    path_ = pattern;
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes `text` into a file of this name; returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

}  // namespace gem
