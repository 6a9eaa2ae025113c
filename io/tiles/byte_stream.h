#pragma once

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace oriel::detail {

/// Values, lists and texts one behind the other, as this machine has them.
class ByteWriter {
 public:
  template <class Value>
  void put(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    put_block(&value, sizeof value);
  }
  template <class Value>
  void put(const std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    put(values.size());
    put_block(values.data(), values.size() * sizeof(Value));
  }
  void put(const std::string& text) {
    put(text.size());
    bytes_ += text;
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  void put_block(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }

  std::string bytes_;
};

/// Reads them in the same order. Throws std::runtime_error where they end too early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  template <class Value>
  void get(Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
  }
  template <class Value>
  void get(std::vector<Value>& values) {
    const std::size_t size = count(sizeof(Value));
    values.resize(size);
    if (size > 0)
      std::memcpy(values.data(), take(size * sizeof(Value)).data(), size * sizeof(Value));
  }
  void get(std::string& text) { text = take(count(1)); }
  /// How many items follow, of `least_size` bytes at least.
  [[nodiscard]] std::size_t count(std::size_t least_size) {
    std::size_t size = 0;
    get(size);
    if (size > left_.size() / least_size) end_too_early();
    return size;
  }
  [[nodiscard]] bool is_at_end() const { return left_.empty(); }

 private:
  [[noreturn]] static void end_too_early() {
    throw std::runtime_error("bytes of a building end too early");
  }
  std::string_view take(std::size_t size) {
    if (size > left_.size()) end_too_early();
    const std::string_view taken = left_.substr(0, size);
    left_.remove_prefix(size);
    return taken;
  }

  std::string_view left_;
};

}  // namespace oriel::detail
