#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace oriel {

/// Of each feature the others that a relation leads to: lists of rows, each in ascending order.
/// Features that are related to the same ones, as those of a facade are, share a list, in which
/// they stand themselves; none is its own other.
struct FeatureLinks {
  /// By row: its list, or -1; rows from its end on have none.
  std::vector<int> list_of;
  /// The list l is others[starts[l]] … others[starts[l + 1] - 1].
  std::vector<int> starts{0};
  std::vector<int> others;
  /// Each list holds the features whose list it is, and no more.
  bool are_classes = false;

  [[nodiscard]] std::size_t lists() const { return starts.size() - 1; }
  [[nodiscard]] std::span<const int> list(std::size_t l) const {
    const auto begin = static_cast<std::size_t>(starts[l]);
    return std::span(others).subspan(begin, static_cast<std::size_t>(starts[l + 1]) - begin);
  }
};

/// Every row with each other one of its class, whose number is that of its list; below 0: of none.
/// Takes time and memory for the greatest number, so let them follow each other.
FeatureLinks links_of_classes(std::span<const int> class_of_row);

/// The classes by which `links` relates features, -1 where it relates one to none: if it is the
/// same as links_of_classes() of them; else nothing. O(links).
std::optional<std::vector<int>> classes_of(const FeatureLinks& links);

}  // namespace oriel
