#include "generalise/invariants/stays.h"
#include "generalise/removal/building_cells.h"
#include "generalise/removal/removal.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/outlines.h"
#include "kernel/segment/complex/body_without.h"
#include "kernel/solidify/solidify.h"
#include "model/building.h"
#include "model/cell_complex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace oriel {

namespace {

/// Where vertices lie off their planes sheets of the complex do not meet: slits stay, as long as an
/// edge of the building and up to some centimetres wide.
constexpr double kSlit_m2 = 0.5;

/// Where a cut passes a vertex by a hair what stays is no solid, or none that is valid in a file,
/// until vertices are put together that lie this many times further apart than weld_m.
constexpr std::array kCoarser{1.0, 4.0, 10.0};

/// A footprint is the same if its area is to this share: half of what levels of detail allow.
constexpr double kFootprint = 0.0005;

/// What cutting cells off and judging what is left takes, for each corner of the solid.
constexpr std::int64_t kStepsPerAttempt = 32;
/// What it takes to see that cells would not hang together.
constexpr std::int64_t kStepsPerLook = 1;

using detail::FaceNames;
using Ids = std::vector<FeatureId>;

class CellRemover {
 public:
  CellRemover(const RedrawContext& context, const Remainder& remainder, double unseen_m)
      : context_(context),
        segmentation_(context.segmentation),
        cells_(context.shared_cells()),
        work_(context.work != nullptr ? *context.work : uncounted_),
        unseen_m_(unseen_m),
        before_(context.before ? *context.before : measures_of(context.solid)),
        footprint_m2_(measures_of(remainder.solid).footprint_m2) {
    for (const FeatureId id : remainder.removed)
      if (!is_carried(id, remainder.removed)) gone_.push_back(id);
  }

  /// What is left of the solid if as many of these go as can. `left`: what is left without those
  /// that are gone already; if that is unfit, as many of them go as can, too.
  std::optional<Solid> run(Ids more, const Solid& left, Fitness fitness) {
    base_ = fitness == Fitness::unfit ? context_.solid : left;
    if (fitness == Fitness::unfit) more.insert(more.end(), gone_.begin(), gone_.end());
    if (fitness == Fitness::unfit) gone_.clear();
    base_gone_ = gone_;
    std::ranges::sort(more);
    // What was not valid as it came need not be, but where it can be it is.
    if (fitness == Fitness::as_it_came)
      attempt(more, Way::anew);
    else
      add_all(more);
    if (has_excused_ || fitness == Fitness::as_it_came) {
      least_ = Fitness::as_it_came;
      add_all(more);
    }
    return std::move(best_);
  }
  /// Why a feature cannot go that was tried on its own; null if that is not known.
  [[nodiscard]] const Refusal* fault_of(FeatureId id) const {
    const auto found = faults_.find(id);
    return found == faults_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] const Ids& gone() const { return gone_; }

 private:
  [[nodiscard]] const Feature& feature(FeatureId id) const { return context_.feature(id); }
  [[nodiscard]] bool is_carried(FeatureId id, const Ids& by) const {
    const auto is_in = [&](FeatureId carrier) {
      return carrier.is_valid() && std::ranges::find(by, carrier) != by.end();
    };
    return is_in(feature(id).parent) || is_in(feature(id).host);
  }

  /// In the planes of the building, or by planes found anew.
  enum class Way { in_planes, anew };

  void add_all(const Ids& more) {
    for (const Way way : {Way::in_planes, Way::anew}) {
      Ids rest = more;
      std::erase_if(rest, [&](FeatureId id) { return std::ranges::binary_search(gone_, id); });
      const auto others = std::ranges::stable_partition(
          rest, [&](FeatureId id) { return std::ranges::binary_search(context_.settled, id); });
      add({rest.begin(), others.begin()}, way);
      add({others.begin(), others.end()}, way);
    }
  }

  /// All of them if they can go together, else those of either half that can.
  void add(const Ids& more, Way way) {
    if (more.empty() || attempt(more, way) || more.size() == 1) return;
    const auto middle = more.begin() + std::ssize(more) / 2;
    add({more.begin(), middle}, way);
    add({middle, more.end()}, way);
  }

  /// Keeps what comes of it if it is a closed solid.
  bool attempt(const Ids& more, Way way) {
    if (!context_.may_go_on(base_, kStepsPerLook)) return false;
    Ids all = gone_;
    all.insert(all.end(), more.begin(), more.end());
    std::ranges::sort(all);
    std::optional<Refusal> fault;
    std::optional<Solid> made;
    if (falls_apart_by_cells(all))
      fault = refusal(fallen_apart());
    else if (more.size() > 1 && is_hopeless(all))
      return false;
    else if (context_.may_go_on(base_, kStepsPerAttempt))
      made = way == Way::in_planes ? taken_out(all, fault) : without(all, fault);
    if (fault && fault->code == Code::G411) has_fallen_apart_ = true;
    if (!made) {
      if (fault && more.size() == 1) faults_.insert_or_assign(more[0], *fault);
      return false;
    }
    gone_ = std::move(all);
    if (way == Way::in_planes) {
      base_ = *made;
      base_gone_ = gone_;
    }
    best_ = std::move(made);
    return true;
  }

  static Refusal refusal(const Violation& broken) { return {{}, broken.sentence, broken.code}; }

  /// The cells tell so, which are asked once something has fallen apart: mostly it is not alone.
  [[nodiscard]] bool falls_apart_by_cells(const Ids& all) {
    if (!has_fallen_apart_ || cells_->complex(work_) == nullptr) return false;
    const auto pieces_without = [&](const Ids& ids) {
      return cells_->contacts().pieces_of(cells_without(fates_of(ids)));
    };
    if (!pieces_) pieces_ = pieces_without({});
    return pieces_without(all) > *pieces_;
  }

  /// What becomes of each feature's cells: material, air, or (nothing) what they were.
  [[nodiscard]] std::vector<std::optional<bool>> fates_of(const Ids& all) const {
    std::vector<std::optional<bool>> fates(segmentation_.features.size());
    for (const FeatureId id : all) fates[id.index()] = feature(id).sense != Sense::protrusion;
    const Ids gone = with_what_sits_on(segmentation_, all);
    const auto fate_of = [&](FeatureId carrier) {
      return carrier.is_valid() ? fates[carrier.index()] : std::optional<bool>();
    };
    // Carriers come before or after what they carry: as often as there are features on each other.
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      for (const FeatureId id : gone) {
        const auto of_parent = fate_of(feature(id).parent);
        const auto fate = of_parent ? of_parent : fate_of(feature(id).host);
        if (!fate || fate == fates[id.index()]) continue;
        fates[id.index()] = fate;
        has_changed = true;
      }
    }
    return fates;
  }

  /// The cells of what is left.
  [[nodiscard]] std::vector<CellId> cells_without(
      const std::vector<std::optional<bool>>& fates) const {
    return cells_where([&](CellId c) {
      return fate_of(c, fates).value_or(segmentation_.cells[c.index()].sign > 0);
    });
  }
  /// The cells of what goes.
  [[nodiscard]] std::vector<CellId> cells_with(
      const std::vector<std::optional<bool>>& fates) const {
    return cells_where([&](CellId c) { return fate_of(c, fates).has_value(); });
  }
  template <class Is>
  [[nodiscard]] std::vector<CellId> cells_where(const Is& is) const {
    std::vector<CellId> cells;
    for (const CellId c : ids_below<CellId>(segmentation_.cells.size()))
      if (is(c)) cells.push_back(c);
    return cells;
  }
  [[nodiscard]] std::optional<bool> fate_of(CellId cell,
                                            const std::vector<std::optional<bool>>& fates) const {
    const FeatureId feature = segmentation_.cells[cell.index()].feature;
    return feature.is_valid() ? fates[feature.index()] : std::optional<bool>();
  }

  /// What the cells say of the building without some features.
  struct Draft {
    Building shell;  ///< polygon i is of face i
    std::vector<Face> faces;
    std::vector<FaceId> numbers{};  ///< of the faces, in the complex
    double volume_m3 = 0;
    double area_m2 = 0;
  };

  [[nodiscard]] Draft draft_of(const CellComplex& complex, const std::vector<CellId>& cells) const {
    Draft draft;
    std::map<int, int> numbers;  // vertices that no face uses may lie anywhere
    const auto number = [&](int v) {
      const auto [entry, is_new] = numbers.emplace(v, static_cast<int>(numbers.size()));
      if (is_new) draft.shell.vertices.push_back(complex.vertices()[at(v)].point);
      return entry->second;
    };
    for (const BoundaryFace& part : complex.boundary(cells)) {
      Face& face = draft.faces.emplace_back(complex.face(part.face));
      draft.numbers.push_back(part.face);
      Polygon polygon;
      for (Loop& ring : face.loops) {
        for (int& v : ring) v = number(v);
        polygon.rings.emplace_back(ring);
        if (part.is_reversed) std::ranges::reverse(polygon.rings.back());
      }
      polygon.source = static_cast<int>(draft.shell.polygons.size());
      draft.shell.polygons.push_back(std::move(polygon));
      draft.volume_m3 += (part.is_reversed ? -1 : 1) * face.area_m2 *
                         segmentation_.planes[face.plane.index()].offset_m / 3;
      draft.area_m2 += face.area_m2;
    }
    return draft;
  }

  /// What is left without these features, in the planes of the building; nothing if it would not
  /// do.
  std::optional<Solid> taken_out(const Ids& all, std::optional<Refusal>& fault) {
    const auto before = fates_of(base_gone_), after = fates_of(all);
    std::vector<CellId> leaves = cells_with(after);
    std::erase_if(leaves, [&](CellId cell) { return fate_of(cell, before).has_value(); });
    auto made = detail::take_out(base_, segmentation_, cells_->vertices(), leaves,
                                 tolerances().weld_m, work_);
    if (!made) return std::nullopt;
    const Ids gone = with_what_sits_on(segmentation_, all);
    fault = fault_of(*made, gone, tolerances(), [&] {
      const std::set<int> lost = polygons_of(gone);
      for (Facet& facet : made->facets) {
        const auto polygons = cells_->polygons_around().of(outlines_of(made->vertices, facet.loops),
                                                           made->planes[facet.plane.index()]);
        std::ranges::set_difference(polygons, lost, std::back_inserter(facet.polygons));
      }
    });
    if (fault) return std::nullopt;
    return made;
  }

  /// The solid without these features, put together anew; nothing if it would not do.
  std::optional<Solid> without(const Ids& all, std::optional<Refusal>& fault) {
    const Ids gone = with_what_sits_on(segmentation_, all);
    const auto fates = fates_of(all);
    const CellComplex* complex = cells_->complex(work_);
    if (complex == nullptr) return std::nullopt;
    const Draft draft = draft_of(*complex, cells_without(fates));
    auto made = solid_of(draft, gone, cells_->names(), fault);
    // Cells that others cut through meet where all planes of the building do; what goes meets the
    // building in a few of them.
    if (made) return made;
    if (cells_->is_closed() && lacks_what_stays(draft.numbers, cells_->names(), gone)) return made;
    const auto body =
        body_without(context_.solid, segmentation_, cells_->vertices(), cells_with(fates), work_);
    if (!body) return std::nullopt;
    FaceNames names(*body, cells_->polygons_around(), segmentation_);
    return solid_of(draft_of(*body, {CellId{0}}), gone, names, fault);
  }

  /// A solid of these faces that does, with vertices as near to each other as that takes.
  std::optional<Solid> solid_of(const Draft& draft, const Ids& gone, FaceNames& names,
                                std::optional<Refusal>& fault) {
    Work uncounted(kWorkBudget);
    for (const double coarser : kCoarser) {
      if (context_.has_no_work_left()) break;
      Tolerances tolerances = context_.options.tolerances;
      tolerances.weld_m *= coarser;
      auto made = solidify(draft.shell, tolerances, {Closing::planar, kSlit_m2},
                           context_.work != nullptr ? *context_.work : uncounted);
      if (!made.value || !is_closed(*made.value) ||
          std::abs(volume_m3(*made.value) - draft.volume_m3) > tolerances.weld_m * draft.area_m2)
        continue;
      fault = fault_of(*made.value, gone, tolerances,
                       [&] { name_polygons(*made.value, draft, gone, names); });
      if (!fault) return std::move(made.value);
      if (lacks_what_stays(draft.numbers, names, gone)) break;
    }
    return std::nullopt;
  }

  /// Why a solid made of the complex does not do: it falls apart, filled holes reach out of the
  /// building's box, the footprint changes by more than what goes covers, more has changed than the
  /// features hold, it is not valid, or what stays has no surface. `name_polygons` is called before
  /// the last is asked.
  template <class Name>
  [[nodiscard]] std::optional<Refusal> fault_of(const Solid& made, const Ids& gone,
                                                const Tolerances& tolerances,
                                                const Name& name_polygons) {
    const Measures after = measures_of(made, context_.invariants);
    if (const auto broken = falls_apart(before_, after)) return refusal(*broken);
    // The planes are found anew, and a vertex may lie so far off its own.
    const double slack_m = tolerances.weld_m + tolerances.plane_offset_m + unseen_m_;
    if (const auto broken = reaches_out(before_, after, slack_m)) return refusal(*broken);
    if (context_.before)
      if (const auto broken = violation(before_, after, context_.invariants))
        return refusal(*broken);
    double most_m3 = tolerances.weld_m * surface_m2(context_.solid);
    for (const FeatureId id : gone) most_m3 += feature(id).volume_m3;
    const Refusal invalid{{}, "removing it would leave no valid solid"};
    if (std::abs(after.footprint_m2 - footprint_m2_) >
            kFootprint * footprint_m2_ + ground_below_m2(gone) ||
        std::abs(after.volume_m3 - before_.volume_m3) > most_m3)
      return invalid;
    name_polygons();
    if (detail::loses_what_stays(cells_->named(), detail::polygons_named(made), segmentation_,
                                 gone) ||
        !is_fit(made))
      return invalid;
    return std::nullopt;
  }

  [[nodiscard]] bool is_fit(const Solid& made) {
    const Fitness fitness = context_.judge->fitness_of(made);
    has_excused_ |= fitness == Fitness::as_it_came;
    return fitness >= least_;
  }

  /// How much of the ground these features cover at most.
  [[nodiscard]] double ground_below_m2(const Ids& gone) const {
    const double ground_m = before_.box.min.z + kGroundReach_m;
    double area_m2 = 0;
    for (const FeatureId id : gone) {
      const Vec3 size = feature(id).box.max - feature(id).box.min;
      if (feature(id).box.min.z <= ground_m) area_m2 += size.x * size.y;
    }
    return area_m2;
  }

  /// The input polygons of features.
  [[nodiscard]] std::set<int> polygons_of(const Ids& features) const {
    std::set<int> polygons;
    for (const FeatureId id : features)
      polygons.insert(feature(id).source_polygons.begin(), feature(id).source_polygons.end());
    return polygons;
  }

  /// Facets of the solid made name faces of the draft; then the input polygons of the facets of
  /// the solid that these lie in, but for those of features that are gone.
  void name_polygons(Solid& made, const Draft& draft, const Ids& gone, FaceNames& names) const {
    const std::set<int> lost = polygons_of(gone);
    for (Facet& facet : made.facets) {
      std::vector<int> polygons;
      for (const int i : facet.polygons) {
        const std::vector<int>& its = names.of(draft.numbers[at(i)]);
        polygons.insert(polygons.end(), its.begin(), its.end());
      }
      std::ranges::sort(polygons);
      polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
      std::erase_if(polygons, [&](int polygon) { return lost.contains(polygon); });
      facet.polygons = std::move(polygons);
    }
  }

  /// A feature that stays has none of these faces: no solid of them does.
  [[nodiscard]] bool lacks_what_stays(const std::vector<FaceId>& faces, FaceNames& names,
                                      const Ids& gone) const {
    const std::set<int> lost = polygons_of(gone);
    std::set<int> named;
    for (const FaceId face : faces)
      for (const int polygon : names.of(face))
        if (!lost.contains(polygon)) named.insert(polygon);
    return detail::loses_what_stays(cells_->named(), named, segmentation_, gone);
  }

  /// The cells tell so, where they are known.
  [[nodiscard]] bool is_hopeless(const Ids& all) {
    const CellComplex* complex = cells_->known_complex();
    if (complex == nullptr || !cells_->is_closed()) return false;
    std::vector<FaceId> faces;
    for (const BoundaryFace& part : complex->boundary(cells_without(fates_of(all))))
      faces.push_back(part.face);
    return lacks_what_stays(faces, cells_->names(), with_what_sits_on(segmentation_, all));
  }

  [[nodiscard]] const Tolerances& tolerances() const { return context_.options.tolerances; }

  const RedrawContext& context_;
  const Segmentation& segmentation_;
  std::shared_ptr<detail::BuildingCells> cells_;
  Work uncounted_;
  Work& work_;
  double unseen_m_;
  Measures before_;
  double footprint_m2_;
  std::optional<int> pieces_{};  ///< of the building, by its cells
  bool has_fallen_apart_ = false;
  std::map<FeatureId, Refusal> faults_;
  Ids gone_;  ///< in order; without what goes along
  Ids base_gone_;
  Solid base_;  ///< what is left without base_gone_, in the planes of the building
  Fitness least_ = Fitness::valid;
  bool has_excused_ = false;  ///< something was not valid, but the building was not either
  std::optional<Solid> best_;
};

}  // namespace

Remainder remove_cells(const RedrawContext& context, Remainder remainder, double unseen_m) {
  Ids refused;
  for (const Refusal& refusal : remainder.refused) {
    const Feature& feature = context.feature(refusal.feature);
    if (feature.node.is_valid() && feature.sense != Sense::imprint)
      refused.push_back(refusal.feature);
  }
  if (refused.empty() && !context.judges_all) return remainder;
  const Fitness fitness =
      remainder.solid.facets.empty() ? Fitness::valid : context.judge->fitness_of(remainder.solid);
  if (refused.empty() && fitness != Fitness::unfit) return remainder;
  CellRemover remover(context, remainder, unseen_m);
  auto made = remover.run(std::move(refused), remainder.solid, fitness);
  for (Refusal& refusal : remainder.refused)
    if (const Refusal* fault = remover.fault_of(refusal.feature);
        fault && fault->code != Code::G401)
      refusal = {refusal.feature, fault->reason, fault->code};
  if (!made) return remainder;
  remainder.solid = std::move(*made);
  const Ids asked = std::move(remainder.removed);
  remainder.removed = with_what_sits_on(context.segmentation, remover.gone());
  for (const FeatureId id : asked)
    if (!std::ranges::binary_search(remainder.removed, id))
      remainder.refused.push_back({id, "removing it would leave no valid solid"});
  std::ranges::sort(remainder.refused, {}, &Refusal::feature);
  std::erase_if(remainder.refused, [&](const Refusal& refusal) {
    return std::ranges::binary_search(remainder.removed, refusal.feature);
  });
  return remainder;
}

}  // namespace oriel
