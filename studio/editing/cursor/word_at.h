#pragma once

#include "studio/editing/layers.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// The word of the top layer's text that `offset` is in, or just after; also on a line that cannot
/// be read as it stands.
std::optional<PackWord> word_at(const PackLayers& layers, std::size_t offset);

/// The declaration that the word means; null for what is built in or nowhere declared.
const DeclaredName* declaration_of(const PackLayers& layers, const PackWord& word);

/// True if both words name the same thing.
bool is_same_name(const PackLayers& layers, const PackWord& word, WordSort sort,
                  std::string_view name);

/// What can be said of the word, and below it where it is declared; empty if nothing is known.
std::string hover_text(const PackLayers& layers, const PackWord& word);

/// What the schema says of the key at `offset` of the top layer, and where the key is.
struct KeyText {
  SourceSpan span{};
  std::string text{};
};
std::optional<KeyText> key_text(const PackLayers& layers, std::size_t offset);

}  // namespace oriel::rules
