#pragma once

#include "io/json/json_scan.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// The string whose raw form, quotes included, is `raw`, with its escapes resolved.
std::string decoded(std::string_view raw);

/// A JSON object or array as slices of its text, so that members can be changed, added and removed
/// while every other byte stays as it is. Slices point into the text given, which must outlive the
/// node and be valid JSON.
class RawNode {
 public:
  /// `text` starts with '{' or '['; `known` as end_of_value takes it.
  explicit RawNode(std::string_view text, std::span<const std::string_view> known = {});

  static bool is_object(std::string_view text) { return text.starts_with('{'); }
  static bool is_array(std::string_view text) { return text.starts_with('['); }

  /// The number of members or elements, those removed counted too.
  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  /// The key of member `i` with its escapes resolved.
  [[nodiscard]] std::string key(std::size_t i) const;
  /// The value of member or element `i` as it stands now.
  [[nodiscard]] std::string_view value(std::size_t i) const;
  /// The first member with that key.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view key) const;
  /// The value of the first member with that key, or an empty text.
  [[nodiscard]] std::string_view value_of(std::string_view key) const;

  void set(std::size_t i, std::string value);
  /// Replaces the member `key`, or appends it.
  void set(std::string_view key, std::string value);
  /// Puts what became of the value of element `i`, or of the member `key` that is there, in its
  /// place: its text is made once, with that of the whole. value() goes on to give the old one.
  void set(std::size_t i, RawNode value);
  void set(std::string_view key, RawNode value);
  /// Appends an element to an array.
  void push_back(std::string value);
  /// Appends a member to an object that has no such key.
  void append(std::string_view key, std::string value);
  void erase(std::size_t i) { slots_[i].is_erased = true; }
  [[nodiscard]] bool is_erased(std::size_t i) const { return slots_[i].is_erased; }
  /// Erases the member `key` if there is one.
  void erase(std::string_view key);

  /// The object or array with its changes.
  [[nodiscard]] std::string text() const;
  /// Appends it.
  void append_text(std::string& out) const;
  /// Gives it piece by piece.
  void write(const std::function<void(std::string_view)>& sink) const;

 private:
  /// One member: `before` is white space, key and colon, `after` white space up to the comma.
  struct Slot {
    std::string_view before;
    std::string_view key;
    std::string_view value;
    std::string_view after;
    /// The key of a member that was added, unescaped.
    std::string added_key;
    std::optional<std::string> changed;
    /// What is written instead of either.
    std::unique_ptr<RawNode> node;
    bool is_erased = false;
  };
  /// At least as many bytes as text() has, but for what is escaped in keys that were added.
  [[nodiscard]] std::size_t text_size() const;
  template <class Append>
  void visit_pieces(const Append& append) const;

  std::vector<Slot> slots_;
  /// White space of an empty container, else nothing.
  std::string_view inside_;
  char close_;
};

/// Calls `visit` with each element of the array `text`, in order.
void for_each_element(std::string_view text, const std::function<void(std::string_view)>& visit);

/// The elements of the array `text`, in order; none if it is no array.
std::vector<std::string_view> elements_of(std::string_view text);

}  // namespace oriel
