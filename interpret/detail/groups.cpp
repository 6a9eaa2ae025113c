#include "interpret/detail/groups.h"

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
  /// The smaller root stays, so that paths end at the first member.
  void join(int p, int q) {
    p = find(p);
    q = find(q);
    parents_[at(std::max(p, q))] = std::min(p, q);
  }

 private:
  static std::size_t at(int row) { return static_cast<std::size_t>(row); }
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
    for (std::size_t link = links.begin_of(row); link < links.begin_of(row + 1); ++link)
      if (links.is_other(link) == Truth::yes && is_member(links.others[link]))
        sets.join(row, links.others[link]);
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
