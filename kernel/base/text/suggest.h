#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace oriel {

bool contains(const std::vector<std::string>& names, std::string_view name);

/// The candidate that `name` was probably meant to be: the least edits (insert, delete, replace,
/// swap neighbours) away, at most a third of the name's length and at least one; the first of
/// equals. Empty if none is near.
std::string nearest(std::string_view name, const std::vector<std::string>& candidates);

/// "; did you mean 'height'?", or nothing. Of an attribute that was called otherwise in earlier
/// packs also what it and its new name mean.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// "a, b, c", in their order.
std::string join(const std::vector<std::string>& names);

}  // namespace oriel
