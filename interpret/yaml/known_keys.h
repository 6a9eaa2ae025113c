#pragma once

#include <span>
#include <string_view>

namespace oriel::rules {

/// The keys with a fixed name that packs, profiles and tests have, sorted.
std::span<const std::string_view> known_yaml_keys();

bool is_known_yaml_key(std::string_view word);

}  // namespace oriel::rules
