#include "io/cityjson/label_members.h"

#include <algorithm>
#include <charconv>

#include <nlohmann/json.hpp>

namespace oriel {

namespace {

bool take(std::string& said, const MemberValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) said = *text;
  return !said.empty();
}

bool take(std::optional<double>& said, const MemberValue& value) {
  if (const auto* number = std::get_if<double>(&value)) said = *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) said = static_cast<double>(*whole);
  return said.has_value();
}

bool take(std::optional<bool>& said, const MemberValue& value) {
  if (const auto* truth = std::get_if<bool>(&value)) said = *truth;
  return said.has_value();
}

bool take(std::vector<std::string>& said, const MemberValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr || text->empty()) return false;
  for (std::size_t start = 0, end = 0; end != std::string::npos; start = end + 1) {
    end = text->find(';', start);
    said.push_back(text->substr(start, end - start));
  }
  return true;
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
