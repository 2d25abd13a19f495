// Output files of an export: checked before, complete or not there after.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

namespace gem {

/// Writes a file by way of a draft, `.NAME.new` beside it, so that a failure leaves the former file or none. Throws
/// Error(file_system) if it cannot be written.
void write_export(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// A folder of .vtp files that appears when it is complete. The destructor removes a draft.
class ExportFolder {
 public:
  /// Throws Error(file_system) if the folder exists (and not overwrite), if it holds anything but .vtp files, or if its
  /// draft, `.NAME.new` beside it, cannot be made.
  ExportFolder(std::filesystem::path folder, bool overwrite);
  ~ExportFolder();
  ExportFolder(const ExportFolder&) = delete;
  ExportFolder& operator=(const ExportFolder&) = delete;

  void write(const std::string& name, const std::function<void(std::ostream&)>& write) const;
  /// Gives the draft its name, in the place of a former folder.
  void publish();

 private:
  std::filesystem::path folder_, draft_;
};

}  // namespace gem
