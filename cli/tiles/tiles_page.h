#pragma once

#include <string_view>

namespace oriel::cli {

/// The page that shows the tileset beside it (page/README.md).
std::string_view tiles_page();

}  // namespace oriel::cli
