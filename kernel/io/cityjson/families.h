#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace oriel::detail {

/// A member of "CityObjects" and those it names as parents or children.
struct Relative {
  std::string_view id;
  std::vector<std::string_view> relatives;
};

/// The number of the family of each: connected by parents and children, directly or over others. It
/// is the number of the family's first member. Ids that nobody has connect nothing.
std::vector<std::size_t> families_of(const std::vector<Relative>& members);

}  // namespace oriel::detail
