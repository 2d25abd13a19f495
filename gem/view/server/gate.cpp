// Compares what a request says with what the page of this server says.
#include "gem/view/server/gate.h"

#include <sys/random.h>

#include <array>

#include "gem/base/error.h"

namespace gem::view {

std::string new_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != ssize_t(bytes.size()))
    throw Error(ExitCode::device, "no key for the page (the system gives no random numbers); use --out");
  constexpr char digits[] = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) {
    token += digits[byte >> 4];
    token += digits[byte & 15];
  }
  return token;
}

std::string Gate::refusal(const Asked& asked) const {
  const std::string port = ":" + std::to_string(port_);
  const auto is_here = [&](const std::string& name) {
    return name == "127.0.0.1" + port || name == "localhost" + port;
  };
  if (!is_here(asked.host)) return "this server answers only to its own address";
  if (!asked.origin.empty() && (asked.origin.rfind("http://", 0) != 0 || !is_here(asked.origin.substr(7))))
    return "this server answers only to its own page";
  // every character is compared, so that the time tells nothing
  const std::string start = "/" + token_ + "/";
  unsigned differences = asked.path.size() < start.size() ? 1 : 0;
  for (std::size_t i = 0; i < start.size(); ++i)
    differences |= static_cast<unsigned>((i < asked.path.size() ? asked.path[i] : 0) ^ start[i]);
  return differences == 0 ? "" : "the address lacks the key that gem printed";
}

std::string Gate::address() const { return "http://127.0.0.1:" + std::to_string(port_) + "/" + token_ + "/"; }

}  // namespace gem::view
