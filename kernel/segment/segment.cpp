#include "kernel/segment/segment.h"

#include "kernel/base/index.h"
#include "kernel/base/work.h"
#include "kernel/segment/boundary/parting.h"
#include "kernel/segment/cuts/carry_out.h"
#include "kernel/segment/cuts/choice.h"
#include "kernel/segment/tree/growing_tree.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace oriel {

namespace {

using detail::Boundary;
using detail::Chooser;
using detail::CutChoice;
using detail::CutKey;
using detail::CutResult;
using detail::GrowingTree;
using detail::WaitingBody;

/// The cuts that a body has had, so that none is made twice in one state: only cuts that follow no
/// edges can lead back to where the body was, as others take edges away.
class CutHistory {
 public:
  /// False if the cut has been made in this state before: then it is banned.
  bool enter(const Boundary& body, const CutChoice& choice) {
    if (choice.is_natural) return true;
    const CutKey key{choice.sides, choice.is_hole};
    if (seen_.emplace(state_of(body), key).second) return true;
    banned_.insert(key);
    has_led_back_ = true;
    return false;
  }
  void ban(const CutChoice& choice) { banned_.insert({choice.sides, choice.is_hole}); }

  [[nodiscard]] const std::set<CutKey>& banned() const { return banned_; }
  [[nodiscard]] bool has_led_back() const { return has_led_back_; }

 private:
  std::set<std::pair<detail::BodyState, CutKey>> seen_;
  std::set<CutKey> banned_;
  bool has_led_back_ = false;
};

/// The solid's lumps: one is the root itself, several hang under a root that cuts nothing.
void start(GrowingTree& tree, const Solid& solid) {
  tree.out.root = tree.add_node();
  std::vector<int> shells;  // of each lump
  for (const Shell& shell : solid.shells) {
    if (shell.lump >= std::ssize(shells)) shells.resize(at(shell.lump) + 1, 0);
    ++shells[at(shell.lump)];
  }
  std::vector<Boundary> bodies;
  for (int lump = 0; lump < std::ssize(shells); ++lump)
    bodies.push_back(boundary_of(solid, lump, tree.world));
  tree.hang(std::move(bodies), tree.out.root);
  for (std::size_t i = 0; i < tree.waiting.size(); ++i)
    tree.waiting[i].has_one_shell = shells[i] == 1;
}

void add_leaf(GrowingTree& tree, const WaitingBody& body, LeafFlag flag) {
  tree.node(body.node).cell =
      tree.cells.add(body.body, body.node, body.sign, flag == LeafFlag::convex, flag, body.feature);
}

LeafFlag flag_of_uncut(const WaitingBody& body, const CutHistory& history, const Work& work) {
  if (work.is_used_up()) return LeafFlag::budget;
  if (history.has_led_back()) return LeafFlag::cycle;
  return body.own_planes.empty() ? LeafFlag::no_candidate : LeafFlag::own;
}

/// Makes cavities, if there are any, the parts of a node without planes.
void take_out_cavities(GrowingTree& tree, WaitingBody& body) {
  std::vector<Boundary> cavities = detail::take_out_cavities(body.body);
  if (cavities.empty()) return;
  CsgNode& here = tree.node(body.node);
  here.kind = CsgNode::Kind::subtract;
  here.value = here.quality = 0;
  const NodeId rest = tree.add_node();
  tree.node(body.node).rest = {rest};
  for (Boundary& cavity : cavities) {
    Feature feature;
    feature.sense = Sense::cavity;
    feature.value = feature.quality = 0;
    measure(feature, cavity);
    feature.vertices = vertices_of(cavity);
    tree.add_part(body, std::move(cavity), -body.sign, std::move(feature));
  }
  body.node = rest;
}

/// The rest of the cut at node `parent` is in pieces, which all become its `rest`.
void hang_rest(GrowingTree& tree, WaitingBody body, NodeId parent) {
  std::vector<Boundary> lumps = detail::part_into_lumps(body.body);
  for (std::size_t i = 0; i < lumps.size(); ++i) {
    const NodeId child = i == 0 ? body.node : tree.add_node();
    if (i > 0) tree.node(parent).rest.push_back(child);
    tree.waiting.push_back({std::move(lumps[i]), child, body.feature, body.sign, body.own_planes});
  }
}

/// Splits one body down to its leaf: each round is a node of the tree. Its parts wait.
void split(GrowingTree& tree, WaitingBody body) {
  if (!body.has_one_shell) take_out_cavities(tree, body);
  std::optional<Chooser> chooser;
  CutHistory history;
  EdgeId bend;
  while (true) {
    if (is_convex(body.body, bend)) return add_leaf(tree, body, LeafFlag::convex);
    if (tree.world.work.is_used_up()) return add_leaf(tree, body, LeafFlag::budget);
    if (is_mostly_dead(body.body)) {
      body.body = compacted(body.body);
      chooser.reset();
      bend = {};
    }
    if (!chooser)
      chooser.emplace(body.body, tree.options, tree.ground, body.own_planes, tree.out.stats);
    const std::optional<CutChoice> choice = chooser->next(history.banned());
    if (!choice) return add_leaf(tree, body, flag_of_uncut(body, history, tree.world.work));
    if (!history.enter(body.body, *choice)) continue;
    const std::optional<CutResult> result = try_cut(tree, body, *choice);
    if (!result) {
      history.ban(*choice);
      chooser.reset();
      continue;
    }
    if (choice->imprinted) {
      remove_seams(body.body);
      chooser.reset();
      bend = {};
    } else {
      chooser->changed(result->changes);
    }
    if (result->may_have_parted && !is_connected(body.body))
      return hang_rest(tree, std::move(body), result->node);
  }
}

/// Brings a body that waits to its place in the tree: as a copy, as the leaf that it is known to be
/// or split.
void take(GrowingTree& tree, WaitingBody body) {
  tree.instances.close(tree.waiting.size());
  if (tree.instances.copy(body)) return;
  tree.instances.open(body, tree.waiting.size());
  if (body.leaf)
    tree.node(body.node).cell =
        tree.cells.add(std::move(*body.leaf), body.node, body.sign, body.feature);
  else
    split(tree, std::move(body));
}

void warn_of_budget(Segmentation& out, const Building& building, std::int64_t budget) {
  const bool is_used_up = std::ranges::any_of(
      out.cells, [](const Cell& cell) { return cell.flag == LeafFlag::budget; });
  if (is_used_up)
    out.issues.push_back(
        used_up(building.id, budget, "segmenting", "bodies that are not split yet stay whole"));
}

}  // namespace

Segmentation segment(const Building& building, const Solid& solid, const SegmentOptions& options) {
  GrowingTree tree(solid, options);
  start(tree, solid);
  while (!tree.waiting.empty()) {
    WaitingBody body = std::move(tree.waiting.back());
    tree.waiting.pop_back();
    take(tree, std::move(body));
  }
  tree.cells.finish(building, solid);
  tree.out.stats.leaves = tree.out.cells.size();
  tree.out.stats.inner = tree.out.nodes.size() - tree.out.stats.leaves;
  tree.out.stats.recursions = tree.out.nodes.size();
  warn_of_budget(tree.out, building, options.budget);
  return std::move(tree.out);
}

}  // namespace oriel
