#include "examples/cuts/steps.h"

#include <algorithm>

namespace oriel::cuts {
namespace {

void add_steps(const Segmentation& s, Step step, std::vector<Step>& steps) {
  const CsgNode& node = s.nodes[step.node.index()];
  const bool is_leaf = node.kind == CsgNode::Kind::leaf;
  if (is_leaf && step.is_in_part) return;
  const int from = static_cast<int>(steps.size());
  steps.push_back(step);
  for (const NodeId rest : node.rest) add_steps(s, {rest, from, false, step.is_in_part}, steps);
  const auto is_cut = [&](NodeId id) { return s.nodes[id.index()].kind != CsgNode::Kind::leaf; };
  const auto part = std::ranges::find_if(node.parts, is_cut);
  if (part != node.parts.end()) add_steps(s, {*part, from, true, true}, steps);
}

void add_pieces(const Segmentation& s, NodeId id, Piece like, std::vector<Piece>& pieces) {
  const CsgNode& node = s.nodes[id.index()];
  if (node.kind == CsgNode::Kind::leaf) {
    like.cell = node.cell;
    pieces.push_back(like);
    return;
  }
  for (const NodeId rest : node.rest) add_pieces(s, rest, like, pieces);
  if (node.kind == CsgNode::Kind::subtract) like.sign = -like.sign;
  for (const NodeId part : node.parts) add_pieces(s, part, like, pieces);
}

}  // namespace

std::vector<Step> steps_of(const Segmentation& segmentation) {
  std::vector<Step> steps;
  add_steps(segmentation, {segmentation.root}, steps);
  return steps;
}

std::vector<Piece> pieces_of(const Segmentation& segmentation, NodeId node) {
  const CsgNode& own = segmentation.nodes[node.index()];
  std::vector<Piece> pieces;
  if (own.kind == CsgNode::Kind::leaf) return {{own.cell, 1, false}};
  for (const NodeId rest : own.rest) add_pieces(segmentation, rest, {{}, 1, false}, pieces);
  const int sign = own.kind == CsgNode::Kind::subtract ? -1 : 1;
  for (const NodeId part : own.parts) add_pieces(segmentation, part, {{}, sign, true}, pieces);
  return pieces;
}

}  // namespace oriel::cuts
