#include "interpret/labelling/group_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace oriel::rules {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Features as rectangles in their facades.
class Rectangles {
 public:
  explicit Rectangles(const FeatureTable& table) {
    using enum Attribute;
    columns_ = {table.numbers(along), table.numbers(width), table.numbers(base_height),
                table.numbers(top)};
  }

  /// NaN where something is missing.
  [[nodiscard]] double distance(FeatureId p, FeatureId q) const {
    const double sideways =
        std::abs(at(kAlong, p) - at(kAlong, q)) - (at(kWidth, p) + at(kWidth, q)) / 2;
    const double upwards = std::abs(middle(p) - middle(q)) - (size(p) + size(q)) / 2;
    if (std::isnan(sideways) || std::isnan(upwards)) return kNone;
    return std::hypot(std::max(0.0, sideways), std::max(0.0, upwards));
  }

 private:
  enum Column { kAlong, kWidth, kBase, kTop };
  [[nodiscard]] double at(Column column, FeatureId id) const {
    return columns_[column][id.index()];
  }
  [[nodiscard]] double middle(FeatureId id) const { return (at(kBase, id) + at(kTop, id)) / 2; }
  [[nodiscard]] double size(FeatureId id) const { return at(kTop, id) - at(kBase, id); }

  std::array<std::span<const double>, 4> columns_;
};

double gap_of(const Group& group, const Rectangles& rectangles, const FeatureGraph& graph) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double gap = kInfinity;
  for (const FeatureId member : group.members)
    for (const FeatureId other : graph.others("same_facade", member)) {
      if (!std::ranges::binary_search(group.members, other)) continue;
      const double distance = rectangles.distance(member, other);
      if (std::isnan(distance)) return kNone;
      gap = std::min(gap, distance);
    }
  return gap < kInfinity ? gap : kNone;
}

}  // namespace

std::vector<double> group_gaps(std::string_view kind, const FeatureTable& table,
                               const FeatureGraph& graph, const Interpretation& interpretation) {
  std::vector<double> gaps(table.rows(), kNone);
  if (table.rows() == 0) return gaps;
  const Rectangles rectangles(table);
  for (const Group& group : interpretation.groups) {
    if (group.kind != kind) continue;
    const double gap = gap_of(group, rectangles, graph);
    for (const FeatureId member : group.members) gaps[member.index()] = gap;
  }
  return gaps;
}

}  // namespace oriel::rules
