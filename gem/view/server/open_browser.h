// Opens an address in the user's browser.
#pragma once

#include <string>

namespace gem::view {

/// Opens `address` where there is a desktop; else does nothing. The address holds a key, so it is handed over in a file
/// that only this user can read, never in the arguments of a process. The file is removed with the object.
class OpenedBrowser {
 public:
  explicit OpenedBrowser(const std::string& address);
  ~OpenedBrowser();
  OpenedBrowser(const OpenedBrowser&) = delete;
  OpenedBrowser& operator=(const OpenedBrowser&) = delete;

  /// Whether there is a desktop, whose browser was called.
  bool is_open() const { return is_open_; }

 private:
  std::string file_;
  bool is_open_ = false;
};

}  // namespace gem::view
