// HDF5 identifiers that close themselves, and reasons of failed calls. Included by gem/record only.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace gem::hdf5 {

/// Short text of the last failure in the library; the reason of the operating system if there is one.
std::string last_reason();

/// Lock for all calls of the library, which is not thread-safe.
std::mutex& library_mutex();

/// Whether the reason of a failure is a lack of memory.
bool is_memory(const std::string& reason);

/// Switches off the library's own error output for the calling thread. Every thread that uses HDF5 calls this first.
void quiet_errors();

/// An identifier with its closing function. close() returns whether closing worked; the destructor ignores failures.
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
  /// Drops the identifier without closing it, for a file that cannot be closed on a full disk.
  void abandon() { id_ = H5I_INVALID_HID; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Closer closer_ = nullptr;
};

/// A failed call of the library, as text `what: reason`.
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

/// Number of elements of a dataset or attribute that is about to be read, each stored in `stored` bytes. Throws Failure
/// if its file cannot hold as many: a damaged or hostile file may claim any size.
std::size_t element_count(hid_t object, hid_t space, std::size_t stored, const std::string& name);

/// A text attribute; empty if there is none, or if it is of another kind.
std::string read_text(hid_t object, const std::string& name);

/// Opens a file for writing that may not have been closed: it is then marked as open, and may be longer than it says.
/// `access` is changed.
Handle open_unclosed(const std::string& path, hid_t access);

/// Opens a file that a process left open or a full disk broke, to change attributes and lengths in their place.
/// Independent of a handle of this process that could not be closed.
Handle open_left_file(const std::string& path);

/// Writes a text attribute. A new one gets `reserved` bytes or more; an existing one keeps its size, and a text that is
/// too long is cut.
void write_text(hid_t object, const char* name, const std::string& text, std::size_t reserved = 0);
/// Writes an attribute of numbers: a new one, or an existing one of the same size.
void write_numbers(hid_t object, const char* name, hid_t file_type, const std::vector<double>& values);

}  // namespace gem::hdf5
