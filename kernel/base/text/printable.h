#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace oriel {

/// A text of somebody else (an id, a label, the name of a file, a word of a pack) as it may stand
/// in a message, a table or a log that people read. What a terminal would obey or what would look
/// like something else is escaped: control characters as \n, \r, \t or \x1b, those beyond ASCII as
/// \u009b, bytes that are not UTF-8 (RFC 3629) as \xff, the ends of lines and paragraphs U+2028 and
/// U+2029 and all that turns the direction of writing (the property Bidi_Control of Unicode) as
/// \u202e. All else stays as it is, backslashes too: the form is for reading, not for reading back.
std::string printable(std::string_view text);

/// The same of a text of lines: newlines and tabs stay. The words in it must be printable already,
/// else they could forge lines.
std::string printable_lines(std::string_view text);

/// The length of the UTF-8 sequence (RFC 3629) at `text[at]`, 0 if there is none.
std::size_t utf8_length(std::string_view text, std::size_t at);

/// True if printable() leaves the character as it is that begins at `text[at]` and has
/// utf8_length() bytes.
bool is_printable(std::string_view text, std::size_t at);

}  // namespace oriel
