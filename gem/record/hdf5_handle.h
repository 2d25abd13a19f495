// HDF5 identifiers that close themselves, and the reason of a failed call. Included by gem/record only.
#pragma once

#include <hdf5.h>

#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace gem::hdf5 {

/// What the library says about the last failure, in a few words; the system's own reason if it gave one.
std::string last_reason();

/// The library is not safe for threads: whoever writes while others may holds this.
std::mutex& library_mutex();

/// Silences the library's own printing for the calling thread; every thread that uses HDF5 calls this first.
void quiet_errors();

/// An identifier with its closing function. close() says whether closing worked; the destructor ignores it.
class Handle {
 public:
  using Closer = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), closer_(other.closer_) {}
  Handle& operator=(Handle&& other) noexcept {
    close();
    id_ = std::exchange(other.id_, H5I_INVALID_HID);
    closer_ = other.closer_;
    return *this;
  }
  ~Handle() { close(); }
  bool valid() const { return id_ >= 0; }
  operator hid_t() const { return id_; }
  bool close() { return id_ < 0 || closer_(std::exchange(id_, H5I_INVALID_HID)) >= 0; }
  /// Forgets the identifier without closing it: for a file that a full disk no longer lets close.
  void abandon() { id_ = H5I_INVALID_HID; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Closer closer_ = nullptr;
};

/// A failed call of the library, as `what: reason`.
struct Failure {
  std::string text;
};

/// Throws Failure if the call failed.
inline void check(herr_t status, const char* what) {
  if (status < 0) throw Failure{std::string(what) + ": " + last_reason()};
}
inline Handle checked(hid_t id, Handle::Closer closer, const char* what) {
  if (id < 0) throw Failure{std::string(what) + ": " + last_reason()};
  return {id, closer};
}

void write_text(hid_t object, const char* name, const std::string& text, std::size_t reserved = 0);
void write_numbers(hid_t object, const char* name, hid_t file_type, const std::vector<double>& values);

}  // namespace gem::hdf5
