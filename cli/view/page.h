#pragma once

#include <string>

namespace oriel::cli {

/// One HTML file that shows `data` (PageData::json) and loads nothing: page.html with the data and
/// both scripts in their places.
std::string page_of(const std::string& data);

}  // namespace oriel::cli
