/// Re-shaping the facets of a boundary: loops made anew, facets merged and parted, seams healed.
#include "kernel/base/assert.h"
#include "kernel/segment/boundary/boundary.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace oriel::detail {

void Boundary::retrace(BodyFacetId f, std::span<const EdgeId> extra) {
  const boost::container::small_vector<LoopId, 2> old = facet(f).loops;
  for (const LoopId l : old) detach(l);
  const LoopId first_new = loops_.next_id();
  boost::container::small_vector<LoopId, 4> fresh;
  for (const EdgeId e : extra)
    if (edge(e).loop < first_new) fresh.push_back(trace(e));
  for (const LoopId l : old)
    if (edge(loop(l).first).loop == l) fresh.push_back(l);
  for (const LoopId l : fresh) attach(l, f);
  part(f);
}

/// If the facet has several outer loops, all but the first become facets of their own, each with
/// the holes inside it.
void Boundary::part(BodyFacetId f) {
  if (facet(f).outer_loops <= 1) return;
  boost::container::small_vector<LoopId, 4> outer, holes;
  for (const LoopId l : facet(f).loops) (loop(l).is_hole ? holes : outer).push_back(l);
  part(f, {outer.data(), outer.size()}, {holes.data(), holes.size()});
}

void Boundary::part(BodyFacetId f, std::span<const LoopId> outer, std::span<const LoopId> holes) {
  const Vec3 normal = world_->planes.normal(facet(f).side);
  boost::container::small_vector<BodyFacetId, 4> pieces{f};
  std::vector<Outline> shapes;  // asked by holes only
  if (!holes.empty()) shapes.reserve(outer.size());
  for (std::size_t i = 0; !holes.empty() && i < outer.size(); ++i)
    shapes.push_back(outline(outer[i]));
  const std::vector<CapMark> marks = std::exchange(facets_[f].marks, {});
  const Sources sources = facet(f).sources;
  for (std::size_t i = 1; i < outer.size(); ++i) {
    const BodyFacetId piece = add_facet(facet(f).side, sources);
    detach(outer[i]);
    attach(outer[i], piece);
    pieces.push_back(piece);
  }
  for (const LoopId l : holes) {
    // The smallest outer loop around a point of the hole that is no vertex of it.
    const auto inside = interior_point(std::array{outline(l)}, normal);
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; inside && i < outer.size(); ++i) {
      const double area = loop(outer[i]).area;
      if (area >= least || area <= -loop(l).area || !contains({&shapes[i], 1}, normal, *inside))
        continue;
      best = i;
      least = area;
    }
    if (best == 0) continue;
    detach(l);
    attach(l, pieces[best]);
  }
  distribute_marks({pieces.data(), pieces.size()}, marks);
}

void Boundary::distribute_marks(std::span<const BodyFacetId> pieces,
                                std::span<const CapMark> marks) {
  if (marks.empty()) return;
  std::vector<std::vector<Outline>> shapes;
  for (const BodyFacetId f : pieces) shapes.push_back(outlines(f));
  const Vec3 normal = world_->planes.normal(facet(pieces[0]).side);
  for (const CapMark& mark : marks) {
    std::size_t home = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (contains(shapes[i], normal, mark.point)) home = i;
    facets_[pieces[home]].marks.push_back(mark);
  }
}

/// Moves all of facet f to `target`, which lies on the same plane.
void Boundary::merge(BodyFacetId target, BodyFacetId f) {
  ORIEL_ASSERT(target != f && is_alive(target) && is_alive(f));
  const boost::container::small_vector<LoopId, 2> loops = facet(f).loops;
  const Sources sources = facet(f).sources;
  std::vector<CapMark> marks = std::move(facets_[f].marks);
  kill_facet(f);
  for (const LoopId l : loops) attach(l, target);
  add_sources(target, sources);
  auto& all = facets_[target].marks;
  all.insert(all.end(), marks.begin(), marks.end());
}

void Boundary::add_sources(BodyFacetId f, const Sources& sources) {
  if (sources.empty()) return;
  auto& all = facets_[f].sources;
  all.insert(all.end(), sources.begin(), sources.end());
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

void Boundary::cover(BodyFacetId cap, BodyFacetId covered) {
  ORIEL_ASSERT(facet(cap).side == (facet(covered).side ^ 1), "they do not face each other");
  // What lay under the cap is inside the body now: neither its polygons nor its marks are on the
  // surface any more.
  facets_[covered].sources.clear();
  facets_[covered].marks.clear();
  for_each_edge(covered, [&](EdgeId e) { edge(e).bend = edge(twin(e)).bend = kUnknown; });
  merge(cap, covered);
}

/// Puts the corners of a facet on those of its edges that they lie on, each once on each edge: two
/// corners that are closer than the grid each lie on every piece that ends at the other one.
void Boundary::split_at_corners(BodyFacetId f) {
  struct Piece {
    EdgeId edge;
    std::size_t of;  ///< the edge it is a piece of, by its place among the corners
  };
  std::vector<EdgeId> corners;
  for_each_edge(f, [&](EdgeId e) { corners.push_back(e); });
  std::vector<Piece> pieces;
  for (const EdgeId e : corners) pieces.push_back({e, pieces.size()});
  std::set<std::pair<std::size_t, PointId>> put;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const EdgeId corner : corners) {
      const auto [e, of] = pieces[i];
      const PointId point = origin(corner);
      const Vec3 p = world_->points.at(point), from = at(e), to = world_->points.at(target(e));
      if (p == from || p == to || distance_to_segment(p, from, to) > world_->points.grid_m())
        continue;
      if (!put.emplace(of, point).second) continue;
      split_edge(e, point);
      pieces.push_back({next(e), of});
    }
}

void Boundary::zip(BodyFacetId f) {
  split_at_corners(f);
  std::map<std::pair<PointId, PointId>, EdgeId> open;
  std::vector<std::pair<EdgeId, EdgeId>> pairs;
  for_each_edge(f, [&](EdgeId e) {
    if (facet_of(twin(e)) == f) return;
    const auto against = open.find({target(e), origin(e)});
    if (against == open.end()) {
      open.emplace(std::pair(origin(e), target(e)), e);
    } else {
      pairs.emplace_back(e, against->second);
      open.erase(against);
    }
  });
  for (const auto& [e, against] : pairs) {
    const EdgeId beyond = twin(e), beyond_against = twin(against);
    pair(e, against);
    pair(beyond, beyond_against);
  }
}

/// Half-edges of the facet whose neighbour lies on the same side or is the facet itself, and their
/// twins; sorted.
std::vector<EdgeId> Boundary::seams_of(BodyFacetId cap) const {
  std::vector<EdgeId> seams;
  for_each_edge(cap, [&](EdgeId e) {
    const BodyFacetId neighbour = facet_of(twin(e));
    if (neighbour != cap && facet(neighbour).side != facet(cap).side) return;
    seams.push_back(e);
    if (neighbour != cap) seams.push_back(twin(e));
  });
  std::ranges::sort(seams);
  return seams;
}

void Boundary::heal(BodyFacetId cap) {
  ORIEL_ASSERT(is_alive(cap));
  const std::vector<EdgeId> seams = seams_of(cap);
  if (seams.empty()) {
    part(cap);
    return;
  }
  std::vector<BodyFacetId> group{cap};
  for (const EdgeId e : seams) group.push_back(facet_of(e));
  std::ranges::sort(group);
  group.erase(std::unique(group.begin(), group.end()), group.end());
  const BodyFacetId target =
      *std::ranges::max_element(group, {}, [&](BodyFacetId f) { return facet(f).loops.size(); });
  for (const BodyFacetId f : group)
    if (f != target) merge(target, f);
  remove_seams(target, seams);
}

void Boundary::remove_seams(BodyFacetId f, std::span<const EdgeId> seams) {
  std::vector<LoopId> broken;
  for (const EdgeId e : seams) broken.push_back(edge(e).loop);
  std::ranges::sort(broken);
  broken.erase(std::unique(broken.begin(), broken.end()), broken.end());
  std::vector<EdgeId> kept;
  const auto is_seam = [&](EdgeId e) { return std::ranges::binary_search(seams, e); };
  for (const LoopId l : broken) {
    EdgeId e = loop(l).first;
    do {
      if (!is_seam(e)) kept.push_back(e);
      e = next(e);
    } while (e != loop(l).first);
    detach(l);
  }
  for (const EdgeId e : kept) {
    EdgeId after = next(e);
    while (is_seam(after)) after = next(twin(after));
    link(e, after);
  }
  for (const EdgeId e : seams) kill_edge(e);
  const LoopId first_new = loops_.next_id();
  for (const EdgeId e : kept)
    if (edge(e).loop < first_new) attach(trace(e), f);
  if (facet(f).loops.empty())
    kill_facet(f);
  else
    part(f);
}

}  // namespace oriel::detail
