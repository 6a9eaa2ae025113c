#pragma once

#include "interpret/editing/cursor/word_at.h"
#include "interpret/editing/text_places.h"

#include <string>
#include <vector>

namespace oriel::rules {

/// Why the word can not be renamed, or nothing: only what the top layer alone declares can be.
std::string refuse_renaming(const PackLayers& layers, const PackWord& word);
/// Why it cannot be called `name`, or nothing.
std::string refuse_name(const PackLayers& layers, const PackWord& word, const std::string& name);

/// The places of the top layer of `layers` that name what `word` names, ascending: those in
/// expressions, keys and lists, and of params also `$name` in comments and reasons.
std::vector<TextSpan> places_of(const PackLayers& layers, WordSort sort, const std::string& name);

/// The sort under which the word is declared.
WordSort declared_sort(const PackWord& word);

}  // namespace oriel::rules
