#pragma once

#include <compare>
#include <concepts>
#include <iosfwd>
#include <string>
#include <string_view>

#include <fmt/core.h>

namespace oriel {

/// A text of which there are few and which is said of many: the label of a feature, the id of a
/// rule. It stands in memory once and for the life of the process, so that a copy is a pointer and
/// nothing has to outlive it. Making one of a text takes a lock and is not for loops. Any thread
/// may.
class Name {
 public:
  /// The empty name.
  Name() = default;
  template <std::convertible_to<std::string_view> Text>
  requires(!std::same_as<Text, Name>) Name(const Text& text) : text_(kept(text)) {}

  operator const std::string&() const { return text(); }
  operator std::string_view() const { return text(); }
  [[nodiscard]] const std::string& text() const { return text_ == nullptr ? kEmpty : *text_; }
  [[nodiscard]] bool empty() const { return text_ == nullptr; }
  void clear() { text_ = nullptr; }

  friend bool operator==(Name p, Name q) { return p.text_ == q.text_; }
  friend std::strong_ordering operator<=>(Name p, Name q) { return p.text() <=> q.text(); }
  template <std::convertible_to<std::string_view> Text>
  requires(!std::same_as<Text, Name>) friend bool operator==(Name p, const Text& q) {
    return p.text() == std::string_view(q);
  }

 private:
  static const std::string kEmpty;
  static const std::string* kept(std::string_view text);

  /// Null for the empty one.
  const std::string* text_ = nullptr;
};

std::ostream& operator<<(std::ostream& out, Name name);

}  // namespace oriel

template <>
struct fmt::formatter<oriel::Name> : fmt::formatter<std::string_view> {
  auto format(oriel::Name name, auto& context) const {
    return fmt::formatter<std::string_view>::format(name.text(), context);
  }
};
