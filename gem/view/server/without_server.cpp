// Stands in for view_server.cpp where the program is built without cpp-httplib.
#include "gem/base/error.h"
#include "gem/view/server/view_server.h"

namespace gem::view {

struct ViewServer::Inside {};

ViewServer::ViewServer(Site&, const std::string&) {
  throw Error(
      ExitCode::usage,
      "this program cannot serve a page (it was built without libcpp-httplib-dev); use gem view FILE --out PAGE.html");
}
ViewServer::~ViewServer() = default;
int ViewServer::port() const { return -1; }
std::string ViewServer::address() const { return ""; }

}  // namespace gem::view
