#include "kernel/segment/complex/owners.h"

#include <functional>

namespace oriel::detail {

Owners::Owners(const Segmentation& segmentation)
    : position_of_cell_(segmentation.cells.size(), -1) {
  struct Waiting {
    NodeId node;
    TreePlace place;
  };
  std::vector<Waiting> waiting;
  if (segmentation.root.is_valid()) waiting.push_back({segmentation.root, {}});
  while (!waiting.empty()) {
    const auto [id, place] = waiting.back();
    waiting.pop_back();
    const int position = static_cast<int>(places_.size());
    const CsgNode& node = segmentation.nodes[id.index()];
    places_.push_back(place);
    if (node.kind == CsgNode::Kind::leaf) position_of_cell_[node.cell.index()] = position;
    const bool is_difference = node.kind == CsgNode::Kind::subtract;
    for (std::size_t i = node.parts.size(); i-- > 0;)
      waiting.push_back({node.parts[i], {position, is_difference}});
    for (std::size_t i = node.rest.size(); i-- > 0;)
      waiting.push_back({node.rest[i], {position, false}});
  }
}

CellId Owners::of(const std::vector<int>& cells) {
  if (cells.empty()) return {};
  const auto [entry, is_new] = known_.try_emplace(cells);
  if (is_new) entry->second = decide(cells);
  return entry->second;
}

CellId Owners::decide(const std::vector<int>& cells) const {
  // From the last position to the first, so that all below a node is known when its turn comes.
  std::map<int, Gathered, std::greater<>> waiting;
  for (const int c : cells) {
    waiting[position_of_cell_[static_cast<std::size_t>(c)]].rest = {true, CellId{c}};
  }
  while (true) {
    const auto [position, gathered] = *waiting.begin();
    waiting.erase(waiting.begin());
    const TreePlace& place = places_[static_cast<std::size_t>(position)];
    OwnerVerdict verdict = gathered.rest;
    // In a difference the parts decide of the rest's body, innermost first.
    if (verdict.is_in_body && gathered.part.owner.is_valid())
      verdict = {!gathered.part.is_in_body, gathered.part.owner};
    if (place.parent < 0) return verdict.owner;
    Gathered& above = waiting[place.parent];
    OwnerVerdict& known = place.is_part_of_difference ? above.part : above.rest;
    // Later children come first; an earlier one overrules them, unless one of those alone has the
    // point in its body.
    if (verdict.is_in_body || (!known.is_in_body && verdict.owner.is_valid())) known = verdict;
  }
}

}  // namespace oriel::detail
