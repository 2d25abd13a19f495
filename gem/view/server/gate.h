// Who may ask the server of gem view for what. Other users, and other pages in the same browser, may not.
#pragma once

#include <string>

namespace gem::view {

/// What a request says of itself. Absent headers are empty.
struct Asked {
  std::string method;  ///< "GET", "POST", ...
  std::string path;    ///< without the query
  std::string host;
  std::string origin;
};

/// A key of 128 random bits, as 32 hex digits. Throws Error if the system gives no random numbers.
std::string new_token();

class Gate {
 public:
  Gate(std::string token, int port) : token_(std::move(token)), port_(port) {}

  /// Why the request is refused; empty if it is not. Asked must be: this host and port by name, so that no foreign name
  /// that leads to this machine will do; the page's own origin, if one is given; and the token as the first part of the
  /// path.
  std::string refusal(const Asked& asked) const;
  /// The path behind the token.
  std::string place(const Asked& asked) const { return asked.path.substr(token_.size() + 2); }
  std::string address() const;

 private:
  std::string token_;
  int port_;
};

}  // namespace gem::view
