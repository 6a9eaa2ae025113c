#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace oriel::detail {

/// The ranks of some planes of one normal class, ascending.
class PlaneRanks {
 public:
  void push_back(int rank) { ranks_.push_back(rank); }
  [[nodiscard]] std::size_t size() const { return ranks_.size(); }
  [[nodiscard]] int operator[](std::size_t i) const { return ranks_[i]; }

  /// To be called once, with the number of planes that the class has: lets before() look up instead
  /// of search, unless these are many more than those asked for.
  void make_table(std::size_t planes_of_class) {
    is_ready_ = true;
    constexpr std::size_t kMany = 8;  // times: then searching costs less than a table
    const std::size_t ranks = 2 * planes_of_class + 2;
    if (ranks > kMany * ranks_.size()) return;
    before_.reserve(ranks);
    for (std::size_t rank = 0, i = 0; rank < ranks; ++rank) {
      while (i < ranks_.size() && ranks_[i] < static_cast<int>(rank)) ++i;
      before_.push_back(static_cast<int>(i));
    }
  }
  [[nodiscard]] bool is_ready() const { return is_ready_; }

  /// How many of the planes have a lesser rank than this, which need not be one of the class.
  [[nodiscard]] std::size_t before(int rank) const {
    if (rank <= 0) return 0;
    const auto place = static_cast<std::size_t>(rank);
    if (place < before_.size()) return static_cast<std::size_t>(before_[place]);
    if (!before_.empty()) return ranks_.size();
    return static_cast<std::size_t>(std::ranges::lower_bound(ranks_, rank) - ranks_.begin());
  }

 private:
  std::vector<int> ranks_;
  std::vector<int> before_;  ///< by rank; empty: to be searched for
  bool is_ready_ = false;
};

}  // namespace oriel::detail
