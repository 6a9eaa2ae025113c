#pragma once

#include "kernel/base/code.h"

#include <string>
#include <string_view>

namespace oriel {

/// What the documentation says of a code: its section in docs/errors.md or docs/rules.md, or its
/// row in the table of profiles in docs/generalisation.md, as Markdown without the heading. It was
/// built in from those pages. Nothing for Code::none.
std::string_view page_of(Code code);

/// Where that stands: "errors.md".
std::string_view document_of(Code code);

/// The section there, as links name it: "e504-a-scale-that-is-none". Nothing for rows of a table.
std::string anchor_of(Code code);

}  // namespace oriel
