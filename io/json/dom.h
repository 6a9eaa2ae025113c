#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include <simdjson.h>

namespace oriel::detail {

namespace dom = simdjson::dom;

/// Values of a parsed JSON text, nothing where they are absent or of another type.
inline std::optional<dom::element> member(dom::object object, std::string_view key) {
  dom::element value;
  if (object.at_key(key).get(value) != simdjson::SUCCESS) return std::nullopt;
  return value;
}

inline std::optional<dom::object> as_object(const std::optional<dom::element>& element) {
  dom::object value;
  if (!element || element->get(value) != simdjson::SUCCESS) return std::nullopt;
  return value;
}

inline std::optional<dom::array> as_array(const std::optional<dom::element>& element) {
  dom::array value;
  if (!element || element->get(value) != simdjson::SUCCESS) return std::nullopt;
  return value;
}

inline std::optional<std::string_view> as_string(const std::optional<dom::element>& element) {
  std::string_view value;
  if (!element || element->get(value) != simdjson::SUCCESS) return std::nullopt;
  return value;
}

inline std::optional<std::int64_t> as_integer(const std::optional<dom::element>& element) {
  std::int64_t value = 0;
  if (!element || element->get(value) != simdjson::SUCCESS) return std::nullopt;
  return value;
}

inline std::optional<double> as_number(const std::optional<dom::element>& element) {
  double value = 0;
  if (!element || element->get(value) != simdjson::SUCCESS) return std::nullopt;
  return value;
}

/// "an object", "a string", "nothing": what stands where something else was expected.
std::string_view found_kind(const std::optional<dom::element>& element);

}  // namespace oriel::detail
