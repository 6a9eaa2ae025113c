#include "io/objects/city_value.h"

#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <type_traits>

namespace oriel {

const CityValue* member_of(const CityMembers& members, std::string_view name) {
  const auto found = std::ranges::find(members, name, &CityMembers::value_type::first);
  return found == members.end() ? nullptr : &found->second;
}

std::string_view member_text(const CityMembers& members, std::string_view name) {
  const CityValue* value = member_of(members, name);
  const std::string* text = value == nullptr ? nullptr : value->get<std::string>();
  return text == nullptr ? std::string_view() : std::string_view(*text);
}

void append_json(std::string& out, const CityValue& value) {
  if (const auto* list = value.get<CityList>()) {
    append_json_array(out, *list);
  } else if (const auto* members = value.get<CityMembers>()) {
    out += '{';
    for (const auto& [key, inner] : *members) {
      append_json_key(out, key);
      append_json(out, inner);
    }
    out += '}';
  } else if (const auto* text = value.get<std::string>()) {
    append_json(out, std::string_view(*text));
  } else if (const auto* whole = value.get<std::int64_t>()) {
    append_json(out, *whole);
  } else if (const auto* number = value.get<double>()) {
    append_json(out, *number);
  } else if (const auto* truth = value.get<bool>()) {
    append_json(out, *truth);
  } else {
    out += "null";
  }
}

}  // namespace oriel
