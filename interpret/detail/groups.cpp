#include "interpret/detail/groups.h"

#include "kernel/model/detail/index.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace oriel::rules {

namespace {

/// Sets of rows that are joined pair by pair.
class DisjointRows {
 public:
  explicit DisjointRows(std::size_t rows) : parents_(rows) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }
  int find(int row) {
    while (parents_[at(row)] != row) row = parents_[at(row)] = parents_[at(parents_[at(row)])];
    return row;
  }
  /// Joins the set with the root `root` and that of `row`; returns their root. The smaller one
  /// stays, so that paths end at the first member.
  int join(int root, int row) {
    const int other = find(row);
    const int first = std::min(root, other);
    parents_[at(std::max(root, other))] = first;
    return first;
  }

 private:
  std::vector<int> parents_;
};

using MemberLists = std::vector<std::vector<FeatureId>>;

/// The members of each class hang together, if they are so many.
MemberLists components_of_classes(const Links& links, std::size_t least, auto is_member) {
  MemberLists components;
  components.reserve(links.lists->lists());
  std::vector<FeatureId> members;
  const bool are_certain = links.are_all_certain();
  for (std::size_t l = 0; l < links.lists->lists(); ++l) {
    members.clear();
    for (const int row : links.lists->list(l))
      if (is_member(row) && (are_certain || links.is_certain(row)))
        members.push_back(FeatureId{row});
    if (members.size() >= least) components.push_back(members);
  }
  return components;
}

/// Members that pairs of members lead to hang together.
MemberLists components_of_pairs(const Facts& facts, const Links& links, auto is_member) {
  DisjointRows sets(facts.rows);
  for (const int row : facts.row_numbers) {
    if (!is_member(row)) continue;
    int root = sets.find(row);
    const auto [begin, end] = links.range_of(row);
    for (std::size_t link = begin; link < end; ++link)
      if (links.is_other(row, link) == Truth::yes && is_member(links.other(link)))
        root = sets.join(root, links.other(link));
  }
  // The root is the first member.
  std::vector<int> component_of(facts.rows, -1);
  MemberLists components;
  for (const int row : facts.row_numbers) {
    if (!is_member(row)) continue;
    int& component = component_of[at(sets.find(row))];
    if (component < 0) {
      component = static_cast<int>(components.size());
      components.emplace_back();
    }
    components[at(component)].push_back(FeatureId{row});
  }
  return components;
}

/// The members of every component of one kind.
MemberLists components_of(const GroupKind& kind, const Facts& facts) {
  const auto& members = facts.membership[at(kind.of)];
  const Links& links = facts.relations[at(kind.by)];
  const auto is_member = [&](int row) { return members[at(row)] == Truth::yes; };
  const auto least = std::max<std::size_t>(1, at(kind.at_least));
  if (links.lists->are_classes) return components_of_classes(links, least, is_member);
  MemberLists components = components_of_pairs(facts, links, is_member);
  std::erase_if(components, [&](const auto& rows) { return rows.size() < least; });
  return components;
}

/// The smallest id of the members, which names them.
const std::string& id_of(const std::vector<FeatureId>& members, const FeatureTable& table) {
  const std::string* first = &table.id(members.front());
  for (const FeatureId member : members)
    if (table.id(member) < *first) first = &table.id(member);
  return *first;
}

/// Of one kind, sorted by their ids, and so by what names them.
void add_groups(const GroupKind& kind, MemberLists components, const FeatureTable& table,
                std::vector<Group>& groups) {
  std::vector<std::pair<const std::string*, std::size_t>> order;
  order.reserve(components.size());
  for (std::size_t i = 0; i < components.size(); ++i)
    order.emplace_back(&id_of(components[i], table), i);
  std::ranges::sort(order, [](const auto& p, const auto& q) { return *p.first < *q.first; });
  groups.reserve(groups.size() + order.size());
  const std::string prefix = kind.name + ".";
  for (const auto& [id, i] : order)
    groups.push_back({prefix + *id, kind.name, std::move(components[i])});
}

}  // namespace

std::vector<Group> find_groups(const Pack& pack, const Facts& facts, const FeatureTable& table) {
  std::vector<Group> groups;
  if (facts.rows == 0) return groups;
  for (const GroupKind& kind : pack.groups)
    add_groups(kind, components_of(kind, facts), table, groups);
  return groups;
}

}  // namespace oriel::rules
