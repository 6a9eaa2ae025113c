#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace oriel {

struct CityValue;
/// Members of an object in their order.
using CityMembers = std::vector<std::pair<std::string, CityValue>>;
using CityList = std::vector<CityValue>;

/// A value of an attribute: nothing, yes or no, a number, a text, a list, or a set of values.
struct CityValue {
  std::variant<std::monostate, bool, std::int64_t, double, std::string, CityList, CityMembers>
      value;

  template <class T>
  [[nodiscard]] const T* get() const {
    return std::get_if<T>(&value);
  }
};

/// The member's value, or null.
const CityValue* member_of(const CityMembers& members, std::string_view name);
/// The member's text, or empty.
std::string_view member_text(const CityMembers& members, std::string_view name);

/// Appends the value as JSON.
void append_json(std::string& out, const CityValue& value);

}  // namespace oriel
