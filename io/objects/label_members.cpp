#include "io/objects/label_members.h"

#include "io/records/record_text.h"

#include <algorithm>
#include <charconv>

#include <nlohmann/json.hpp>

namespace oriel {

namespace {

bool take(std::string& said, const MemberValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) said = *text;
  return !said.empty();
}

template <class Value>
bool take(std::optional<Value>& said, const MemberValue& value) {
  if (const auto* known = std::get_if<Value>(&value)) said = *known;
  if constexpr (std::is_same_v<Value, double>)
    if (const auto* whole = std::get_if<std::int64_t>(&value)) said = static_cast<double>(*whole);
  return said.has_value();
}

bool take(std::vector<std::string>& said, const MemberValue& value) {
  if (const auto* text = std::get_if<std::string>(&value))
    detail::for_each_part(*text, [&](std::string_view id) { said.emplace_back(id); });
  return !said.empty();
}

/// The other way round: what a member of a file says.
void set_member(FeatureLabel& label, std::string_view name, const MemberValue& value) {
  const auto member = std::ranges::find(kLabelMembers, name, &LabelMember::name);
  const bool is_known =
      member != kLabelMembers.end() &&
      std::visit([&](const auto of) { return take(label.*of, value); }, member->of);
  if (!is_known) label.others.emplace_back(name, value);
}

}  // namespace

MemberValue member_value(const nlohmann::ordered_json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  return json.get<std::string>();
}

FeatureLabel label_of(const RawNode& object, std::span<const std::string_view> but) {
  FeatureLabel label;
  for (std::size_t i = 0; i < object.size(); ++i) {
    const std::string name = object.key(i);
    const std::string_view value = object.value(i);
    double number = 0;
    if (std::ranges::find(but, name) != but.end()) continue;
    if (value.starts_with('"'))
      set_member(label, name, decoded(value));
    else if (value == "true" || value == "false")
      set_member(label, name, value == "true");
    else if (std::from_chars(value.data(), value.data() + value.size(), number).ec == std::errc())
      set_member(label, name, number);
  }
  return label;
}

FeatureLabel label_of(const nlohmann::ordered_json& object, std::span<const std::string_view> but) {
  FeatureLabel label;
  for (const auto& [name, value] : object.items())
    if (std::ranges::find(but, name) == but.end()) set_member(label, name, member_value(value));
  return label;
}

}  // namespace oriel
