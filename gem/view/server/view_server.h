// A server for one page, reachable from this machine alone.
#pragma once

#include <memory>
#include <string>

#include "gem/view/server/site.h"

namespace gem::view {

/// Answers from the moment it is made until its end, on threads of its own.
class ViewServer {
 public:
  /// Throws Error(device) if no port can be had, or Error(usage) if the program was built without a server.
  ViewServer(Site& site, const std::string& token);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  int port() const;
  /// Address with the token.
  std::string address() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace gem::view
