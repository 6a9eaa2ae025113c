#include "kernel/segment/segment.h"

#include "kernel/base/index.h"
#include "kernel/segment/boundary/parting.h"
#include "kernel/segment/cuts/carve.h"
#include "kernel/segment/cuts/choice.h"
#include "kernel/segment/cuts/parts.h"
#include "kernel/segment/instances/body_state.h"
#include "kernel/segment/instances/models.h"
#include "kernel/segment/tree/cells.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using detail::Boundary;
using detail::Choice;
using detail::Side;
using detail::Task;

/// A cut has failed half-way, and there is no copy of the body as it was.
struct NoCopy {};

class Segmenter {
 public:
  /// `keeps_copies`: of bodies that cuts may fail on. Else run() throws NoCopy where one does.
  Segmenter(const Building& building, const Solid& solid, const SegmentOptions& options,
            bool keeps_copies)
      : building_(building),
        solid_(solid),
        options_(options),
        keeps_copies_(keeps_copies),
        world_{detail::PlaneTable(solid.planes), detail::PointTable(solid, world_.planes)},
        cells_(solid.facets.size(), world_, out_),
        models_(world_, cells_, out_) {}

  Segmentation run() {
    out_.order = options_.order;
    out_.grid_m = solid_.grid_m;
    out_.planes = solid_.planes;
    start();
    while (!tasks_.empty()) {
      Task task = std::move(tasks_.back());
      tasks_.pop_back();
      models_.close(tasks_.size());
      if (models_.copy(task)) continue;
      models_.open(task, tasks_.size());
      split(std::move(task));
    }
    finish();
    return std::move(out_);
  }

 private:
  /// The solid's lumps: one is the root itself, several hang under a root that cuts nothing.
  void start() {
    out_.root = add_node();
    std::vector<int> shells;  // of each lump
    for (const Shell& shell : solid_.shells) {
      if (shell.lump >= std::ssize(shells)) shells.resize(at(shell.lump) + 1, 0);
      ++shells[at(shell.lump)];
    }
    const int lumps = static_cast<int>(shells.size());
    ground_ = detail::ground_side(solid_, world_.planes, options_.tolerances.coplanar_deg);
    std::vector<Boundary> bodies;
    for (int lump = 0; lump < lumps; ++lump) bodies.push_back(boundary_of(solid_, lump, world_));
    hang(std::move(bodies), {}, 1, {}, out_.root);
    for (std::size_t i = 0; i < tasks_.size(); ++i) tasks_[i].has_one_shell = shells[i] == 1;
  }

  NodeId add_node() {
    out_.nodes.emplace_back();
    return NodeId{static_cast<int>(out_.nodes.size()) - 1};
  }
  CsgNode& node(NodeId id) { return out_.nodes[id.index()]; }

  /// Puts bodies under a node: a single one takes the node itself, several become its `rest`.
  void hang(std::vector<Boundary> bodies, FeatureId feature, int sign,
            const std::vector<int>& own_planes, NodeId id) {
    if (bodies.size() == 1) {
      tasks_.push_back({std::move(bodies[0]), id, feature, sign, own_planes});
      return;
    }
    node(id).kind = CsgNode::Kind::unite;
    for (Boundary& body : bodies) {
      const NodeId child = add_node();
      node(id).rest.push_back(child);
      tasks_.push_back({std::move(body), child, feature, sign, own_planes});
    }
  }

  /// Splits one body down to its leaf: each round is a node of the tree.
  void split(Task task) {
    if (task.leaf) return add_leaf(std::move(task));
    if (!task.has_one_shell) take_out_cavities(task);
    std::optional<detail::Chooser> chooser;
    std::set<std::pair<detail::BodyState, detail::CutKey>> seen;
    std::set<detail::CutKey> banned;  // those that have led back, and those that failed
    bool has_led_back = false;
    int bend = 0;
    while (true) {
      if (is_convex(task.body, bend)) return add_leaf(task, LeafFlag::convex);
      if (work_ > options_.budget) return add_leaf(task, LeafFlag::budget);
      if (is_mostly_dead(task.body)) {
        task.body = compacted(task.body);
        chooser.reset();
        bend = 0;
      }
      if (!chooser)
        chooser.emplace(task.body, options_, ground_, task.own_planes, out_.stats, work_);
      const auto choice = chooser->next(banned);
      if (!choice) return add_leaf(task, flag_of_uncut(task, has_led_back));
      // Natural cuts take edges away, so only others can lead back to where the body was. Then that
      // cut is not made again.
      const detail::CutKey key{choice->sides, choice->is_hole};
      if (!choice->is_natural && !seen.emplace(state_of(task.body), key).second) {
        banned.insert(key);
        has_led_back = true;
        continue;
      }
      auto changes = try_cut(task, *choice);
      if (!changes) {
        banned.insert(key);
        chooser.reset();
        continue;
      }
      if (choice->imprinted) {
        remove_seams(task.body);
        chooser.reset();
      } else {
        chooser->changed(*changes);
      }
      if (may_have_parted_) {
        may_have_parted_ = false;
        if (!is_connected(task.body)) return hang_rest(std::move(task));
      }
    }
  }

  static LeafFlag flag_of_uncut(const Task& task, bool has_led_back) {
    if (has_led_back) return LeafFlag::cycle;
    return task.own_planes.empty() ? LeafFlag::no_candidate : LeafFlag::own;
  }

  /// The rest that the last cut has left is in pieces: its lumps become the `rest` of the node made
  /// last.
  void hang_rest(Task task) {
    std::vector<Boundary> lumps = detail::part_into_lumps(task.body);
    for (std::size_t i = 0; i < lumps.size(); ++i) {
      const NodeId child = i == 0 ? task.node : add_node();
      if (i > 0) node(parent_of_rest_).rest.push_back(child);
      tasks_.push_back({std::move(lumps[i]), child, task.feature, task.sign, task.own_planes});
    }
  }

  void take_out_cavities(Task& task) {
    std::vector<Boundary> cavities = detail::take_out_cavities(task.body);
    if (cavities.empty()) return;
    CsgNode& here = node(task.node);
    here.kind = CsgNode::Kind::subtract;
    here.value = here.quality = 0;
    const NodeId rest = add_node();
    node(task.node).rest = {rest};
    for (Boundary& cavity : cavities) {
      Feature feature;
      feature.sense = Sense::cavity;
      feature.value = feature.quality = 0;
      measure(feature, cavity);
      feature.vertices = points_of(cavity);
      add_part(task, std::move(cavity), -task.sign, std::move(feature), {});
    }
    parent_of_rest_ = task.node;
    task.node = rest;
  }

  /// Carries out a choice. Nothing, and all is as before, if its rim turns out to separate nothing,
  /// as may be between vertices that lie on their planes by decree only (noisy input). Cuts along
  /// edges fail before they change their body if at all, so no copy is kept of it.
  std::optional<std::vector<detail::Change>> try_cut(Task& task, const Choice& choice) {
    std::optional<Boundary> body;
    const bool may_fail = !choice.is_natural || choice.imprinted;
    if (may_fail && keeps_copies_) body = task.body;
    const NodeId id = task.node;
    const std::size_t nodes = out_.nodes.size(), features = out_.features.size();
    const std::size_t tasks = tasks_.size();
    const auto points = world_.points.mark();
    if (choice.imprinted) task.body = *choice.imprinted;
    try {
      return cut(task, choice);
    } catch (const GeometryError&) {
      if (may_fail && !keeps_copies_) throw NoCopy{};
      if (!body && is_body_changed_) throw;
      if (body) task.body = std::move(*body);
      task.node = id;
      node(id) = {};
      out_.nodes.resize(nodes);
      out_.features.resize(features);
      tasks_.erase(tasks_.begin() + static_cast<std::ptrdiff_t>(tasks), tasks_.end());
      world_.points.forget_since(points);
      may_have_parted_ = false;
      return std::nullopt;
    }
  }

  /// Carries out a choice: makes its node and the parts' tasks, and leaves the rest in the task.
  /// Returns what has changed.
  std::vector<detail::Change> cut(Task& task, const Choice& choice) {
    CsgNode& here = node(task.node);
    here.kind = choice.is_hole ? CsgNode::Kind::subtract : CsgNode::Kind::unite;
    here.value = choice.value;
    here.quality = choice.quality;
    for (const Side side : choice.sides) here.planes.push_back(cells_.plane_id(side));
    std::ranges::sort(here.planes);
    here.parts.reserve(choice.lumps.size() + choice.patches.size());
    const NodeId rest = add_node();
    node(task.node).rest = {rest};

    const std::size_t first_part = tasks_.size();
    std::vector<detail::Change> changes;
    changes.reserve(choice.lumps.size() + choice.patches.size());
    if (tasks_.capacity() < tasks_.size() + choice.lumps.size())
      tasks_.reserve(2 * tasks_.capacity() + choice.lumps.size());
    is_body_changed_ = false;
    const std::vector<std::size_t> models = models_of(choice);
    for (std::size_t i = 0; i < choice.lumps.size(); ++i) {
      const detail::Lump& lump = choice.lumps[i];
      const bool is_copy = !models.empty() && models[i] != i;
      if (is_copy || is_leaf(choice, lump, models)) {
        is_body_changed_ = true;
        changes.push_back(
            take_off_pocket(task, choice, lump, is_copy ? &choice.lumps[models[i]] : nullptr));
        continue;
      }
      std::vector<int> touched;
      std::vector<detail::Cap> caps;
      if (lump.pocket >= 0)
        caps.push_back(choice.pockets->cap_of(lump.pocket));
      else
        caps = imprint(task.body, *choice.section, lump, touched);
      is_body_changed_ = is_body_changed_ || !touched.empty();
      if (caps.empty()) throw GeometryError("the section of a lump has no area");
      is_body_changed_ = true;
      std::size_t loops = 0;
      for (const detail::Cap& cap : caps) loops += cap.loops.size() + cap.covered.size();
      may_have_parted_ |= loops > 1;
      changes.push_back(take_off_part(task, choice, std::move(caps), {lump.new_area, lump.value},
                                      std::move(touched)));
    }
    for (const detail::Patch& patch : choice.patches) {
      may_have_parted_ = is_body_changed_ = true;
      changes.push_back(take_off_part(task, choice, patch.caps,
                                      {patch.new_area, patch.new_area / patch.old_area}, {}));
    }
    if (models.empty())
      models_.find_congruent(tasks_, first_part, ground_);
    else
      models_.let_wait(tasks_, first_part, models);
    parent_of_rest_ = task.node;
    task.node = rest;
    return changes;
  }

  struct Measures {
    double new_area;
    double value;
  };

  detail::Change take_off_part(Task& task, const Choice& choice, std::vector<detail::Cap> caps,
                               Measures measures, std::vector<int> touched) {
    const bool is_natural = choice.is_natural && touched.empty();
    auto carved = take_off(task.body, caps, choice.is_hole, next_feature(), std::move(touched));
    std::vector<int> points = points_of(carved.lump);
    detail::Change change = change_of(carved, caps, points);
    change.is_natural = is_natural;
    std::erase_if(caps, [](const detail::Cap& cap) { return cap.is_taken; });
    if (caps.size() > 1)
      std::ranges::stable_sort(caps, std::greater{},
                               [&](const detail::Cap& cap) { return area_of(world_, cap); });

    Feature feature = feature_of(task, choice, caps, measures);
    feature.cap_point = carved.cap_point;
    for (const detail::Cap& cap : caps) feature.surface_m2 -= area_of(world_, cap);
    measure(feature, carved.lump);
    feature.vertices = std::move(points);
    std::vector<int> own_planes;
    if (!choice.is_hole && choice.sides.size() > 1)
      for (const Side side : choice.sides) own_planes.push_back(side >> 1);
    const int sign = sign_of(feature);
    add_part(task, std::move(carved.lump), sign, std::move(feature), std::move(own_planes));
    return change;
  }

  /// Takes off a pocket that needs no body of its own: it gets a copy of what becomes of `model`,
  /// or, if there is none, is a leaf.
  detail::Change take_off_pocket(Task& task, const Choice& choice, const detail::Lump& lump,
                                 const detail::Lump* model) {
    const detail::Cap cap = choice.pockets->cap_of(lump.pocket);
    const std::vector<int> facets = choice.pockets->facets_of(lump.pocket);
    std::optional<detail::Congruence> how;
    std::optional<detail::Leaf> leaf;
    if (model != nullptr)
      how = choice.pockets->congruence(model->pocket, lump.pocket);
    else
      leaf = choice.pockets->leaf_of(lump.pocket, facets, choice.is_hole);
    std::vector<int> points = choice.pockets->points_of(lump.pocket);
    const auto filled = fill_pocket(task.body, cap, facets, choice.is_hole, next_feature());
    Feature feature = feature_of(task, choice, {&cap, 1}, {lump.new_area, lump.value});
    feature.cap_point = filled.cap_point;
    feature.surface_m2 = filled.surface;
    feature.volume_m3 = filled.volume;
    feature.vertices = points;
    if (leaf) leaf->volume = filled.volume;
    const int sign = sign_of(feature);
    add_part(task, Boundary(world_), sign, std::move(feature), {});
    tasks_.back().copy_of_model = std::move(how);
    tasks_.back().leaf = std::move(leaf);
    return change_of_pocket(cap, std::move(points));
  }

  [[nodiscard]] FeatureId next_feature() const {
    return FeatureId{static_cast<int>(out_.features.size())};
  }

  /// A part as a feature, as far as its cut tells: its caps, the largest first.
  Feature feature_of(const Task& task, const Choice& choice, std::span<const detail::Cap> caps,
                     Measures measures) {
    Feature feature;
    // A hole in a void is material: the sense is that of the building.
    const bool is_material = choice.is_hole == (task.sign < 0);
    feature.sense = is_material ? Sense::protrusion : Sense::hole;
    feature.value = measures.value;
    feature.quality = measures.new_area / choice.old_area;
    feature.new_area_m2 = measures.new_area;
    feature.old_area_m2 = choice.old_area;
    feature.is_natural = choice.is_natural;
    for (const detail::Cap& cap : caps) {
      const PlaneId plane = cells_.plane_id(task.sign < 0 ? cap.side ^ 1 : cap.side);
      if (std::ranges::find(feature.planes, plane) == feature.planes.end())
        feature.planes.push_back(plane);
    }
    return feature;
  }

  static int sign_of(const Feature& feature) { return feature.sense == Sense::protrusion ? 1 : -1; }

  /// `feature` is measured.
  void add_part(const Task& task, Boundary body, int sign, Feature feature,
                std::vector<int> own_planes) {
    const NodeId id = add_node();
    node(task.node).parts.push_back(id);
    feature.node = id;
    feature.parent = task.feature;
    for (const int v : feature.vertices) feature.box.grow(world_.points.at(v));
    const FeatureId feature_id = next_feature();
    out_.features.push_back(std::move(feature));
    tasks_.emplace_back(std::move(body), id, feature_id, sign, std::move(own_planes));
  }

  void add_leaf(const Task& task, LeafFlag flag) {
    const bool convex = flag == LeafFlag::convex;
    node(task.node).cell = cells_.add(task.body, task.node, task.sign, convex, flag, task.feature);
    if (flag == LeafFlag::budget && !is_out_of_budget_) {
      is_out_of_budget_ = true;
      out_.issues.push_back(building_issue(
          Severity::warning, Code::E502, building_.id,
          fmt::format("the work budget of {} half-edges is used up; the rest stays unsplit",
                      options_.budget)));
    }
  }

  void add_leaf(Task task) {
    node(task.node).cell = cells_.add(std::move(*task.leaf), task.node, task.sign, task.feature);
  }

  void finish() {
    cells_.finish(building_, solid_);
    SegmentationStats& stats = out_.stats;
    stats.leaves = out_.cells.size();
    stats.inner = out_.nodes.size() - stats.leaves;
    stats.recursions = out_.nodes.size();
  }

  const Building& building_;
  const Solid& solid_;
  const SegmentOptions& options_;
  bool keeps_copies_;
  Segmentation out_;
  detail::World world_;
  detail::CellWriter cells_;
  detail::Models models_;
  Side ground_ = -1;
  std::vector<Task> tasks_;
  std::int64_t work_ = 0;
  bool is_body_changed_ = false;  ///< by the cut at work
  bool may_have_parted_ = false;
  bool is_out_of_budget_ = false;
  NodeId parent_of_rest_;
};

}  // namespace

Segmentation segment(const Building& building, const Solid& solid, const SegmentOptions& options) {
  // Hardly any cut fails, and copies for those that may take as long as the cuts.
  try {
    return Segmenter(building, solid, options, false).run();
  } catch (const NoCopy&) {
    return Segmenter(building, solid, options, true).run();
  }
}

}  // namespace oriel
