#pragma once

#include <string>
#include <string_view>

namespace oriel::detail {

/// `<name>text</name>` with a line end; `attributes` stand behind the name as they are, with the
/// blank before them.
void append_element(std::string& out, std::string_view name, std::string_view text,
                    std::string_view attributes = "");

/// The start of ids that the writer makes itself; xml_id() gives none with it.
inline constexpr std::string_view kMadeId = "oriel.";

/// The id as a gml:id, which is an NCName: every character that none can have there is written as
/// _xHHHH_, its number in hexadecimal, and so is an underscore that would read as the start of such
/// a one. Different ids stay different, and xml_id_source() gives them back. What is not UTF-8
/// counts as U+FFFD.
std::string xml_id(std::string_view id);
std::string xml_id_source(std::string_view xml_id);

}  // namespace oriel::detail
