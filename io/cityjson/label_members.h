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

#include <nlohmann/json_fwd.hpp>

namespace oriel {

/// A flat member of a file that says one thing of a label.
struct LabelMember {
  std::string_view name;
  std::variant<std::string FeatureLabel::*, std::optional<double> FeatureLabel::*,
               std::optional<bool> FeatureLabel::*, std::vector<std::string> FeatureLabel::*>
      of;
};

inline constexpr LabelMember kIdMember{"oriel_id", &FeatureLabel::id},
    kNameMember{"oriel_name", &FeatureLabel::name},
    kLabelMember{"oriel_label", &FeatureLabel::label},
    kScoreMember{"oriel_score", &FeatureLabel::score},
    kRuleMember{"oriel_rule", &FeatureLabel::rule}, kWhyMember{"oriel_why", &FeatureLabel::why};

/// All, in the order in which they are written.
inline constexpr std::array kLabelMembers{
    LabelMember{"class", &FeatureLabel::class_code},
    LabelMember{"function", &FeatureLabel::function},
    LabelMember{"oriel_codelist", &FeatureLabel::codelist},
    kIdMember,
    kNameMember,
    kLabelMember,
    LabelMember{"oriel_subclass", &FeatureLabel::subclass},
    kScoreMember,
    kRuleMember,
    LabelMember{"oriel_groups", &FeatureLabel::groups},
    LabelMember{"oriel_parts", &FeatureLabel::parts},
    kWhyMember,
    LabelMember{"oriel_party_wall", &FeatureLabel::is_party_wall},
    LabelMember{"oriel_exposed", &FeatureLabel::exposed},
    LabelMember{"oriel_faces", &FeatureLabel::faces}};

/// Calls visit(name, value) with each member that a label has: first those that a file had besides.
template <class Visit>
void for_each_member(const FeatureLabel& label, const Visit& visit) {
  for (const auto& [name, value] : label.others)
    std::visit([&](const auto& known) { visit(std::string_view(name), known); }, value);
  const auto visit_said = [&](std::string_view name, const auto& said) {
    using Said = std::decay_t<decltype(said)>;
    if constexpr (std::is_same_v<Said, std::vector<std::string>>) {
      std::string ids;
      for (const std::string& id : said) ids += (ids.empty() ? "" : ";") + id;
      if (!ids.empty()) visit(name, ids);
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
