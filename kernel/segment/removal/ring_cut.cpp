#include "kernel/segment/removal/ring_cut.h"

#include "kernel/base/index.h"
#include "kernel/geometry/boxes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oriel::detail {

namespace {

std::array<double, 3> coordinates_of(Vec3 p) { return {p.x, p.y, p.z}; }

bool is_in_box(const Box& box, Vec3 p) {
  return box.min.x <= p.x && p.x <= box.max.x && box.min.y <= p.y && p.y <= box.max.y &&
         box.min.z <= p.z && p.z <= box.max.z;
}

/// Looks at one ring: a hole of a facet, and what hangs on it.
class RingFlood {
 public:
  RingFlood(const Boundary& body, PlaneSide looking, bool is_material)
      : body_(body),
        scratch_(body.world().scratch),
        looking_(looking),
        is_material_(is_material),
        direction_((looking & 1) == 0 ? 1 : -1),
        ranks_(body.world().points.ranks(body.world().planes.class_of(looking >> 1))),
        plane_rank_(body.world().planes.rank_of(looking >> 1)) {}

  /// True if a section just in front of the ring's plane meets what hangs on it in the ring alone,
  /// and that is sound. Its points are in scratch.met_points from then on.
  bool run(LoopId ring) { return trace_rim(ring) && flood() && volume(ring) > 0 && !is_covered(); }

  /// As the section would have it: from its least crossing on.
  [[nodiscard]] const std::vector<EdgeId>& rim() const { return rim_; }
  /// Of all that hangs on the ring.
  [[nodiscard]] const Box& box() const { return box_; }

 private:
  /// Above 0 where the section looks.
  [[nodiscard]] int level(PointId point) const {
    return (ranks_[point] - plane_rank_) * direction_;
  }
  [[nodiscard]] bool is_rim(EdgeId e) const { return scratch_.rim_edges.contains(e); }

  /// The half-edges inside the ring. From each of its corners one edge leads up, and no more.
  bool trace_rim(LoopId ring) {
    scratch_.rim_edges.start(body_.half_edge_count());
    const EdgeId first = body_.loop(ring).first;
    EdgeId beyond = first;
    do {
      const EdgeId e = body_.twin(beyond), up = body_.next(e);
      beyond = body_.prev(beyond);
      if (level(body_.origin(e)) != 0 || level(body_.target(up)) <= 0 ||
          body_.next(body_.twin(up)) != body_.twin(beyond))
        return false;
      rim_.push_back(e);
      scratch_.rim_edges.insert(e);
      rim_box_.grow(body_.at(e));
    } while (beyond != first);
    const auto crossing = [&](EdgeId e) { return body_.prev(e); };
    std::ranges::rotate(rim_, std::ranges::min_element(rim_, {}, crossing));
    return true;
  }

  /// Takes in what hangs together inside the rim. False if it meets the plane elsewhere, or a facet
  /// at the ring has more than one edge there, or other loops.
  bool flood() {
    scratch_.facets_of_lump.start(body_.facet_count());
    scratch_.met_points.start(body_.world().points.size());
    for (const EdgeId e : rim_) {
      const BodyFacetId f = body_.facet_of(e);
      if (!scratch_.facets_of_lump.insert(f) || body_.facet(f).loops.size() != 1 ||
          body_.area(f) <= 0)
        return false;
      facets_.push_back(f);
    }
    bool is_clear = true;
    for (std::size_t i = 0; is_clear && i < facets_.size(); ++i)
      body_.for_each_edge(facets_[i], [&](EdgeId e) {
        const int its = level(body_.origin(e));
        is_clear &= its > 0 || (its == 0 && (is_rim(e) || is_rim(body_.prev(e))));
        scratch_.met_points.insert(body_.origin(e));
        box_.grow(body_.at(e));
        const BodyFacetId next = body_.facet_of(body_.twin(e));
        if (!is_rim(e) && scratch_.facets_of_lump.insert(next)) facets_.push_back(next);
      });
    return is_clear;
  }

  /// As LumpFinder has it.
  [[nodiscard]] double volume(LoopId ring) const {
    const PlaneTable& planes = body_.world().planes;
    double sum = 0;
    for (const BodyFacetId f : facets_)
      sum += planes.offset_m(body_.facet(f).side) * body_.area(f) / 3;
    return (is_material_ ? 1 : -1) * sum -
           planes.offset_m(looking_) * std::abs(body_.loop(ring).area) / 3;
  }

  /// Facets of the other side lie in the plane over the ring, or near it.
  [[nodiscard]] bool is_covered() const {
    const PlaneSide opposite = is_material_ ? looking_ ^ 1 : looking_;
    if (!body_.on_plane(looking_ >> 1).has_facets[at(opposite & 1)]) return false;
    return std::ranges::any_of(body_.facets_on(opposite), [&](BodyFacetId f) {
      Box box;
      body_.for_each_edge(f, [&](EdgeId e) { box.grow(body_.at(e)); });
      return overlap(box, rim_box_);
    });
  }

  const Boundary& body_;
  Scratch& scratch_;
  PlaneSide looking_;
  bool is_material_;
  int direction_;
  PointRanks ranks_;
  int plane_rank_;
  std::vector<EdgeId> rim_;
  std::vector<BodyFacetId> facets_;
  Box rim_box_, box_;
};

/// The hole of a facet of a side that one of a facet's half-edges lies at.
LoopId ring_at(const Boundary& body, BodyFacetId f, PlaneSide side) {
  LoopId ring;
  body.for_each_edge(f, [&](EdgeId e) {
    const EdgeId beyond = body.twin(e);
    if (body.side_of_edge(beyond) == side && body.loop(body.edge(beyond).loop).is_hole)
      ring = body.edge(beyond).loop;
  });
  return ring;
}

CutCap cap_around(const Boundary& body, PlaneSide side, const std::vector<EdgeId>& rim) {
  CutCap cap{side, {}, {}};
  CapLoop& loop = cap.loops.emplace_back();
  loop.edges.reserve(rim.size());
  for (const EdgeId e : rim) loop.edges.push_back({e, body.origin(e), body.target(e)});
  return cap;
}

bool has_inside(const Boundary& body, const CutCap& cap, Vec3 point) {
  Outline shape;
  for (const CapEdge& edge : cap.loops[0].edges) shape.push_back(body.world().points.at(edge.from));
  return contains({&shape, 1}, body.world().planes.plane(cap.side >> 1).normal, point);
}

}  // namespace

RingCuts::RingCuts(const Boundary& body)
    : first_(at(body.world().points.size()) + 1, 0), next_fresh_{body.half_edge_count()} {
  for (const BodyFacetId f : body.living_facets())
    for (const FacetId source : body.facet(f).sources) {
      if (!facet_of_source_.contains(source)) facet_of_source_.resize(source.index() + 1);
      facet_of_source_[source] = f;
    }
  const auto all = ids_below<EdgeId>(at(body.half_edge_count()));
  for (const EdgeId e : all)
    if (body.is_alive_edge(e)) ++first_[PointId{body.origin(e).value + 1}];
  for (std::size_t p = 1; p < first_.size(); ++p)
    first_[PointId{static_cast<int>(p)}] += first_[PointId{static_cast<int>(p) - 1}];
  leaving_.resize(at(first_[PointId{body.world().points.size()}]));
  std::vector<int> filled(first_.size(), 0);
  Box box;
  for (const EdgeId e : all) {
    if (!body.is_alive_edge(e)) continue;
    const PointId p = body.origin(e);
    leaving_[at(first_[p] + filled[p.index()]++)] = e;
    box.grow(body.at(e));
  }
  const auto sides = coordinates_of(box.max - box.min);
  axis_ = static_cast<int>(std::ranges::max_element(sides) - sides.begin());
  for (const PointId p : body.world().points.ids())
    if (filled[p.index()] > 0)
      placed_.push_back({coordinates_of(body.world().points.at(p))[at(axis_)], p});
  std::ranges::sort(placed_, {}, &PlacedPoint::along);
}

bool RingCuts::is_living(const Boundary& body, PointId point) const {
  const int last = first_[PointId{point.value + 1}];
  for (int i = first_[point]; i < last; ++i)
    if (body.is_alive_edge(leaving_[at(i)])) return true;
  return false;
}

/// A vertex that is none of the part lies in its box: what else is inside it has one.
bool RingCuts::has_others_inside(const Boundary& body, const Box& box) {
  for (; next_fresh_.value < body.half_edge_count(); ++next_fresh_.value)
    if (body.is_alive_edge(next_fresh_)) fresh_.push_back(next_fresh_);
  const StampSet<PointId>& of_part = body.world().scratch.met_points;
  const auto is_other = [&](PointId p) {
    return !of_part.contains(p) && is_in_box(box, body.world().points.at(p));
  };
  if (std::ranges::any_of(
          fresh_, [&](EdgeId e) { return body.is_alive_edge(e) && is_other(body.origin(e)); }))
    return true;
  const double from = coordinates_of(box.min)[at(axis_)], to = coordinates_of(box.max)[at(axis_)];
  for (auto one = std::ranges::lower_bound(placed_, from, {}, &PlacedPoint::along);
       one != placed_.end() && one->along <= to; ++one)
    if (is_other(one->point) && is_living(body, one->point)) return true;
  return false;
}

std::optional<std::vector<CutCap>> RingCuts::find(const Boundary& body, int plane, int direction,
                                                  bool is_material, Vec3 point,
                                                  std::span<const FacetId> sources) {
  const PlaneSide looking = 2 * plane + (direction > 0 ? 0 : 1);
  const PlaneSide side = is_material ? looking : looking ^ 1;
  LoopId tried;
  for (const FacetId source : sources) {
    if (!facet_of_source_.contains(source)) continue;
    const BodyFacetId f = facet_of_source_[source];
    if (!f.is_valid() || !body.is_alive(f)) continue;
    const LoopId ring = ring_at(body, f, side);
    if (!ring.is_valid() || ring == tried) continue;
    tried = ring;
    RingFlood flood(body, looking, is_material);
    if (!flood.run(ring) || has_others_inside(body, flood.box())) continue;
    CutCap cap = cap_around(body, side, flood.rim());
    if (has_inside(body, cap, point)) return std::vector{std::move(cap)};
  }
  return std::nullopt;
}

}  // namespace oriel::detail
