#pragma once

#include <string_view>

namespace oriel::studio {

/// A file of the page, which is built into the program: "page.html", "studio.js", "studio.css",
/// "view.html" or "licences.txt" (studio/page), or a sample (examples/samples, studio/samples).
/// Empty if there is none of that name, or its bundle was not made.
std::string_view page_file(std::string_view name);

}  // namespace oriel::studio
