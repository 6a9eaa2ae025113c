#include "interpret/detail/groups.h"

#include "kernel/model/detail/index.h"

#include <algorithm>
#include <map>
#include <numeric>

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

/// The members of every component of one kind.
std::vector<std::vector<FeatureId>> components_of(const GroupKind& kind, const Facts& facts) {
  const auto& members = facts.membership[static_cast<std::size_t>(kind.of)];
  const Links& links = facts.relations[static_cast<std::size_t>(kind.by)];
  const auto is_member = [&](int row) {
    return members[static_cast<std::size_t>(row)] == Truth::yes;
  };
  DisjointRows sets(facts.rows);
  for (const int row : facts.row_numbers) {
    if (!is_member(row)) continue;
    int root = sets.find(row);
    const std::size_t end = links.begin_of(row + 1);
    for (std::size_t link = links.begin_of(row); link < end; ++link)
      if (links.is_other(link) == Truth::yes && is_member(links.others[link]))
        root = sets.join(root, links.others[link]);
  }
  std::map<int, std::vector<FeatureId>> by_root;
  for (const int row : facts.row_numbers)
    if (is_member(row)) by_root[sets.find(row)].push_back(FeatureId{row});
  std::vector<std::vector<FeatureId>> components;
  for (auto& [root, rows] : by_root)
    if (static_cast<int>(rows.size()) >= kind.at_least) components.push_back(std::move(rows));
  return components;
}

Group make_group(const GroupKind& kind, std::vector<FeatureId> members, const FeatureTable& table) {
  const auto first = std::ranges::min_element(
      members, {}, [&](FeatureId id) -> const std::string& { return table.id(id); });
  return {kind.name + "." + table.id(*first), kind.name, std::move(members)};
}

}  // namespace

std::vector<Group> find_groups(const Pack& pack, const Facts& facts, const FeatureTable& table) {
  std::vector<Group> groups;
  if (facts.rows == 0) return groups;
  for (const GroupKind& kind : pack.groups) {
    const std::size_t begin = groups.size();
    for (auto& members : components_of(kind, facts))
      groups.push_back(make_group(kind, std::move(members), table));
    std::sort(groups.begin() + static_cast<std::ptrdiff_t>(begin), groups.end(),
              [](const Group& p, const Group& q) { return p.id < q.id; });
  }
  return groups;
}

}  // namespace oriel::rules
