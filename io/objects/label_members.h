#pragma once

#include "io/json/raw_json.h"
#include "model/labelled_building.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/ranges.h>
#include <nlohmann/json_fwd.hpp>

namespace oriel {

/// A flat member of a file that says one thing of a label.
struct LabelMember {
  std::string_view name;
  std::variant<std::string FeatureLabel::*, std::optional<double> FeatureLabel::*,
               std::optional<bool> FeatureLabel::*, std::vector<std::string> FeatureLabel::*>
      of;
};

inline constexpr std::string_view kIdMember = "oriel_id", kNameMember = "oriel_name",
                                  kLabelMember = "oriel_label", kScoreMember = "oriel_score",
                                  kRuleMember = "oriel_rule", kWhyMember = "oriel_why";

/// All, in the order in which they are written.
inline constexpr std::array<LabelMember, 15> kLabelMembers{
    {{"class", &FeatureLabel::class_code},
     {"function", &FeatureLabel::function},
     {"oriel_codelist", &FeatureLabel::codelist},
     {kIdMember, &FeatureLabel::id},
     {kNameMember, &FeatureLabel::name},
     {kLabelMember, &FeatureLabel::label},
     {"oriel_subclass", &FeatureLabel::subclass},
     {kScoreMember, &FeatureLabel::score},
     {kRuleMember, &FeatureLabel::rule},
     {"oriel_groups", &FeatureLabel::groups},
     {"oriel_parts", &FeatureLabel::parts},
     {kWhyMember, &FeatureLabel::why},
     {"oriel_party_wall", &FeatureLabel::is_party_wall},
     {"oriel_exposed", &FeatureLabel::exposed},
     {"oriel_faces", &FeatureLabel::faces}}};

/// Calls visit(name, value) with each member that a label has: first those that a file had besides.
template <class Visit>
void for_each_member(const FeatureLabel& label, const Visit& visit) {
  for (const auto& [name, value] : label.others)
    std::visit([&](const auto& known) { visit(std::string_view(name), known); }, value);
  const auto visit_said = [&](std::string_view name, const auto& said) {
    using Said = std::decay_t<decltype(said)>;
    if constexpr (std::is_same_v<Said, std::vector<std::string>>) {
      if (!said.empty()) visit(name, fmt::format("{}", fmt::join(said, ";")));
    } else if constexpr (std::is_same_v<Said, std::string>) {
      if (!said.empty()) visit(name, said);
    } else if (said) {
      visit(name, *said);
    }
  };
  for (const LabelMember& member : kLabelMembers)
    std::visit([&](const auto of) { visit_said(member.name, label.*of); }, member.of);
}

/// A flat value; throws a nlohmann::json::type_error for any other.
MemberValue member_value(const nlohmann::ordered_json& json);

/// Members of semantic surfaces, and attributes of installations, that are none of their labels.
inline constexpr std::array<std::string_view, 3> kSurfaceMembers{"type", "parent", "children"};
inline constexpr std::array<std::string_view, 1> kInstallationMembers{"oriel_geometry"};

/// What the members of an object say, but for these. Values that are not flat are none of a label.
FeatureLabel label_of(const RawNode& object, std::span<const std::string_view> but);
/// They throw as in member_value().
FeatureLabel label_of(const nlohmann::ordered_json& object,
                      std::span<const std::string_view> but = {});

}  // namespace oriel
