#include "interpret/labelling/groups.h"

#include "kernel/base/index.h"
#include "kernel/geometry/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <utility>

namespace oriel::rules {

namespace {

using Cluster = std::vector<FeatureId>;

/// The members of each class of the relation.
std::vector<Cluster> members_of_classes(const Links& links, auto is_member) {
  std::vector<Cluster> clusters;
  for (std::size_t l = 0; l < links.lists->lists(); ++l) {
    Cluster& members = clusters.emplace_back();
    for (const int row : links.lists->list(l))
      if (is_member(row) && links.is_certain(row)) members.push_back(FeatureId{row});
  }
  return clusters;
}

/// Members that pairs of members connect.
std::vector<Cluster> connected_members(const EvaluationContext& context, const Links& links,
                                       auto is_member) {
  oriel::DisjointSets sets(context.rows);
  for (const int row : context.row_numbers) {
    if (!is_member(row)) continue;
    const auto [begin, end] = links.range_of(row);
    for (std::size_t link = begin; link < end; ++link)
      if (links.is_other(row, link) == Truth::yes && is_member(links.other(link)))
        sets.unite(row, links.other(link));
  }
  std::vector<Cluster> by_root(context.rows);
  for (const int row : context.row_numbers)
    if (is_member(row)) by_root[oriel::at(sets.find(row))].push_back(FeatureId{row});
  return by_root;
}

std::vector<Cluster> clusters_of(const GroupKind& kind, const EvaluationContext& context) {
  const auto& members = context.membership[oriel::at(kind.of)];
  const Links& links = context.relations[oriel::at(kind.by)];
  const auto is_member = [&](int row) { return members[oriel::at(row)] == Truth::yes; };
  auto clusters = links.lists->are_classes ? members_of_classes(links, is_member)
                                           : connected_members(context, links, is_member);
  const std::size_t least = std::max<std::size_t>(1, oriel::at(kind.at_least));
  std::erase_if(clusters, [&](const Cluster& cluster) { return cluster.size() < least; });
  return clusters;
}

/// Named by the smallest id of its members.
Group group_of(const GroupKind& kind, Cluster members, const FeatureTable& table) {
  const auto id_of = [&](FeatureId member) -> const std::string& { return table.id(member); };
  const FeatureId first = *std::ranges::min_element(members, {}, id_of);
  return {kind.name + "." + table.id(first), kind.name, std::move(members)};
}

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
  constexpr double kFurthest = std::numeric_limits<double>::infinity();
  double gap = kFurthest;
  for (const FeatureId member : group.members)
    for (const FeatureId other : graph.others("same_facade", member)) {
      if (!std::ranges::binary_search(group.members, other)) continue;
      const double distance = rectangles.distance(member, other);
      if (std::isnan(distance)) return kNone;
      gap = std::min(gap, distance);
    }
  return gap < kFurthest ? gap : kNone;
}

}  // namespace

std::vector<Group> find_groups(const Pack& pack, const EvaluationContext& context,
                               const FeatureTable& table) {
  std::vector<Group> groups;
  if (context.rows == 0) return groups;
  for (const GroupKind& kind : pack.groups) {
    std::vector<Group> found;
    for (Cluster& members : clusters_of(kind, context))
      found.push_back(group_of(kind, std::move(members), table));
    std::ranges::sort(found, {}, &Group::id);
    std::ranges::move(found, std::back_inserter(groups));
  }
  return groups;
}

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
