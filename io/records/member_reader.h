#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::detail {

/// Reads the members of one JSON object; the first that does not fit is kept as the finding, with
/// `where`, what the object is. A member that is null counts as absent.
class MemberReader {
 public:
  /// Of `object`, which outlives this.
  MemberReader(const nlohmann::json& object, std::string where)
      : object_(object), where_(std::move(where)) {}

  [[nodiscard]] const std::optional<std::string>& fault() const { return fault_; }

  /// A text; "" where it may be absent and is.
  std::string text(const char* key, bool is_needed) {
    const nlohmann::json* value = find(key, is_needed);
    if (value == nullptr) return "";
    if (value->is_string()) return value->get<std::string>();
    fail(key, "a text");
    return "";
  }

  /// Whole numbers, however many.
  std::vector<int> whole_numbers(const char* key) {
    const nlohmann::json* value = find(key, false);
    std::vector<int> result;
    if (value == nullptr) return result;
    bool is_good = value->is_array();
    for (std::size_t i = 0; is_good && i < value->size(); ++i) {
      is_good = (*value)[i].is_number_integer();
      if (is_good) result.push_back((*value)[i].get<int>());
    }
    if (!is_good) fail(key, "an array of whole numbers");
    return result;
  }

  /// Just so many numbers; `expected` says what they are.
  template <std::size_t Count>
  std::optional<std::array<double, Count>> numbers(const char* key, bool is_needed,
                                                   const char* expected) {
    const nlohmann::json* value = find(key, is_needed);
    if (value == nullptr) return std::nullopt;
    std::array<double, Count> result{};
    bool is_good = value->is_array() && value->size() == Count;
    for (std::size_t i = 0; is_good && i < Count; ++i) {
      is_good = (*value)[i].is_number();
      if (is_good) result[i] = (*value)[i].get<double>();
    }
    if (is_good) return result;
    fail(key, expected);
    return std::nullopt;
  }

  std::optional<bool> yes_no(const char* key) {
    const nlohmann::json* value = find(key, false);
    if (value == nullptr) return std::nullopt;
    if (value->is_boolean()) return value->get<bool>();
    fail(key, "true or false");
    return std::nullopt;
  }

 private:
  /// The member's value; null where it is absent or null.
  const nlohmann::json* find(const char* key, bool is_needed) {
    const auto found = object_.find(key);
    if (found != object_.end() && !found->is_null()) return &*found;
    if (is_needed && !fault_) fault_ = fmt::format("{} has no '{}'", where_, key);
    return nullptr;
  }

  void fail(const char* key, const char* expected) {
    if (!fault_) fault_ = fmt::format("'{}' of {} must be {}", key, where_, expected);
  }

  const nlohmann::json& object_;
  std::string where_;
  std::optional<std::string> fault_;
};

}  // namespace oriel::detail
