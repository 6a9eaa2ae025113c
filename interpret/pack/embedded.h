#pragma once

#include <span>
#include <string_view>

namespace oriel::rules {

/// A pack of the folder rules/ that was built into the library (interpret/CMakeLists.txt).
struct EmbeddedPack {
  std::string_view name;
  std::string_view text;
};

/// All of them, sorted by name.
std::span<const EmbeddedPack> embedded();

/// The profiles of the folder rules/profiles/, in the same way.
std::span<const EmbeddedPack> embedded_profiles();

/// The files of the folder rules/starter, by their names, the pack first (starter.h).
std::span<const EmbeddedPack> embedded_starter();

}  // namespace oriel::rules
