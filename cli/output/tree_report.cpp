#include "cli/output/tree_report.h"

#include "kernel/segment/tree/balance.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

ordered_json json_of(const TreeFigures& figures) {
  return {{"leaves", figures.leaves},
          {"inner", figures.inner},
          {"depth", figures.depth},
          {"weighted_path", figures.weighted_path}};
}

ordered_json json_of(const BalanceProof& proof) {
  return {{"holds", proof.holds()},
          {"same_cells", proof.has_same_cells},
          {"volume_before_m3", proof.before_m3},
          {"volume_after_m3", proof.after_m3},
          {"points", proof.points},
          {"differing", proof.differing}};
}

ordered_json json_of(const std::vector<CsgNode>& nodes, NodeId id) {
  const CsgNode& node = nodes[id.index()];
  if (node.kind == CsgNode::Kind::leaf) return {{"kind", "leaf"}, {"cell", node.cell.value}};
  ordered_json out{{"kind", node.kind == CsgNode::Kind::unite ? "union" : "difference"}};
  out["rest"] = ordered_json::array();
  out["parts"] = ordered_json::array();
  for (const NodeId child : node.rest) out["rest"].push_back(json_of(nodes, child));
  for (const NodeId child : node.parts) out["parts"].push_back(json_of(nodes, child));
  return out;
}

std::string text_of(const TreeFigures& figures) {
  return fmt::format("{} leaves, {} inner, depth {}, weighted path {:.3f}", figures.leaves,
                     figures.inner, figures.depth, figures.weighted_path);
}

std::string text_of(const BalanceProof& proof) {
  return fmt::format("{}: {:.6f} m3, {} of {} points", proof.holds() ? "the same body" : "DIFFERS",
                     proof.after_m3, proof.points - proof.differing, proof.points);
}

}  // namespace

std::string tree_report(const std::string& building, const Segmentation& segmentation, bool is_json,
                        bool& is_same) {
  BalancedTree tree = balance(segmentation);
  const TreeFigures cut = figures_of(segmentation), balanced = figures_of(tree, segmentation);
  const BalanceProof first = prove(tree, segmentation);
  merge_touching(tree, segmentation);
  const TreeFigures merged = figures_of(tree, segmentation);
  const BalanceProof second = prove(tree, segmentation);
  is_same = first.holds() && second.holds();
  if (!is_json)
    return fmt::format("{}:\n  as cut    {}\n  balanced  {}; {}\n  merged    {}; {}\n", building,
                       text_of(cut), text_of(balanced), text_of(first), text_of(merged),
                       text_of(second));
  ordered_json out{{"id", building}, {"cut", json_of(cut)}, {"balanced", json_of(balanced)}};
  out["balanced"]["proof"] = json_of(first);
  out["merged"] = json_of(merged);
  out["merged"]["proof"] = json_of(second);
  out["merges"] = ordered_json::array();
  for (const LeafMerge& merge : tree.merges) {
    ordered_json planes = ordered_json::array();
    for (const PlaneId id : merge.planes) planes.push_back(id.value);
    out["merges"].push_back({{"first", merge.first.value},
                             {"second", merge.second.value},
                             {"contact", merge.contact.value},
                             {"planes", std::move(planes)},
                             {"volume_m3", merge.volume_m3}});
  }
  out["tree"] = json_of(tree.nodes, tree.root);
  return out.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace oriel::cli
