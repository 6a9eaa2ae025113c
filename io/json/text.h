#pragma once

#include "kernel/base/issue.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace oriel {

/// Where a text comes from: a file, and for a line of a CityJSONSeq the line's number (else 0).
struct TextName {
  std::string file;
  int line = 0;
};

/// A finding without its place: what a reader of a part says to the one that knows where it is.
struct Fault {
  Code code = Code::none;
  std::string sentence;
};

/// An error at byte `offset` of `text`: line and column (bytes, from 1), and the line with a caret.
/// Long lines are cut around the place.
Issue error_at(const TextName& name, std::string_view text, std::size_t offset, Fault fault);

/// An error in the text as a whole.
Issue error_in(const TextName& name, Fault fault);

/// A finding of one building.
Issue finding_of(const TextName& name, Severity severity, std::string_view building, Fault fault);

/// The offset of the first byte that is not UTF-8 (RFC 3629), or nothing.
std::optional<std::size_t> find_non_utf8(std::string_view text);

/// `text` without a byte order mark at its start.
std::string_view without_bom(std::string_view text);

/// Calls act(line, number) for each line of a text that is not blank; lines count from 1.
template <class Act>
void for_each_line(std::string_view text, Act act) {
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.find_first_not_of(" \t\r") != std::string_view::npos) act(line, number);
  }
}

/// `text` as it may stand in a message: printable(), in single quotes, cut after 40 bytes.
std::string in_quotes(std::string_view text);

}  // namespace oriel
