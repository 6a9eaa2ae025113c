#pragma once

#include <string_view>

namespace oriel::rules {

/// True for the keys with a fixed name that packs, profiles and tests have, but for letters: those
/// are attributes, too, and stand in texts.
bool is_known_yaml_key(std::string_view word);

}  // namespace oriel::rules
