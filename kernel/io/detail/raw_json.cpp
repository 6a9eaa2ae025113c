#include "kernel/io/detail/raw_json.h"

#include "kernel/io/detail/json_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

#include <nlohmann/json.hpp>

namespace oriel::detail {

namespace {

enum ByteKind : std::uint8_t { other, quote, open, close, separator, space };

constexpr std::array<std::uint8_t, 256> kKinds = [] {
  std::array<std::uint8_t, 256> kinds{};
  kinds['"'] = quote;
  kinds['{'] = kinds['['] = open;
  kinds['}'] = kinds[']'] = close;
  kinds[','] = kinds[':'] = separator;
  kinds[' '] = kinds['\t'] = kinds['\n'] = kinds['\r'] = space;
  return kinds;
}();

ByteKind kind_of(char c) { return static_cast<ByteKind>(kKinds[static_cast<unsigned char>(c)]); }

std::size_t skip_space(std::string_view text, std::size_t at) {
  while (at < text.size() && kind_of(text[at]) == space) ++at;
  return at;
}

/// The offset behind the string whose opening quote is `text[at]`.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const std::size_t start = at + 1;
  for (at = text.find('"', start); at < text.size(); at = text.find('"', at + 1)) {
    std::size_t slashes = 0;
    while (at - slashes > start && text[at - slashes - 1] == '\\') ++slashes;
    if (slashes % 2 == 0) return at + 1;
  }
  return text.size();
}

constexpr std::uint64_t every_byte(std::uint64_t byte) { return byte * 0x0101010101010101ULL; }

/// The high bit of each byte of `word` that is 0.
constexpr std::uint64_t zero_bytes(std::uint64_t word) {
  constexpr std::uint64_t kLow = every_byte(0x7F);
  return ~(((word & kLow) + kLow) | word | kLow);
}

/// The high bit of each of the eight bytes at `bytes` that is a quote or a bracket, the first byte
/// lowest. All four brackets, and no other byte that JSON has outside strings, are 0x7F when bits
/// 1, 2 and 5 are set.
std::uint64_t structural_bytes(const char* bytes) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes, sizeof word);
  if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap64(word);
  return zero_bytes((word | every_byte(0x26)) ^ every_byte(0x7F)) |
         zero_bytes(word ^ every_byte('"'));
}

/// Counts brackets up to the one that closes what was opened.
class DepthCounter {
 public:
  /// Takes a bracket; true if it is the last one. Of brackets only those that open have bit 1.
  bool close_at(char bracket) {
    depth_ += (bracket & 2) - 1;
    return depth_ == 0;
  }

 private:
  int depth_ = 0;
};

/// The offset behind the object or array whose opening bracket is `text[at]`.
std::size_t end_of_container(std::string_view text, std::size_t at) {
  constexpr std::size_t kStep = sizeof(std::uint64_t);
  DepthCounter counter;
  while (at + kStep <= text.size()) {
    std::size_t next = at + kStep;
    for (std::uint64_t found = structural_bytes(&text[at]); found != 0; found &= found - 1) {
      const std::size_t i = at + static_cast<std::size_t>(std::countr_zero(found)) / 8;
      if (text[i] == '"') {
        next = end_of_string(text, i);
        break;
      }
      if (counter.close_at(text[i])) return i + 1;
    }
    at = next;
  }
  for (; at < text.size(); ++at) {
    const ByteKind kind = kind_of(text[at]);
    if (kind == quote)
      at = end_of_string(text, at) - 1;
    else if ((kind == open || kind == close) && counter.close_at(text[at]))
      return at + 1;
  }
  return text.size();
}

}  // namespace

std::size_t end_of_value(std::string_view text, std::size_t at) {
  if (at >= text.size()) return text.size();
  const ByteKind kind = kind_of(text[at]);
  if (kind == quote) return end_of_string(text, at);
  if (kind == open) return end_of_container(text, at);
  while (at < text.size() && kind_of(text[at]) == other) ++at;
  return at;
}

std::string decoded(std::string_view raw) {
  if (raw.size() < 2) return std::string(raw);
  const std::string_view inside = raw.substr(1, raw.size() - 2);
  if (inside.find('\\') == std::string_view::npos) return std::string(inside);
  const nlohmann::json value = nlohmann::json::parse(raw, nullptr, false);
  return value.is_string() ? value.get<std::string>() : std::string(inside);
}

RawNode::RawNode(std::string_view text) : close_(text.front() == '{' ? '}' : ']') {
  std::size_t from = 1;
  std::size_t at = skip_space(text, from);
  inside_ = text.substr(from, at - from);
  while (at < text.size() && kind_of(text[at]) != close) {
    Slot slot;
    if (close_ == '}') {
      const std::size_t key_end = end_of_string(text, at);
      slot.key = text.substr(at, key_end - at);
      at = skip_space(text, std::min(skip_space(text, key_end) + 1, text.size()));
    }
    slot.before = text.substr(from, at - from);
    const std::size_t value_end = end_of_value(text, at);
    slot.value = text.substr(at, value_end - at);
    at = skip_space(text, value_end);
    slot.after = text.substr(value_end, at - value_end);
    slots_.push_back(std::move(slot));
    if (at >= text.size() || text[at] != ',') break;
    from = at + 1;
    at = skip_space(text, from);
  }
}

std::string_view RawNode::value(std::size_t i) const {
  return slots_[i].changed ? std::string_view(*slots_[i].changed) : slots_[i].value;
}

std::string RawNode::key(std::size_t i) const {
  return slots_[i].added_key.empty() ? decoded(slots_[i].key) : slots_[i].added_key;
}

std::optional<std::size_t> RawNode::find(std::string_view key) const {
  const auto has_key = [&](const Slot& slot) {
    if (slot.key.size() < 2) return slot.added_key == key;
    if (slot.key.find('\\') != std::string_view::npos) return decoded(slot.key) == key;
    return slot.key.substr(1, slot.key.size() - 2) == key;
  };
  for (std::size_t i = 0; i < slots_.size(); ++i)
    if (!slots_[i].is_erased && has_key(slots_[i])) return i;
  return std::nullopt;
}

std::string_view RawNode::value_of(std::string_view key) const {
  const auto found = find(key);
  return found ? value(*found) : std::string_view();
}

void RawNode::set(std::string_view key, std::string value) {
  if (const auto found = find(key))
    set(*found, std::move(value));
  else
    append(key, std::move(value));
}

void RawNode::append(std::string_view key, std::string value) {
  push_back(std::move(value));
  slots_.back().added_key = key;
}

void RawNode::push_back(std::string value) {
  slots_.emplace_back();
  slots_.back().changed = std::move(value);
}

void RawNode::erase(std::string_view key) {
  if (const auto found = find(key)) erase(*found);
}

std::string RawNode::text() const {
  std::string result(1, close_ == '}' ? '{' : '[');
  bool is_first = true;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Slot& slot = slots_[i];
    if (slot.is_erased) continue;
    if (!std::exchange(is_first, false)) result += ',';
    if (!slot.added_key.empty()) {
      append_json(result, std::string_view(slot.added_key));
      result += ':';
    }
    result += slot.before;
    result += value(i);
    result += slot.after;
  }
  if (slots_.empty()) result += inside_;
  return result + close_;
}

void for_each_element(std::string_view text, const std::function<void(std::string_view)>& visit) {
  std::size_t at = skip_space(text, 1);
  while (at < text.size() && kind_of(text[at]) != close) {
    const std::size_t end = end_of_value(text, at);
    visit(text.substr(at, end - at));
    at = skip_space(text, end);
    if (at >= text.size() || text[at] != ',') return;
    at = skip_space(text, at + 1);
  }
}

std::vector<std::string_view> elements_of(std::string_view text) {
  std::vector<std::string_view> elements;
  if (RawNode::is_array(text))
    for_each_element(text, [&](std::string_view value) { elements.push_back(value); });
  return elements;
}

}  // namespace oriel::detail
