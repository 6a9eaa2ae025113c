#pragma once

#include "studio/editing/edited_pack.h"
#include "studio/lsp/documents.h"
#include "studio/lsp/json_value.h"

#include <string>
#include <vector>

namespace oriel::studio {

/// Values of the Language Server Protocol. Its lines and columns count from 0, in units of UTF-16.

JsonValue position_json(TextPlace place);
JsonValue protocol_range(const TextPlaces& places, TextSpan where);
/// Throws nlohmann::json::exception if it is no position.
TextPlace place_of_position(const JsonValue& position);

/// Edits of one file, `uri`, as a WorkspaceEdit has them.
JsonValue edits_json(const TextPlaces& places, const std::vector<TextEdit>& edits);

/// A finding, with a link to the page of its code if `docs_url` is not empty.
JsonValue diagnostic_json(const EditedPack& pack, const TextFinding& finding,
                          const std::string& docs_url);

JsonValue completion_json(const EditedPack& pack, std::size_t offset);

/// Sections with what is in them; flat, as SymbolInformation, for clients that know no tree.
JsonValue symbols_json(const EditedPack& pack, const std::string& uri, bool is_tree);

/// The change that makes `before` to `after`, in whole lines; nothing if they are the same.
std::vector<TextEdit> changed_lines(const std::string& before, const std::string& after);

}  // namespace oriel::studio
