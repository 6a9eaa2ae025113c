#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// What kind of name is looked for.
enum class NameKind { attribute, surface_attribute, relation, operation, unit, function };

/// A name that other systems, or plain English, have for one of ours.
struct NameSynonym {
  NameKind kind = NameKind::attribute;
  std::string_view theirs;
  /// Empty: it is no name but is said otherwise, as `note` says.
  std::string_view ours;
  /// What a reader must know besides, or nothing.
  std::string_view note{};
};

/// All of them; in small letters with _ between words.
std::span<const NameSynonym> name_synonyms();

/// `name` as our names are written: small letters, _ between words, no unit at the end: `Height_m`,
/// `baseHeight` and `base-height` become `height` and `base_height`.
std::string normal_name(std::string_view name);

/// What a message says of a name that nothing has: "there is no attribute 'slope'; oriel calls it
/// 'inclination' …", or "unknown attribute 'heigth'; did you mean 'height'?", or where nothing is
/// near "unknown attribute 'colour'" and `otherwise`. `what` is "attribute".
std::string unknown_name(NameKind kind, std::string_view what, std::string_view name,
                         const std::vector<std::string>& candidates, std::string_view otherwise);

}  // namespace oriel::rules
