#include "kernel/blocks/plan_view.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>

namespace oriel::detail {

namespace {

constexpr Vec3 kUp{0, 0, 1};

}  // namespace

PlanView::PlanView(const Solid& solid, double ground_reach_m, double reach_m, Work& work)
    : solid_(solid), pool_({}, reach_m), is_ground_(solid.facets.size(), 0) {
  const double lowest_m = box_of(solid).min.z;
  ground_m_ = Box::kInfinity;
  std::vector<Chord> chords;
  for (int f = 0; f < std::ssize(solid.facets); ++f) {
    const Facet& facet = solid.facets[at(f)];
    const auto up = solid.planes[facet.plane.index()].coefficients[2];
    if (up > 0) add_outlines(f, false, chords);
    if (up >= 0) continue;
    double high_m = -Box::kInfinity, low_m = Box::kInfinity;
    for (const int v : facet.loops[0]) {
      high_m = std::max(high_m, solid.vertices[at(v)].point.z);
      low_m = std::min(low_m, solid.vertices[at(v)].point.z);
    }
    if (high_m > lowest_m + ground_reach_m) continue;
    is_ground_[at(f)] = 1;
    ground_m_ = std::min(ground_m_, low_m);
    add_outlines(f, true, chords);
  }
  if (ground_m_ == Box::kInfinity) ground_m_ = lowest_m;
  const PlaneAxes axes(kUp);
  edges_ = refine(std::move(chords), axes, pool_, work);
  arrangement_ = std::make_unique<Arrangement>(edges_, axes, pool_);
  trace_regions();
  find_tops();
}

/// Seen from above, facets that look down run the other way.
void PlanView::add_outlines(int facet, bool is_reversed, std::vector<Chord>& chords) {
  for (const Loop& loop : solid_.facets[at(facet)].loops) {
    Loop flat;
    for (const int v : loop) {
      const Vec3 p = solid_.vertices[at(v)].point;
      flat.push_back(pool_.find_or_add({p.x, p.y, 0}));
    }
    if (is_reversed) std::ranges::reverse(flat);
    for (std::size_t i = 0; i < flat.size(); ++i)
      if (const int to = flat[(i + 1) % flat.size()]; to != flat[i])
        chords.push_back({flat[i], to, facet, 1});
  }
}

void PlanView::trace_regions() {
  regions_.resize(arrangement_->region_count());
  std::vector<char> is_traced(arrangement_->half_edge_count(), 0);
  std::vector<double> border_m(regions_.size(), 0);
  for (std::size_t start = 0; start < is_traced.size(); ++start) {
    if (is_traced[start] != 0) continue;
    Outline outline;
    for (std::size_t h = start; is_traced[h] == 0; h = arrangement_->next(h)) {
      is_traced[h] = 1;
      outline.push_back(point(arrangement_->origin(h)));
    }
    const std::size_t r = arrangement_->region(start);
    regions_[r].area_m2 += signed_area(outline, kUp);
    border_m[r] += perimeter(outline);
    regions_[r].outlines.push_back(std::move(outline));
  }
  for (std::size_t r = 1; r < regions_.size(); ++r)
    regions_[r].is_thin = regions_[r].area_m2 < pool_.reach_m() * border_m[r];
}

void PlanView::find_tops() {
  const auto labels = arrangement_->labels();
  for (std::size_t r = 1; r < regions_.size(); ++r) {
    PlanRegion& region = regions_[r];
    const auto inside = interior_point(region.outlines, kUp);
    double best_m = -Box::kInfinity;
    for (const int facet : labels[r]) {
      if (is_ground_[at(facet)] != 0) {
        region.is_on_ground = true;
        continue;
      }
      const double here_m = height_m(facet, inside.value_or(region.outlines[0][0]));
      if (here_m <= best_m) continue;
      best_m = here_m;
      region.top = facet;
    }
  }
}

double PlanView::height_m(int facet, Vec3 point) const {
  const Plane& plane = solid_.planes[solid_.facets[at(facet)].plane.index()];
  const Vec3& n = plane.normal;
  return (plane.offset_m - n.x * point.x - n.y * point.y) / n.z;
}

}  // namespace oriel::detail
