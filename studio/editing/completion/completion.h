#pragma once

#include "studio/editing/layers.h"
#include "studio/editing/text_places.h"

#include <cstddef>
#include <string>
#include <vector>

namespace oriel {

/// What can be written at a place.
struct Completion {
  std::string label{};
  /// "attribute", "param", "class", "predicate", "macro", "relation", "group", "rule", "fixture",
  /// "pack", "operator", "function", "unit", "value", "word" or "key".
  std::string kind{};
  std::string detail{};
  std::string documentation{};
  /// What replaces the text at `replaced`.
  std::string insert{};
  TextSpan replaced{};
};

namespace rules {

/// What can be written at `offset` of the top layer's text, the most likely first.
std::vector<Completion> completions_at(const PackLayers& layers, std::size_t offset);

/// The same inside an expression that stands at `place`: `written` is what is written of it up to
/// `offset`.
void complete_expression(const PackLayers& layers, YamlPlace place, const std::string& written,
                         std::size_t offset, std::vector<Completion>& completions);

/// What a declared name is completed to.
Completion completion_of(const DeclaredName& declared, TextSpan replaced);

/// Adds names of that sort, each once.
void add_declared(const PackLayers& layers, WordSort sort, TextSpan replaced,
                  std::vector<Completion>& completions);

}  // namespace rules

}  // namespace oriel
