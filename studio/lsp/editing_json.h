#pragma once

#include "studio/editing/edited_pack.h"
#include "studio/lsp/json_value.h"
#include "studio/session/session.h"

#include <string>
#include <string_view>

namespace oriel::studio {

/// `{"line": 1, "column": 1, "end_line": 1, "end_column": 5}`: from 1, columns in units of UTF-16.
JsonValue range_json(const TextPlaces& places, TextSpan where);

/// The findings of the pack as the verb `pack` answers them: [{code, severity, sentence, advice,
/// line, column, end_line, end_column, fixes: [{title, edits: [{line, …, text}]}]}]. `advice` is
/// what the message suggests, which is taken from `sentence`.
JsonValue findings_json(const EditedPack& pack);

/// The answer to the verb `language`: `{"verb": "complete", "text": …, "line": 1, "column": 1}`,
/// the other verbs are hover, definition, rename (with "name"), format, outline and fixes. `file`
/// is the pack's path. A body that cannot be answered is refused with 400 and a sentence.
Reply answer_language(std::string_view body, const std::string& file);

}  // namespace oriel::studio
