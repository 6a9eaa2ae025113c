#include "kernel/segment/cuts/carry_out.h"

#include "kernel/base/index.h"
#include "kernel/base/issue.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/cuts/carve.h"

#include <algorithm>
#include <functional>
#include <map>
#include <ranges>
#include <span>
#include <utility>

namespace oriel::detail {

namespace {

/// The points, sorted, each once: about `most` of them.
template <class Points>
std::vector<PointId> sorted_uniquely(Points&& points, int most, World& world) {
  std::vector<PointId> sorted;
  sorted.reserve(at(most));
  world.scratch.met_points.start(world.points.size());
  for (const PointId p : points)
    if (world.scratch.met_points.insert(p)) sorted.push_back(p);
  std::ranges::sort(sorted);
  return sorted;
}

/// As vertices of the segmentation.
std::vector<int> vertices_of(std::span<const PointId> points) {
  std::vector<int> vertices;
  vertices.reserve(points.size());
  for (const PointId p : points) vertices.push_back(p.value);
  return vertices;
}

std::vector<std::pair<PointId, PointId>> edges_of(const CapLoop& loop) {
  std::vector<std::pair<PointId, PointId>> edges;
  edges.reserve(loop.edges.size());
  for (const CapEdge& edge : loop.edges) edges.emplace_back(edge.from, edge.to);
  return edges;
}

/// Of each lump of a choice the last one that is the same pocket, moved: what becomes of the one is
/// known from the other. Itself, if there is none; nothing if that is not known of one.
std::vector<std::size_t> models_of(const CutChoice& choice) {
  std::map<PocketKindId, std::size_t> last_of_kind;
  const auto& lumps = choice.lumps;
  for (std::size_t i = 0; i < lumps.size(); ++i) {
    if (lumps[i].is_alone) continue;
    if (!lumps[i].pocket.is_valid()) return {};
    const PocketKindId kind = choice.pockets->kind_of(lumps[i].pocket);
    last_of_kind[kind] = i;
  }
  std::vector<std::size_t> models;
  models.reserve(lumps.size());
  for (std::size_t i = 0; i < lumps.size(); ++i)
    models.push_back(lumps[i].is_alone ? i
                                       : last_of_kind.at(choice.pockets->kind_of(lumps[i].pocket)));
  return models;
}

/// A lump of a choice is a pocket that comes off without a body, as the leaf that it is. `models`:
/// those of the choice.
bool is_leaf(const CutChoice& choice, const Lump& lump, std::span<const std::size_t> models) {
  return !models.empty() && choice.is_natural && lump.pocket.is_valid() &&
         choice.pockets->is_leaf(choice.pockets->kind_of(lump.pocket));
}

/// What a cut that took a part off has changed of the rest. `size`: about how many vertices the
/// part has.
RestChange change_of(const Carved& carved, std::span<const CutCap> caps, std::size_t size) {
  RestChange change;
  change.points = sorted_uniquely(carved.touched, static_cast<int>(size), carved.lump.world());
  const bool is_simple =
      caps.size() == 1 && caps[0].loops.size() == 1 && caps[0].covered.empty() && !caps[0].is_taken;
  if (is_simple) change.rim = edges_of(caps[0].loops[0]);
  for (const CutCap& cap : caps) {
    change.has_covered |= !cap.covered.empty();
    if (!carved.has_rim_left) continue;
    for (const CapLoop& loop : cap.loops)
      for (const CapEdge& edge : loop.edges) change.new_edges.emplace_back(edge.from, edge.to);
  }
  return change;
}

/// What filling a pocket has changed of the rest. `points`: the vertices of the pocket.
RestChange change_of_pocket(const CutCap& cap, std::vector<PointId> points) {
  return {.points = std::move(points), .rim = edges_of(cap.loops[0]), .is_natural = true};
}

double area_of(World& world, const CutCap& cap) {
  double area = 0;
  for (const CapLoop& loop : cap.loops) {
    Outline& outline = world.scratch.outline;
    outline.clear();
    for (const CapEdge& edge : loop.edges) outline.push_back(world.points.at(edge.from));
    area += signed_area(outline, world.planes.normal(cap.side));
  }
  return area;
}

/// What is to be put back if a cut fails.
struct Snapshot {
  std::optional<Boundary> body;  ///< none of a cut of pockets along edges: it does not fail
  NodeId node;
  std::size_t nodes, features, waiting;
  PointTable::PointMark points;
};

/// The outlines of lumps that are no pockets are put into the body before they are known to part
/// it.
Snapshot snapshot_of(const GrowingTree& tree, const WaitingBody& from, const CutChoice& choice) {
  const bool has_pockets_only =
      choice.patches.empty() &&
      std::ranges::all_of(choice.lumps, [](const Lump& lump) { return lump.pocket.is_valid(); });
  const bool may_fail =
      !choice.is_natural || choice.has_neck || choice.imprinted || !has_pockets_only;
  return {may_fail ? std::optional(from.body) : std::nullopt,
          from.node,
          tree.out.nodes.size(),
          tree.out.features.size(),
          tree.waiting.size(),
          tree.world.points.mark()};
}

void restore(GrowingTree& tree, WaitingBody& from, Snapshot before) {
  if (before.body) from.body = std::move(*before.body);
  from.node = before.node;
  tree.node(before.node) = {};
  tree.out.nodes.resize(before.nodes);
  tree.out.features.resize(before.features);
  tree.waiting.erase(tree.waiting.begin() + static_cast<std::ptrdiff_t>(before.waiting),
                     tree.waiting.end());
  tree.world.points.forget_since(before.points);
}

/// One cut: its parts are taken off one after the other.
class Cut {
 public:
  Cut(GrowingTree& tree, WaitingBody& from, const CutChoice& choice)
      : tree_(tree), from_(from), choice_(choice), takes_rest_(is_most(tree, from, choice)) {}

  /// False if a rim separates nothing.
  bool run() {
    begin_node();
    const std::size_t first_part = tree_.waiting.size();
    const std::vector<std::size_t> models = models_of(choice_);
    result_.changes.reserve(choice_.lumps.size() + choice_.patches.size());
    for (std::size_t i = 0; i < choice_.lumps.size(); ++i) {
      const Lump& lump = choice_.lumps[i];
      if (!models.empty() && models[i] != i)
        take_off_pocket(lump, &choice_.lumps[models[i]]);
      else if (is_leaf(choice_, lump, models) && !takes_rest_)
        take_off_pocket(lump, nullptr);
      else if (!take_off_lump(lump))
        return false;
    }
    for (const Patch& patch : choice_.patches) {
      result_.may_have_parted = true;
      if (!take_off_part(patch.caps, {patch.new_area, patch.new_area / patch.old_area}, {}))
        return false;
    }
    tree_.instances.let_wait(tree_.waiting, first_part, models);
    from_.node = tree_.node(result_.node).rest[0];
    return true;
  }

  [[nodiscard]] bool has_changed_body() const { return has_changed_body_; }
  [[nodiscard]] CutResult take_result() { return std::move(result_); }

 private:
  /// The only lump of a cut is nearly all that is left of the solid: it is the body, and what is
  /// behind the plane are the parts. A house under a roof slab is no part of it, nor one under the
  /// caps of its chimneys; walls under a roof that is more than a slab are.
  static bool is_most(const GrowingTree& tree, const WaitingBody& from, const CutChoice& choice) {
    if (choice.is_hole || from.feature.is_valid() || tree.options.order != Order::natural)
      return false;
    if (choice.lumps.size() != 1 || choice.lumps[0].regions.empty()) return false;
    const Lump& lump = choice.lumps[0];
    for (const RegionId region : lump.regions)
      if (!choice.section->regions[region].covered.empty()) return false;
    const double rest = from.body.volume() - lump.volume;
    constexpr double kSlab = 0.1;  // of the volume: less than what a coarser scale may leave out
    return rest < kSlab * from.body.volume() &&
           rest > tree.options.tolerances.weld_m * lump.new_area;
  }

  struct PartMeasures {
    double new_area;
    double value;
  };

  void begin_node() {
    result_.node = from_.node;
    CsgNode& here = tree_.node(from_.node);
    here.kind = choice_.is_hole ? CsgNode::Kind::subtract : CsgNode::Kind::unite;
    here.value = choice_.value;
    here.quality = choice_.quality;
    for (const PlaneSide side : choice_.sides)
      here.planes.push_back(tree_.cells.plane_id(takes_rest_ ? side ^ 1 : side));
    std::ranges::sort(here.planes);
    here.parts.reserve(choice_.lumps.size() + choice_.patches.size());
    const NodeId rest = tree_.add_node();
    tree_.node(from_.node).rest = {rest};
  }

  bool take_off_lump(const Lump& lump) {
    std::vector<PointId> touched;
    std::vector<CutCap> caps;
    if (lump.pocket.is_valid())
      caps.push_back(choice_.pockets->cap_of(lump.pocket));
    else
      caps = imprint(from_.body, *choice_.section, lump, touched);
    has_changed_body_ |= !touched.empty();
    if (caps.empty()) return false;
    if (takes_rest_) return take_off_rest(turned_round(from_.body, caps), lump, std::move(touched));
    note_parting(caps);
    return take_off_part(std::move(caps), {lump.new_area, lump.value}, std::move(touched));
  }

  /// What is left may hang together no longer if more than one outline parted it.
  void note_parting(std::span<const CutCap> caps) {
    std::size_t loops = 0;
    for (const CutCap& cap : caps) loops += cap.loops.size() + cap.covered.size();
    result_.may_have_parted |= loops > 1;
  }

  /// Each cap has a part of its own behind it; those that only come off together are one.
  bool take_off_rest(std::vector<CutCap> caps, const Lump& lump, std::vector<PointId> touched) {
    std::vector<CutCap> joined;
    if (caps.size() == 1) std::swap(joined, caps);
    for (CutCap& cap : caps) {
      const double area = area_of(tree_.world, cap);
      note_parting({&cap, 1});
      if (!take_off_part({cap}, {area, lump.value}, touched)) joined.push_back(std::move(cap));
    }
    if (joined.empty()) return true;
    double area = 0;
    for (const CutCap& cap : joined) area += area_of(tree_.world, cap);
    note_parting(joined);
    return take_off_part(std::move(joined), {area, lump.value}, std::move(touched));
  }

  bool take_off_part(std::vector<CutCap> caps, PartMeasures measures,
                     std::vector<PointId> touched) {
    const bool is_natural = choice_.is_natural && touched.empty();
    auto carved =
        take_off(from_.body, caps, choice_.is_hole, tree_.next_feature(), std::move(touched));
    if (!carved) return false;
    has_changed_body_ = true;
    if (takes_rest_) tree_.cells.add_rest(tree_.next_feature());
    Feature feature;
    feature.vertices = vertices_of(carved->lump);
    RestChange change = change_of(*carved, caps, feature.vertices.size());
    change.is_natural = is_natural;
    std::erase_if(caps, [](const CutCap& cap) { return cap.is_taken; });
    if (caps.size() > 1)
      std::ranges::stable_sort(caps, std::greater{},
                               [&](const CutCap& cap) { return area_of(tree_.world, cap); });
    describe_cut(feature, caps, measures);
    feature.cap_point = carved->cap_point;
    for (const CutCap& cap : caps) feature.surface_m2 -= area_of(tree_.world, cap);
    measure(feature, carved->lump);
    const int sign = sign_of(feature);
    WaitingBody& part = tree_.add_part(from_, std::move(carved->lump), sign, std::move(feature));
    if (!choice_.is_hole && choice_.sides.size() > 1)
      for (const PlaneSide side : choice_.sides) part.own_planes.push_back(side >> 1);
    result_.changes.push_back(std::move(change));
    return true;
  }

  /// Takes off a pocket that needs no body of its own: it gets a copy of what becomes of `model`,
  /// or, if there is none, is a leaf.
  void take_off_pocket(const Lump& lump, const Lump* model) {
    const Pockets& pockets = *choice_.pockets;
    const CutCap cap = pockets.cap_of(lump.pocket);
    const std::vector<BodyFacetId> facets = pockets.facets_of(lump.pocket);
    std::optional<Congruence> how;
    std::optional<PocketLeaf> leaf;
    if (model != nullptr)
      how = pockets.congruence(model->pocket, lump.pocket);
    else
      leaf = pockets.leaf_of(lump.pocket, facets, choice_.is_hole);
    Feature feature;
    std::vector<PointId> points = pockets.points_of(lump.pocket);
    feature.vertices = vertices_of(points);
    result_.changes.push_back(change_of_pocket(cap, std::move(points)));
    const auto filled = fill_pocket(from_.body, cap, facets, choice_.is_hole, tree_.next_feature());
    has_changed_body_ = true;
    describe_cut(feature, {&cap, 1}, {lump.new_area, lump.value});
    feature.cap_point = filled.cap_point;
    feature.surface_m2 = filled.surface;
    feature.volume_m3 = filled.volume;
    if (leaf) leaf->volume = filled.volume;
    const int sign = sign_of(feature);
    WaitingBody& part = tree_.add_part(from_, Boundary(tree_.world), sign, std::move(feature));
    part.copy_of_model = std::move(how);
    part.leaf = std::move(leaf);
  }

  /// Says of a part what its cut tells: sense, value, areas and planes. `caps`: the largest first.
  void describe_cut(Feature& feature, std::span<const CutCap> caps, PartMeasures measures) {
    // A hole in a void is material: the sense is that of the building.
    const bool is_material = choice_.is_hole == (from_.sign < 0);
    feature.sense = is_material ? Sense::protrusion : Sense::hole;
    feature.value = measures.value;
    feature.quality = measures.new_area / choice_.old_area;
    feature.new_area_m2 = measures.new_area;
    feature.old_area_m2 = choice_.old_area;
    feature.is_natural = choice_.is_natural;
    for (const CutCap& cap : caps) {
      const PlaneId plane = tree_.cells.plane_id(from_.sign < 0 ? cap.side ^ 1 : cap.side);
      if (std::ranges::find(feature.planes, plane) == feature.planes.end())
        feature.planes.push_back(plane);
    }
  }

  static int sign_of(const Feature& feature) { return feature.sense == Sense::protrusion ? 1 : -1; }

  GrowingTree& tree_;
  WaitingBody& from_;
  const CutChoice& choice_;
  bool takes_rest_;  ///< instead of the lump
  CutResult result_;
  bool has_changed_body_ = false;
};

}  // namespace

std::vector<int> vertices_of(const Boundary& body) {
  const auto edges = body.half_edge_ids();
  const auto is_alive = [&](EdgeId e) { return body.is_alive_edge(e); };
  const auto origin = [&](EdgeId e) { return body.origin(e); };
  constexpr int kEdgesAtPoint = 3;  // at least
  return vertices_of(
      sorted_uniquely(edges | std::views::filter(is_alive) | std::views::transform(origin),
                      body.half_edge_count() / kEdgesAtPoint, body.world()));
}

void measure(Feature& feature, const Boundary& body) {
  feature.volume_m3 = body.volume();
  for (const BodyFacetId f : body.facet_ids())
    if (body.is_alive(f)) feature.surface_m2 += body.area(f);
}

std::optional<CutResult> try_cut(GrowingTree& tree, WaitingBody& from, const CutChoice& choice) {
  Snapshot before = snapshot_of(tree, from, choice);
  if (choice.imprinted) from.body = *choice.imprinted;
  Cut cut(tree, from, choice);
  if (cut.run()) return cut.take_result();
  if (!before.body && cut.has_changed_body())
    throw GeometryError("the rim of a cut does not separate a lump");
  restore(tree, from, std::move(before));
  return std::nullopt;
}

}  // namespace oriel::detail
