#include "kernel/neighbours/detached_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace oriel {

namespace {

constexpr std::size_t kShortestRow = 4;
constexpr double kLikeArea = 1.5;
constexpr double kLikeDistance = 1.25;
constexpr double kFarthest = 3;       // sides of its ground
constexpr double kStraight = 0.9659;  // the cosine of 15 degrees

/// What stands beside a building in a row: none if it stands in none, or at an end.
using Beside = std::optional<std::array<std::size_t, 2>>;

class RowFinder {
 public:
  RowFinder(const NeighbourSearch& search, double like_height_m,
            const std::function<bool(std::size_t)>& is_candidate)
      : search_(search), like_height_m_(like_height_m), is_candidate_(is_candidate) {
    for (const StandingBuilding& building : search.buildings()) {
      const Vec3 middle = 0.5 * (building.box.min + building.box.max) + building.origin_m;
      middles_.push_back({middle.x, middle.y, 0});
    }
  }

  std::vector<DetachedRow> run() {
    for (std::size_t i = 0; i < search_.size(); ++i) {
      near_.push_back(alike_near(i));
      beside_.push_back(densest_pair(i));
    }
    links_.resize(search_.size());
    std::vector<std::size_t> order(search_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::erase_if(order, [&](std::size_t i) { return !beside_[i]; });
    std::ranges::stable_sort(order, {}, [&](std::size_t i) {
      return distance_m(i, (*beside_[i])[0]) + distance_m(i, (*beside_[i])[1]);
    });
    for (const std::size_t i : order)
      for (const std::size_t k : *beside_[i]) link(i, k);
    return rows();
  }

 private:
  [[nodiscard]] const StandingBuilding& at(std::size_t i) const { return search_.buildings()[i]; }
  [[nodiscard]] double distance_m(std::size_t i, std::size_t k) const {
    return length(middles_[k] - middles_[i]);
  }
  [[nodiscard]] double height_m(std::size_t i) const { return at(i).roof_m - at(i).ground_m; }

  [[nodiscard]] bool are_alike(std::size_t i, std::size_t k) const {
    const double least_m2 = std::min(at(i).ground_m2, at(k).ground_m2);
    return at(i).system == at(k).system && least_m2 > 0 &&
           std::max(at(i).ground_m2, at(k).ground_m2) <= kLikeArea * least_m2 &&
           std::abs(height_m(i) - height_m(k)) <= like_height_m_ &&
           distance_m(i, k) <= kFarthest * std::sqrt(least_m2);
  }

  [[nodiscard]] std::vector<std::size_t> alike_near(std::size_t i) const {
    std::vector<std::size_t> out;
    if (!is_candidate_(i) || !(at(i).ground_m2 > 0)) return out;
    for (const std::size_t k : search_.near(i, kFarthest * std::sqrt(at(i).ground_m2)))
      if (is_candidate_(k) && are_alike(i, k)) out.push_back(k);
    return out;
  }

  [[nodiscard]] Beside densest_pair(std::size_t i) const {
    Beside best;
    double best_m = Box::kInfinity;
    const auto& near = near_[i];
    for (std::size_t a = 0; a < near.size(); ++a)
      for (std::size_t b = a + 1; b < near.size(); ++b) {
        const double sum_m = distance_m(i, near[a]) + distance_m(i, near[b]);
        if (sum_m >= best_m || !is_straight(near[a], i, near[b])) continue;
        best = {near[a], near[b]};
        best_m = sum_m;
      }
    return best;
  }

  [[nodiscard]] bool is_straight(std::size_t p, std::size_t i, std::size_t q) const {
    const double p_m = distance_m(i, p), q_m = distance_m(i, q);
    return std::min(p_m, q_m) > 0 && std::max(p_m, q_m) <= kLikeDistance * std::min(p_m, q_m) &&
           dot(middles_[p] - middles_[i], middles_[q] - middles_[i]) <= -kStraight * p_m * q_m;
  }

  /// Whether a building has another one beside it already, or may have it.
  [[nodiscard]] bool has_room(std::size_t i, std::size_t k) const {
    return links_[i].empty() || (links_[i].size() == 1 && is_straight(links_[i][0], i, k));
  }

  /// Where both have room; the densest come first.
  void link(std::size_t i, std::size_t k) {
    if (std::ranges::count(links_[i], k) > 0 || !has_room(i, k) || !has_room(k, i)) return;
    links_[i].push_back(k);
    links_[k].push_back(i);
  }

  /// Rings have no ends and stay.
  [[nodiscard]] std::vector<DetachedRow> rows() const {
    std::vector<DetachedRow> out;
    std::vector<char> is_taken(links_.size(), 0);
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (links_[i].size() != 1 || is_taken[i] != 0) continue;
      DetachedRow row{i};
      is_taken[i] = 1;
      for (bool goes_on = true; goes_on;) {
        goes_on = false;
        for (const std::size_t next : links_[row.back()]) {
          if (is_taken[next] != 0) continue;
          is_taken[next] = 1;
          row.push_back(next);
          goes_on = true;
          break;
        }
      }
      if (row.size() >= kShortestRow) out.push_back(std::move(row));
    }
    return out;
  }

  const NeighbourSearch& search_;
  double like_height_m_;
  const std::function<bool(std::size_t)>& is_candidate_;
  std::vector<Vec3> middles_;  ///< in the input's coordinates, z = 0
  std::vector<std::vector<std::size_t>> near_, links_;
  std::vector<Beside> beside_;
};

}  // namespace

std::vector<DetachedRow> detached_rows(const NeighbourSearch& search, double like_height_m,
                                       const std::function<bool(std::size_t)>& is_candidate) {
  return RowFinder(search, like_height_m, is_candidate).run();
}

}  // namespace oriel
