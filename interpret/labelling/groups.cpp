#include "interpret/labelling/groups.h"

#include "kernel/base/index.h"
#include "kernel/geometry/disjoint_sets.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace oriel::rules {

namespace {

/// An id with its first bytes, by which two are nearly always told apart.
class ComparedId {
 public:
  explicit ComparedId(const std::string& id) : id_(&id), head_(head_of(id)) {}
  [[nodiscard]] const std::string& text() const { return *id_; }
  [[nodiscard]] bool operator<(const ComparedId& other) const {
    return head_ != other.head_ ? head_ < other.head_ : *id_ < *other.id_;
  }

 private:
  /// The first eight bytes as a number, so that numbers are in the order of texts.
  static std::uint64_t head_of(const std::string& id) {
    constexpr std::size_t kBytes = 8;
    const std::size_t size = std::min(id.size(), kBytes);
    std::uint64_t head = 0;
    for (std::size_t i = 0; i < size; ++i) head = head << 8U | static_cast<unsigned char>(id[i]);
    return size == 0 ? 0 : head << 8U * (kBytes - size);
  }

  const std::string* id_;
  std::uint64_t head_;
};

/// Of which building a row is. Rows are looked for in ascending order.
class OwnerOfRow {
 public:
  explicit OwnerOfRow(std::span<const FeaturesOfBuilding> buildings)
      : buildings_(buildings), end_(static_cast<int>(buildings.front().table->rows())) {}

  void find(int row) {
    while (row >= end_) {
      begin_ = end_;
      end_ += static_cast<int>(buildings_[++number_].table->rows());
    }
  }
  [[nodiscard]] std::size_t number() const { return number_; }
  [[nodiscard]] const FeatureTable& table() const { return *buildings_[number_].table; }
  /// A row as the building counts it.
  [[nodiscard]] FeatureId own(FeatureId row) const { return FeatureId{row.value - begin_}; }

 private:
  std::span<const FeaturesOfBuilding> buildings_;
  std::size_t number_ = 0;
  int begin_ = 0;
  int end_;
};

/// The members of one group among those of all, with the smallest of their ids, which names it.
struct Cluster {
  std::size_t building;
  ComparedId id;
  std::size_t first, size;
};

/// What hangs together of one kind, building by building.
class Clusters {
 public:
  explicit Clusters(std::span<const FeaturesOfBuilding> buildings) : owner_(buildings) {}

  std::vector<FeatureId> members;
  std::vector<Cluster> list;

  /// Members from `first` on are one. Needs a member.
  void add(std::size_t first) {
    owner_.find(members[first].value);
    for (std::size_t i = first; i < members.size(); ++i) members[i] = owner_.own(members[i]);
    const FeatureTable& table = owner_.table();
    ComparedId smallest(table.id(members[first]));
    for (std::size_t i = first + 1; i < members.size(); ++i)
      smallest = std::min(smallest, ComparedId(table.id(members[i])));
    list.push_back({owner_.number(), smallest, first, members.size() - first});
  }
  [[nodiscard]] std::span<const FeatureId> members_of(const Cluster& cluster) const {
    return std::span(members).subspan(cluster.first, cluster.size);
  }

 private:
  OwnerOfRow owner_;
};

/// The members of each class hang together, if they are so many.
Clusters clusters_of_classes(const Links& links, std::size_t least, auto is_member,
                             std::span<const FeaturesOfBuilding> buildings) {
  Clusters clusters(buildings);
  clusters.members.reserve(links.lists->others.size());
  clusters.list.reserve(links.lists->lists());
  const bool are_certain = links.are_all_certain();
  for (std::size_t l = 0; l < links.lists->lists(); ++l) {
    const std::size_t first = clusters.members.size();
    for (const int row : links.lists->list(l))
      if (is_member(row) && (are_certain || links.is_certain(row)))
        clusters.members.push_back(FeatureId{row});
    if (clusters.members.size() - first >= least)
      clusters.add(first);
    else
      clusters.members.resize(first);
  }
  return clusters;
}

/// Members that pairs of members lead to hang together, if they are so many.
Clusters clusters_of_pairs(const EvaluationContext& context, const Links& links, std::size_t least,
                           auto is_member, std::span<const FeaturesOfBuilding> buildings) {
  oriel::detail::DisjointSets sets(context.rows);
  for (const int row : context.row_numbers) {
    if (!is_member(row)) continue;
    const auto [begin, end] = links.range_of(row);
    for (std::size_t link = begin; link < end; ++link)
      if (links.is_other(row, link) == Truth::yes && is_member(links.other(link)))
        sets.unite(row, links.other(link));
  }
  std::vector<std::vector<FeatureId>> members_of(context.rows);  // by root
  for (const int row : context.row_numbers)
    if (is_member(row)) members_of[at(sets.find(row))].push_back(FeatureId{row});
  Clusters clusters(buildings);
  for (const auto& members : members_of) {
    if (members.size() < least) continue;
    const std::size_t first = clusters.members.size();
    clusters.members.insert(clusters.members.end(), members.begin(), members.end());
    clusters.add(first);
  }
  return clusters;
}

Clusters clusters_of(const GroupKind& kind, const EvaluationContext& context,
                     std::span<const FeaturesOfBuilding> buildings) {
  const auto& members = context.membership[at(kind.of)];
  const Links& links = context.relations[at(kind.by)];
  const auto is_member = [&](int row) { return members[at(row)] == Truth::yes; };
  const auto least = std::max<std::size_t>(1, at(kind.at_least));
  if (links.lists->are_classes) return clusters_of_classes(links, least, is_member, buildings);
  return clusters_of_pairs(context, links, least, is_member, buildings);
}

/// Of one building and one kind, sorted by what names them.
void add_groups(const GroupKind& kind, const Clusters& all, std::span<Cluster> clusters,
                std::vector<Group>& groups) {
  std::ranges::sort(clusters, [](const auto& p, const auto& q) { return p.id < q.id; });
  groups.reserve(groups.size() + clusters.size());
  const std::string prefix = kind.name + ".";
  for (const Cluster& cluster : clusters) {
    const auto members = all.members_of(cluster);
    groups.push_back({prefix + cluster.id.text(), kind.name, {members.begin(), members.end()}});
  }
}

}  // namespace

std::vector<std::vector<Group>> find_groups(const Pack& pack, const EvaluationContext& context,
                                            std::span<const FeaturesOfBuilding> buildings) {
  std::vector<std::vector<Group>> groups(buildings.size());
  if (context.rows == 0) return groups;
  for (const GroupKind& kind : pack.groups) {
    Clusters all = clusters_of(kind, context, buildings);
    for (auto begin = all.list.begin(); begin != all.list.end();) {
      const std::size_t building = begin->building;
      const auto end = std::find_if(begin, all.list.end(),
                                    [&](const Cluster& c) { return c.building != building; });
      add_groups(kind, all, {begin, end}, groups[building]);
      begin = end;
    }
  }
  return groups;
}

}  // namespace oriel::rules
