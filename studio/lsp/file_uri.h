#pragma once

#include <string>
#include <string_view>

namespace oriel::studio {

/// The path in a `file:` URI; of another URI the URI itself, under which there is no file.
std::string path_of_uri(std::string_view uri);

/// The `file:` URI of an absolute path.
std::string uri_of_path(std::string_view path);

}  // namespace oriel::studio
