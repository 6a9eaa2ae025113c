#pragma once

#include <functional>
#include <optional>
#include <string>

namespace oriel::studio {

/// The bytes of a regular file; nothing if there is none.
std::optional<std::string> read_text_file(const std::string& path);

/// Replaces a file by what `change` makes of its present bytes (nothing: there is no file), while
/// no other studio can save in its folder; returns the new bytes. What `change` throws leaves the
/// file as it is. Throws RefusedRequest: 409 if another studio keeps saving there, 500 if the file
/// cannot be written.
std::string save_file(
    const std::string& path,
    const std::function<std::string(const std::optional<std::string>& on_disk)>& change);

}  // namespace oriel::studio
