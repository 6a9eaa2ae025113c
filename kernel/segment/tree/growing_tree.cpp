#include "kernel/segment/tree/growing_tree.h"

#include <utility>

namespace oriel::detail {

GrowingTree::GrowingTree(const Solid& solid, const SegmentOptions& how)
    : options(how),
      world(solid, Work(how.budget)),
      cells(solid.facets.size(), world, out),
      instances(world, cells, out),
      ground(ground_side(solid, world.planes, how.tolerances.coplanar_deg)) {
  out.order = how.order;
  out.grid_m = solid.grid_m;
  out.planes = solid.planes;
}

NodeId GrowingTree::add_node() {
  out.nodes.emplace_back();
  return NodeId{static_cast<int>(out.nodes.size()) - 1};
}

void GrowingTree::hang(std::vector<Boundary> bodies, NodeId id) {
  if (bodies.size() == 1) {
    waiting.push_back({std::move(bodies[0]), id, {}, 1, {}});
    return;
  }
  node(id).kind = CsgNode::Kind::unite;
  for (Boundary& body : bodies) {
    const NodeId child = add_node();
    node(id).rest.push_back(child);
    waiting.push_back({std::move(body), child, {}, 1, {}});
  }
}

WaitingBody& GrowingTree::add_part(const WaitingBody& from, Boundary body, int sign,
                                   Feature feature) {
  const NodeId id = add_node();
  node(from.node).parts.push_back(id);
  feature.node = id;
  feature.parent = from.feature;
  for (const int v : feature.vertices) feature.box.grow(world.points.at(PointId{v}));
  const FeatureId feature_id = next_feature();
  out.features.push_back(std::move(feature));
  waiting.push_back({std::move(body), id, feature_id, sign, {}});
  return waiting.back();
}

}  // namespace oriel::detail
