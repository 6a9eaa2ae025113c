#pragma once

#include <string_view>

namespace oriel::cli {

/// The files of cli/view that make up a page, as they were when the command was built: page.html,
/// page.js and three.min.js.
std::string_view page_html();
std::string_view page_script();
std::string_view three_script();

}  // namespace oriel::cli
