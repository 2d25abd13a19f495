// The server by cpp-httplib: every request passes the gate before it is looked at.
#include "gem/view/server/view_server.h"

#include <httplib.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "gem/base/error.h"
#include "gem/view/page_text.h"
#include "gem/view/server/gate.h"

namespace gem::view {

namespace {

void set_answer(httplib::Response& response, const Reply& reply) {
  response.status = reply.status;
  response.set_content(reply.body, reply.type.c_str());
}

}  // namespace

struct ViewServer::Inside {
  httplib::Server server;
  Site& site;
  int port;
  Gate gate;
  std::atomic<bool> ended = false;  // it answers no more, or never did
  std::thread thread;

  Inside(Site& served, const std::string& token)
      : site(served), port(server.bind_to_any_port("127.0.0.1")), gate(token, port) {
    if (port <= 0)
      throw Error(ExitCode::device, "cannot serve the page (no port can be had at 127.0.0.1); use gem view --out");
    server.set_payload_max_length(1024);
    server.set_default_headers({{"Cache-Control", "no-store"},
                                {"Content-Security-Policy", content_security_policy(true)},
                                {"Cross-Origin-Resource-Policy", "same-origin"},
                                {"Referrer-Policy", "no-referrer"},
                                {"X-Content-Type-Options", "nosniff"},
                                {"X-Frame-Options", "DENY"}});
    server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      answer(request, response);
      return httplib::Server::HandlerResponse::Handled;
    });
    thread = std::thread([this] {
      server.listen_after_bind();
      ended = true;
    });
  }

  void answer(const httplib::Request& request, httplib::Response& response) {
    const Asked asked{request.method, request.path, request.get_header_value("Host"),
                      request.get_header_value("Origin")};
    if (const std::string why = gate.refusal(asked); !why.empty()) {
      set_answer(response, {403, "text/plain; charset=utf-8", why});
      return;
    }
    const std::map<std::string, std::string> query(request.params.begin(), request.params.end());
    set_answer(response, site.answer(asked.method, gate.place(asked), query));
  }
};

ViewServer::ViewServer(Site& site, const std::string& token) : inside_(std::make_unique<Inside>(site, token)) {}

ViewServer::~ViewServer() {
  // it cannot be stopped before it has begun
  while (!inside_->server.is_running() && !inside_->ended) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  inside_->server.stop();
  inside_->thread.join();
}

int ViewServer::port() const { return inside_->port; }
std::string ViewServer::address() const { return inside_->gate.address(); }

}  // namespace gem::view
