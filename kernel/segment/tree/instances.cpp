#include "kernel/segment/tree/instances.h"

#include "kernel/base/index.h"
#include "kernel/base/issue.h"

#include <algorithm>

namespace oriel::detail {

/// Gives the body at a node the subtree of a congruent one: nodes, features and cells are those of
/// the model, moved. No cut has a plane that its body has not, so the map has all planes needed.
class Instances::SubtreeCopier {
 public:
  SubtreeCopier(const Subtree& model, const Congruence& how, World& world, CellWriter& cells,
                Segmentation& out)
      : model_(model),
        how_(how),
        world_(world),
        cells_(cells),
        out_(out),
        points_(world.scratch.moved_points),
        planes_(world.scratch.moved_planes) {}

  void run(NodeId node, FeatureId feature) {
    fill(points_, world_.points.size(), how_.points);
    fill(planes_, world_.planes.size(), how_.planes);
    node_ = node;
    feature_ = feature;
    new_node_ = static_cast<int>(out_.nodes.size());
    new_feature_ = static_cast<int>(out_.features.size());
    new_cell_ = static_cast<int>(out_.cells.size());
    copy_node(model_.node);
    for (int n = model_.first_node; n < model_.last_node; ++n) {
      out_.nodes.emplace_back();
      copy_node(NodeId{n});
    }
    for (int f = model_.first_feature; f < model_.last_feature; ++f) copy_feature(FeatureId{f});
    for (int c = model_.first_cell.value; c < model_.last_cell.value; ++c) copy_cell(CellId{c});
    cells_.copy_sources(how_.sources, model_.first_cell, model_.last_cell, new_cell_);
    for (const auto& [marked, copy] : how_.marks) copy_host(FeatureId{marked}, FeatureId{copy});
  }

 private:
  static void fill(StampMap<int>& map, int size, const NumberMap& numbers) {
    map.start(size);
    for (const auto& [one, other] : numbers) map.set(one, other);
  }

  [[nodiscard]] NodeId moved(NodeId id) const {
    return id == model_.node ? node_ : NodeId{id.value - model_.first_node + new_node_};
  }
  [[nodiscard]] FeatureId moved(FeatureId id) const {
    if (!id.is_valid()) return id;
    return id == model_.feature ? feature_
                                : FeatureId{id.value - model_.first_feature + new_feature_};
  }
  [[nodiscard]] CellId moved(CellId id) const {
    return CellId{id.value - model_.first_cell.value + new_cell_};
  }
  PlaneId moved(PlaneId id) {
    const PlaneSide side = cells_.side_of(id);
    if (planes_.find(side >> 1) < 0) throw GeometryError("a copy of a pocket has lost planes");
    return cells_.plane_id(2 * planes_.find(side >> 1) + (side & 1));
  }

  /// Vertices that cuts of the model have made are made again, once.
  int moved(int point) {
    if (const int own = points_.find(point); own >= 0) return own;
    const auto place = std::ranges::lower_bound(made_, point, {}, &std::pair<int, int>::first);
    if (place != made_.end() && place->first == point) return place->second;
    return made_.insert(place, {point, world_.points.add_moved(point, how_.shift, how_.planes)})
        ->second;
  }

  void copy_node(NodeId id) {
    CsgNode node = out_.nodes[id.index()];
    for (PlaneId& plane : node.planes) plane = moved(plane);
    std::ranges::sort(node.planes);
    for (NodeId& child : node.rest) child = moved(child);
    for (NodeId& child : node.parts) child = moved(child);
    if (node.cell.is_valid()) node.cell = moved(node.cell);
    out_.nodes[moved(id).index()] = std::move(node);
  }

  void copy_feature(FeatureId id) {
    Feature feature = out_.features[id.index()];
    feature.parent = moved(feature.parent);
    feature.host = moved(feature.host);
    if (feature.host_facet) feature.host_facet->cell = moved(feature.host_facet->cell);
    feature.node = moved(feature.node);
    for (PlaneId& plane : feature.planes) plane = moved(plane);
    feature.cap_point = feature.cap_point + how_.shift_m;
    feature.box = feature.box.moved(how_.shift_m);
    for (int& v : feature.vertices) v = moved(v);
    std::ranges::sort(feature.vertices);
    out_.features.push_back(std::move(feature));
  }

  /// A feature that was cut from the model before hangs on one of its cells.
  void copy_host(FeatureId of_model, FeatureId of_copy) {
    const Feature& hung = out_.features[of_model.index()];
    if (!hung.host_facet) return;
    Feature& copy = out_.features[of_copy.index()];
    copy.host = moved(hung.host);
    copy.host_facet = CellFacet{moved(hung.host_facet->cell), hung.host_facet->facet};
  }

  void copy_cell(CellId id) {
    Cell cell = out_.cells[id.index()];
    cell.node = moved(cell.node);
    cell.feature = moved(cell.feature);
    for (Facet& facet : cell.facets) {
      facet.plane = moved(facet.plane);
      for (Loop& loop : facet.loops)
        for (int& v : loop) v = moved(v);
    }
    out_.cells.push_back(std::move(cell));
  }

  const Subtree& model_;
  const Congruence& how_;
  World& world_;
  CellWriter& cells_;
  Segmentation& out_;
  StampMap<int>& points_;  ///< as `how` has them
  StampMap<int>& planes_;  ///< likewise
  NodeId node_;
  FeatureId feature_;
  int new_node_ = 0, new_feature_ = 0, new_cell_ = 0;
  NumberMap made_;
};

void Instances::let_wait(std::vector<WaitingBody>& waiting, std::size_t first,
                         const std::vector<std::size_t>& models) {
  for (std::size_t i = 0; i < models.size(); ++i)
    if (models[i] != i) {
      int& number = waiting[first + models[i]].model;
      if (number < 0) {
        number = static_cast<int>(models_.size());
        models_.emplace_back();
      }
      waiting[first + i].model = number;
    }
}

void Instances::open(const WaitingBody& body, std::size_t waiting) {
  if (body.model < 0 || body.copy_of_model) return;
  const int node = static_cast<int>(out_.nodes.size()),
            feature = static_cast<int>(out_.features.size());
  const CellId cell{static_cast<int>(out_.cells.size())};
  models_[at(body.model)] = {{body.node, body.feature, node, node, feature, feature, cell, cell},
                             waiting};
  open_.push_back(body.model);
}

void Instances::close(std::size_t waiting) {
  while (!open_.empty()) {
    PocketModel& model = models_[at(open_.back())];
    if (waiting >= model.waiting) return;
    model.subtree.last_node = static_cast<int>(out_.nodes.size());
    model.subtree.last_feature = static_cast<int>(out_.features.size());
    model.subtree.last_cell = CellId{static_cast<int>(out_.cells.size())};
    open_.pop_back();
  }
}

bool Instances::copy(const WaitingBody& body) {
  if (!body.copy_of_model) return false;
  const Subtree& model = models_[at(body.model)].subtree;
  SubtreeCopier(model, *body.copy_of_model, world_, cells_, out_).run(body.node, body.feature);
  ++out_.stats.instanced;
  return true;
}

}  // namespace oriel::detail
