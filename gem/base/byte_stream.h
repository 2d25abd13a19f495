// Numbers, text and arrays as bytes and back, for files that only this program reads. The byte order is that of the
// machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gem {

/// Bytes that do not hold what their reader expects.
struct ByteFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Writes values one after another. A function template can take a ByteWriter or a ByteReader and name each member
/// once.
class ByteWriter {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }
  std::size_t size() const { return bytes_.size(); }
  const std::byte* data() const { return bytes_.data(); }
  /// Asks for the memory of `size` bytes at once.
  void reserve(std::size_t size) { bytes_.reserve(size); }
  /// Overwrites the eight bytes at `at`, which were written before.
  void replace(std::size_t at, std::uint64_t value) { std::memcpy(bytes_.data() + at, &value, sizeof value); }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  template <class Value>
  void put(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    append(&value, sizeof value);
  }
  void put(const std::string& text) { put(std::vector<char>(text.begin(), text.end())); }
  template <class Value>
  void put(const std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    put(std::uint64_t{sizeof(Value)});
    put(std::uint64_t{values.size()});
    append(values.data(), values.size() * sizeof(Value));
  }
  void append(const void* from, std::size_t size) {
    const auto* const first = static_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), first, first + size);
  }

  std::vector<std::byte> bytes_;
};

/// Counts the bytes that a ByteWriter would write.
class ByteCount {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (add(values), ...);
  }
  std::size_t size() const { return size_; }

 private:
  template <class Value>
  void add(const Value&) {
    size_ += sizeof(Value);
  }
  void add(const std::string& text) { add(std::vector<char>(text.begin(), text.end())); }
  template <class Value>
  void add(const std::vector<Value>& values) {
    size_ += 2 * sizeof(std::uint64_t) + values.size() * sizeof(Value);
  }

  std::size_t size_ = 0;
};

/// Reads what a ByteWriter wrote. Throws ByteFault if the bytes end too early or elements have another size.
class ByteReader {
 public:
  /// The bytes must outlive this object.
  ByteReader(const std::byte* bytes, std::size_t size) : at_(bytes), left_(size) {}

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  std::size_t left() const { return left_; }

 private:
  template <class Value>
  void get(Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    take(&value, sizeof value);
  }
  void get(std::string& text) {
    std::vector<char> letters;
    get(letters);
    text.assign(letters.begin(), letters.end());
  }
  template <class Value>
  void get(std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    std::uint64_t each = 0, count = 0;
    get(each);
    get(count);
    if (each != sizeof(Value)) throw ByteFault("elements of another size");
    if (count > left_ / sizeof(Value)) throw ByteFault("it ends too early");
    values.resize(count);
    take(values.data(), count * sizeof(Value));
  }
  void take(void* to, std::size_t size) {
    if (size > left_) throw ByteFault("it ends too early");
    if (size > 0) std::memcpy(to, at_, size);
    at_ += size;
    left_ -= size;
  }

  const std::byte* at_;
  std::size_t left_;
};

}  // namespace gem
