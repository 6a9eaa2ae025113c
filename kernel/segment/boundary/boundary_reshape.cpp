/// Re-shaping the facets of a boundary: loops made anew, facets merged and parted, seams healed.
#include "kernel/segment/boundary/boundary.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

namespace oriel::detail {

void Boundary::retrace(int f, std::span<const int> extra) {
  const boost::container::small_vector<int, 2> old = facet(f).loops;
  for (const int l : old) detach(l);
  const int first_new = static_cast<int>(loops_.size());
  boost::container::small_vector<int, 4> fresh;
  for (const int e : extra)
    if (edge(e).loop < first_new) fresh.push_back(trace(e));
  for (const int l : old)
    if (edge(loop(l).first).loop == l) fresh.push_back(l);
  for (const int l : fresh) attach(l, f);
  part(f);
}

/// If the facet has several outer loops, all but the first become facets of their own, each with
/// the holes inside it.
void Boundary::part(int f) {
  if (facet(f).outer_loops <= 1) return;
  boost::container::small_vector<int, 4> outer, holes;
  for (const int l : facet(f).loops) (loop(l).is_hole ? holes : outer).push_back(l);
  part(f, {outer.data(), outer.size()}, {holes.data(), holes.size()});
}

void Boundary::part(int f, std::span<const int> outer, std::span<const int> holes) {
  const Vec3 normal = world_->planes.normal(facet(f).side);
  boost::container::small_vector<int, 4> pieces{f};
  std::vector<Outline> shapes;  // asked by holes only
  if (!holes.empty()) shapes.reserve(outer.size());
  for (std::size_t i = 0; !holes.empty() && i < outer.size(); ++i)
    shapes.push_back(outline(outer[i]));
  const std::vector<CapMark> marks = std::exchange(facets_[index(f)].marks, {});
  const Sources sources = facet(f).sources;
  for (std::size_t i = 1; i < outer.size(); ++i) {
    const int piece = add_facet(facet(f).side, sources);
    detach(outer[i]);
    attach(outer[i], piece);
    pieces.push_back(piece);
  }
  for (const int l : holes) {
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

void Boundary::distribute_marks(std::span<const int> pieces, const std::vector<CapMark>& marks) {
  if (marks.empty()) return;
  std::vector<std::vector<Outline>> shapes;
  for (const int f : pieces) shapes.push_back(outlines(f));
  const Vec3 normal = world_->planes.normal(facet(pieces[0]).side);
  for (const CapMark& mark : marks) {
    std::size_t home = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (contains(shapes[i], normal, mark.point)) home = i;
    facets_[index(pieces[home])].marks.push_back(mark);
  }
}

/// Moves all of facet f to `target`, which lies on the same plane.
void Boundary::merge(int target, int f) {
  const boost::container::small_vector<int, 2> loops = facet(f).loops;
  const Sources sources = facet(f).sources;
  std::vector<CapMark> marks = std::move(facets_[index(f)].marks);
  kill_facet(f);
  for (const int l : loops) attach(l, target);
  add_sources(target, sources);
  auto& all = facets_[index(target)].marks;
  all.insert(all.end(), marks.begin(), marks.end());
}

void Boundary::add_sources(int f, const Sources& sources) {
  if (sources.empty()) return;
  auto& all = facets_[index(f)].sources;
  all.insert(all.end(), sources.begin(), sources.end());
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

void Boundary::cover(int cap, int covered) {
  // What lay under the cap is inside the body now: neither its polygons nor its marks are on the
  // surface any more.
  facets_[index(covered)].sources.clear();
  facets_[index(covered)].marks.clear();
  for_each_edge(covered, [&](int e) { edge(e).bend = edge(twin(e)).bend = kUnknown; });
  merge(cap, covered);
}

/// Puts the corners of a facet on those of its edges that they lie on.
void Boundary::split_at_corners(int f) {
  std::vector<int> edges;
  for_each_edge(f, [&](int e) { edges.push_back(e); });
  const std::vector<int> corners = edges;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (const int corner : corners) {
      const int e = edges[i], point = origin(corner);
      const Vec3 p = world_->points.at(point), from = at(e), to = world_->points.at(target(e));
      if (p == from || p == to || distance_to_segment(p, from, to) > world_->points.grid_m())
        continue;
      split_edge(e, point);
      edges.push_back(next(e));
    }
}

void Boundary::zip(int f) {
  split_at_corners(f);
  std::map<std::pair<int, int>, int> open;
  std::vector<std::pair<int, int>> pairs;
  for_each_edge(f, [&](int e) {
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
    const int beyond = twin(e), beyond_against = twin(against);
    pair(e, against);
    pair(beyond, beyond_against);
  }
}

/// Half-edges of the facet whose neighbour lies on the same side or is the facet itself, and their
/// twins; sorted.
std::vector<int> Boundary::seams_of(int cap) const {
  std::vector<int> seams;
  for_each_edge(cap, [&](int e) {
    const int neighbour = facet_of(twin(e));
    if (neighbour != cap && facet(neighbour).side != facet(cap).side) return;
    seams.push_back(e);
    if (neighbour != cap) seams.push_back(twin(e));
  });
  std::ranges::sort(seams);
  return seams;
}

void Boundary::heal(int cap) {
  const std::vector<int> seams = seams_of(cap);
  if (seams.empty()) {
    part(cap);
    return;
  }
  std::vector<int> group{cap};
  for (const int e : seams) group.push_back(facet_of(e));
  std::ranges::sort(group);
  group.erase(std::unique(group.begin(), group.end()), group.end());
  const int target =
      *std::ranges::max_element(group, {}, [&](int f) { return facet(f).loops.size(); });
  for (const int f : group)
    if (f != target) merge(target, f);
  remove_seams(target, seams);
}

void Boundary::remove_seams(int f, const std::vector<int>& seams) {
  std::vector<int> broken;
  for (const int e : seams) broken.push_back(edge(e).loop);
  std::ranges::sort(broken);
  broken.erase(std::unique(broken.begin(), broken.end()), broken.end());
  std::vector<int> kept;
  const auto is_seam = [&](int e) { return std::ranges::binary_search(seams, e); };
  for (const int l : broken) {
    int e = loop(l).first;
    do {
      if (!is_seam(e)) kept.push_back(e);
      e = next(e);
    } while (e != loop(l).first);
    detach(l);
  }
  for (const int e : kept) {
    int after = next(e);
    while (is_seam(after)) after = next(twin(after));
    link(e, after);
  }
  for (const int e : seams) kill_edge(e);
  const int first_new = static_cast<int>(loops_.size());
  for (const int e : kept)
    if (edge(e).loop < first_new) attach(trace(e), f);
  if (facet(f).loops.empty())
    kill_facet(f);
  else
    part(f);
}

}  // namespace oriel::detail
