#include "kernel/segment/cuts/lump.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"

#include <algorithm>

namespace oriel::detail {

LumpFinder::LumpFinder(const Boundary& body, const Section& section)
    : body_(body),
      section_(section),
      ranks_(body.world().points.ranks(body.world().planes.class_of(section.plane))),
      plane_rank_(body.world().planes.rank_of(section.plane)),
      scratch_(body.world().scratch),
      next_in_facet_(section.crossings.size()),
      previous_(section.crossings.size()),
      region_of_(section.loops.size()),
      crossing_stamp_(section.crossings.size(), 0) {
  if (scratch_.crossing_of_edge.size() < at(body.half_edge_count()))
    scratch_.crossing_of_edge.resize(at(body.half_edge_count()));
  if (scratch_.last_chord_in.size() < at(body.facet_count()))
    scratch_.last_chord_in.resize(at(body.facet_count()));
  scratch_.facets_with_chord.start(body.facet_count());
  for (const CrossingId c : section.crossings.ids()) {
    const Crossing& crossing = section.crossings[c];
    scratch_.crossing_of_edge[crossing.edge] = c;
    previous_[crossing.next] = c;
    const BodyFacetId f = body.facet_of(crossing.edge);
    if (!scratch_.facets_with_chord.insert(f)) next_in_facet_[c] = scratch_.last_chord_in[f];
    scratch_.last_chord_in[f] = c;
  }
  for (const RegionId r : section.regions.ids())
    for (const SectionLoopId l : section.regions[r].loops)
      region_of_[l][section.regions[r].is_material ? 1 : 0] = r;
}

Lump LumpFinder::find(RegionId region) {
  const Region& start = section_.regions[region];
  is_material_ = start.is_material;
  ++stamp_;
  scratch_.flooded_edges.start(body_.half_edge_count());
  scratch_.flooded_facets.start(body_.facet_count());
  steps_ = 0;
  stack_.clear();
  facets_.clear();
  patch_volume_ = 0;
  lump_ = {};
  for (const SectionLoopId l : start.loops) push(section_.crossings[section_.loops[l].first].edge);
  do {
    while (!stack_.empty()) {
      const EdgeId e = stack_.back();
      stack_.pop_back();
      ++steps_;
      visit(e);
      if (!lump_.is_finite || !lump_.is_sound) return lump_;
    }
    tie_enclosed_loops();
    // A region that was reached is a contact as a whole: the loops inside it belong to the lump
    // too.
    for (const RegionId r : lump_.regions)
      for (const SectionLoopId l : section_.regions[r].loops)
        push(section_.crossings[section_.loops[l].first].edge);
  } while (!stack_.empty());

  std::ranges::sort(lump_.regions);
  const PlaneSide looking = section_.looking();
  double cap_area = 0;
  for (const RegionId r : lump_.regions) {
    cap_area += section_.regions[r].area;
    lump_.new_area += section_.regions[r].new_area;
  }
  lump_.volume = (is_material_ ? 1 : -1) * patch_volume_ -
                 body_.world().planes.offset_m(looking) * cap_area / 3;
  return lump_;
}

void LumpFinder::push(EdgeId e) {
  if (scratch_.flooded_edges.insert(e)) stack_.push_back(e);
}

/// Half-edges that start on the looked-at side. From each the flood goes on along its facet and
/// over to the neighbour.
void LumpFinder::visit(EdgeId e) {
  const BodyFacetId f = body_.facet_of(e);
  if (scratch_.flooded_facets.insert(f)) facets_.push_back(f);
  const EdgeId t = body_.twin(e);
  if (!lump_.has_bend && body_.is_reflex(e)) lump_.has_bend = true;
  if (is_up(body_.target(e))) {
    add_segment(e, body_.at(e), body_.at(t));
    push(body_.next(e));
    push(t);
  } else {
    reach(crossing_of(e));
  }
  push(body_.next(t));
  const EdgeId before = body_.prev(e);
  push(is_up(body_.origin(before)) ? before : body_.twin(before));
}

void LumpFinder::reach(CrossingId c) {
  if (!c.is_valid()) lump_.is_sound = false;
  if (!c.is_valid() || crossing_stamp_[c] == stamp_) return;
  crossing_stamp_[c] = stamp_;
  const Crossing& crossing = section_.crossings[c];
  const Crossing& partner = section_.crossings[crossing.next];
  const EdgeId up = body_.twin(crossing.edge);
  add_segment(crossing.edge, body_.at(crossing.edge), crossing.at);
  add_segment(crossing.edge, crossing.at, partner.at);
  add_segment(up, crossing.at, body_.at(crossing.edge));
  push(partner.edge);

  if (!has_sound_pieces(c)) lump_.is_sound = false;
  const RegionId region = region_of_[crossing.loop][is_material_ ? 1 : 0];
  if (!region.is_valid())
    lump_.is_finite = false;
  else if (std::ranges::find(lump_.regions, region) == lump_.regions.end())
    lump_.regions.push_back(region);
}

/// Visits the outline of the piece of a facet that the chord from crossing c bounds. Returns false
/// if the outline does not lead back to c over edges that the section crosses, as of a folded
/// facet.
template <class Visit>
bool LumpFinder::visit_piece(CrossingId c, Visit visit) const {
  const CrossingId start = c;
  std::size_t chords = 0;
  do {
    visit(section_.crossings[c].at);
    c = section_.crossings[c].next;
    visit(section_.crossings[c].at);
    const EdgeId first = body_.next(body_.twin(section_.crossings[c].edge));
    EdgeId e = first;
    for (; e.is_valid() && is_up(body_.target(e)); e = body_.next(e)) {
      visit(body_.at(e));
      if (body_.next(e) == first) return false;
    }
    if (!e.is_valid()) return false;
    visit(body_.at(e));
    c = crossing_of(e);
  } while (c.is_valid() && c != start && ++chords < section_.crossings.size());
  return c == start;
}

/// The same of the piece below the chord.
template <class Visit>
bool LumpFinder::visit_lower_piece(CrossingId c, Visit visit) const {
  const CrossingId start = c;
  std::size_t chords = 0;
  do {
    visit(section_.crossings[c].at);
    const EdgeId first = body_.next(section_.crossings[c].edge);
    EdgeId e = first;
    for (; e.is_valid() && !is_up(body_.target(e)); e = body_.next(e)) {
      visit(body_.at(e));
      if (body_.next(e) == first) return false;
    }
    if (!e.is_valid()) return false;
    visit(body_.at(e));
    const CrossingId end = crossing_of(body_.twin(e));
    if (!end.is_valid()) return false;
    visit(section_.crossings[end].at);
    c = previous_[end];
  } while (c.is_valid() && c != start && ++chords < section_.crossings.size());
  return c == start;
}

/// The pieces of the facet on both sides of the chord have area.
bool LumpFinder::has_sound_pieces(CrossingId c) const {
  const BodyFacetId f = body_.facet_of(section_.crossings[c].edge);
  const Vec3 normal = body_.world().planes.normal(body_.facet(f).side);
  const Vec3 start = section_.crossings[c].at;
  const auto area_of = [&](auto visit_points) {
    Vec3 sum, from;
    visit_points([&](Vec3 p) {
      const Vec3 to = p - start;
      sum = sum + cross(from, to);
      from = to;
    });
    return dot(sum, normal) / 2;
  };
  const auto is_sound = [&](double area, auto visit_points) {
    if (area > 0) return true;
    Outline points;
    visit_points([&](Vec3 p) { points.push_back(p); });
    return area > -kThin_m * perimeter(points);
  };
  bool is_whole = true;
  const auto upper = [&](auto visit) { is_whole = visit_piece(c, visit) && is_whole; };
  const auto lower = [&](auto visit) { is_whole = visit_lower_piece(c, visit) && is_whole; };
  const double upper_area = area_of(upper);
  if (!is_whole) return false;
  // In a facet with one loop and one chord the other piece is what is left.
  const bool is_only_chord = scratch_.last_chord_in[f] == c && !next_in_facet_[c].is_valid();
  if (is_only_chord && body_.facet(f).loops.size() == 1 && upper_area > 0 &&
      body_.area(f) - upper_area >
          -kThin_m * length(section_.crossings[section_.crossings[c].next].at - start))
    return true;
  return is_sound(upper_area, upper) && is_sound(area_of(lower), lower) && is_whole;
}

/// What a directed piece of a facet's outline adds to a third of offset × area.
void LumpFinder::add_segment(EdgeId e, Vec3 from, Vec3 to) {
  const PlaneSide side = body_.side_of_edge(e);
  const auto& planes = body_.world().planes;
  patch_volume_ += planes.offset_m(side) * dot(planes.normal(side), cross(from, to)) / 6;
}

/// A loop that lies wholly in a piece of a facet is not met on the way along the piece's outline,
/// nor the outline on the way along the loop: whichever was reached brings the other.
void LumpFinder::tie_enclosed_loops() {
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    const BodyFacetId f = facets_[i];
    const bool is_cut = scratch_.facets_with_chord.contains(f);
    const auto& loops = body_.facet(f).loops;
    // The only loop was reached: nothing else to tie.
    if (loops.size() == 1) continue;
    for (const LoopId l : loops) {
      if (!is_wholly_up(l)) continue;
      if (is_cut)
        tie_loop_to_piece(f, l);
      else
        push(body_.loop(l).first);
    }
  }
}

bool LumpFinder::is_wholly_up(LoopId loop) const {
  const EdgeId first = body_.loop(loop).first;
  EdgeId e = first;
  do {
    if (!is_up(body_.origin(e))) return false;
    e = body_.next(e);
  } while (e != first);
  return true;
}

void LumpFinder::tie_loop_to_piece(BodyFacetId facet, LoopId loop) {
  const EdgeId first = body_.loop(loop).first;
  const bool has_loop = is_reached(first);
  const Vec3 normal = body_.world().planes.normal(body_.facet(facet).side);
  for (CrossingId c = scratch_.last_chord_in[facet]; c.is_valid(); c = next_in_facet_[c]) {
    const bool has_piece = crossing_stamp_[c] == stamp_;
    if (has_piece == has_loop) continue;
    Outline piece;
    const bool is_whole = visit_piece(c, [&](Vec3 p) { piece.push_back(p); });
    if (!is_whole || !contains({&piece, 1}, normal, body_.at(first))) continue;
    push(has_piece ? first : section_.crossings[c].edge);
    return;
  }
}

}  // namespace oriel::detail
