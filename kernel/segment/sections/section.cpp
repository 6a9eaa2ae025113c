#include "kernel/segment/sections/section.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/geometry/boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

namespace oriel::detail {

namespace {

/// Visits the crossings of a loop in their order.
template <class Visit>
void for_each_crossing(const Section& section, SectionLoopId loop, Visit visit) {
  const CrossingId first = section.loops[loop].first;
  CrossingId c = first;
  do {
    visit(section.crossings[c]);
    c = section.crossings[c].next;
  } while (c != first);
}

/// A loop by its size; of equal ones the first edge tells.
struct LoopSize {
  double size;
  EdgeId edge;
  SectionLoopId loop;
};

/// Most sections have no more loops.
constexpr std::size_t kFewLoops = 16;

using FewRegions = boost::container::small_vector<RegionId, kFewLoops>;

class LoopNester {
 public:
  LoopNester(Section& section, Vec3 axis) : section_(section), axis_(axis) {}

  void run() {
    sort_loops();
    find_boxes();
    outlines_.resize(section_.loops.size());
    std::array<FewRegions, 2> larger;  // regions around air, around material
    section_.regions.reserve(order_.size());
    for (const auto& [size, edge, l] : order_) {
      const RegionId mine = add_region(l);
      const bool is_material = section_.loops[l].area > 0;
      const RegionId parent = parent_of(l, larger[is_material ? 0 : 1]);
      larger[is_material ? 1 : 0].push_back(mine);
      if (!parent.is_valid()) continue;
      Region& around = section_.regions[parent];
      around.loops.push_back(l);
      around.area -= size;
    }
  }

  RegionId add_region(SectionLoopId l) {
    const double area = section_.loops[l].area;
    return section_.regions.push_back({area > 0, {l}, std::abs(area)});
  }

 private:
  /// The largest first.
  void sort_loops() {
    order_.reserve(section_.loops.size());
    for (const SectionLoopId l : section_.loops.ids()) {
      const SectionLoop& loop = section_.loops[l];
      order_.push_back({std::abs(loop.area), section_.crossings[loop.first].edge, l});
    }
    std::ranges::sort(order_, [](const LoopSize& p, const LoopSize& q) {
      return p.size != q.size ? p.size > q.size : p.edge < q.edge;
    });
  }

  void find_boxes() {
    boxes_.resize(section_.loops.size());
    for (const Crossing& c : section_.crossings) boxes_[c.loop].grow(c.at);
  }

  /// Of the smallest of the larger loops of the other kind that is around loop `l` the region, if
  /// any.
  RegionId parent_of(SectionLoopId l, const FewRegions& others) {
    for (std::size_t j = others.size(); j-- > 0;) {
      const SectionLoopId outer = section_.regions[others[j]].loops[0];
      if (is_within(boxes_[l], boxes_[outer]) && is_inside(l, outer)) return others[j];
    }
    return {};
  }

  /// Loops do not cross, so one point tells; the middle of the figure may lie in a loop further in,
  /// so it is asked from points of the loop itself until one is clear of the outer loop's own
  /// points.
  bool is_inside(SectionLoopId inner, SectionLoopId outer) {
    Outline& shape = outlines_[outer];
    if (shape.empty()) shape = outline_of(section_, outer);
    const CrossingId first = section_.loops[inner].first;
    CrossingId c = first;
    do {
      const Vec3 p = section_.crossings[c].at;
      if (std::ranges::find(shape, p) == shape.end()) return contains({&shape, 1}, axis_, p);
      c = section_.crossings[c].next;
    } while (c != first);
    const Outline points = outline_of(section_, inner);
    const auto middle = interior_point({&points, 1}, axis_);
    return middle && contains({&shape, 1}, axis_, *middle);
  }

  Section& section_;
  Vec3 axis_;
  boost::container::small_vector<LoopSize, kFewLoops> order_;
  IndexedVector<SectionLoopId, Box> boxes_;
  IndexedVector<SectionLoopId, Outline> outlines_;  ///< filled in when asked for
};

/// Makes the regions of a section of its loops, which do not cross. Loops nest by turns: around
/// material, around air in it, around material in that. Each loop belongs to the region inside it
/// and is a hole in the region that its parent bounds. `axis`: the plane's normal.
void nest_loops(Section& section, Vec3 axis) {
  LoopNester nester(section, axis);
  if (section.loops.size() == 1)
    nester.add_region(SectionLoopId{0});
  else
    nester.run();
}

class Sectioner {
 public:
  Sectioner(const Boundary& body, Section& section, std::span<const EdgeId> edges,
            const SectionOptions& options)
      : body_(body),
        world_(body.world()),
        edges_(edges),
        options_(options),
        scratch_(world_.scratch),
        looking_(section.looking()),
        axis_(world_.planes.normal(looking_)),
        offset_m_(world_.planes.offset_m(looking_)),
        ranks_(world_.points.ranks(world_.planes.class_of(section.plane))),
        plane_rank_(world_.planes.rank_of(section.plane)),
        section_(section) {}

  void run() {
    ask_for_facets();
    find_crossings();
    if (section_.crossings.empty()) return;
    if (link_chords() && close_loops())
      find_regions();
    else
      section_.loops.clear();
  }

  bool prune() {
    ask_for_facets();
    if (!drop_dead_loops()) return false;
    for (Region& region : section_.regions) judge(region);
    return true;
  }

 private:
  void ask_for_facets() {
    const auto on_plane = body_.on_plane(looking_ >> 1);
    const std::size_t material = at(looking_ & 1), air = 1 - material;
    section_.old_areas = {on_plane.areas[air], on_plane.areas[material]};
    has_facets_ = {on_plane.has_facets[air], on_plane.has_facets[material]};
  }

  /// +1 on the side looked to, 0 on the plane, -1 on the other side.
  [[nodiscard]] int level(PointId point) const {
    const int difference = (ranks_[point] - plane_rank_) * section_.direction;
    return (difference > 0) - (difference < 0);
  }

  void find_crossings() {
    StampSet<EdgeId>& crossed = scratch_.crossed_edges;
    crossed.start(body_.half_edge_count());
    auto& crossings = section_.crossings;
    crossings.reserve(edges_.size());
    const auto ranks = ranks_;
    const int direction = section_.direction, limit = plane_rank_ * direction;
    for (const EdgeId one : edges_) {
      const auto& half = body_.edge(one);
      if (!half.next.is_valid()) continue;
      EdgeId e = one;
      PointId up = half.origin, down = body_.origin(half.twin);
      const bool is_one_up = ranks[up] * direction > limit;
      if (is_one_up == (ranks[down] * direction > limit)) continue;
      if (!is_one_up) {
        e = half.twin;
        std::swap(up, down);
      }
      // An edge that was shortened or paired anew may be among them twice.
      if (crossed.insert(e))
        crossings.push_back({e, meeting(up, down, ranks[down] == plane_rank_)});
    }
  }

  /// Where an edge meets the plane, from its upper and its lower end.
  [[nodiscard]] Vec3 meeting(PointId up, PointId down, bool ends_on_plane) const {
    const Vec3 q = world_.points.at(down);
    if (ends_on_plane) return q;
    const Vec3 p = world_.points.at(up);
    const double hp = dot(axis_, p) - offset_m_, hq = dot(axis_, q) - offset_m_;
    return hp > hq ? p + (hp / (hp - hq)) * (q - p) : q;
  }

  /// Pairs the crossings of every facet along its line with the plane. A chord runs with the
  /// material above it to its left, from a half-edge that leads down to one that leads up.
  bool link_chords() {
    scratch_.start_chords(body_.facet_count());
    for (const CrossingId c : section_.crossings.ids()) {
      const auto& half = body_.edge(section_.crossings[c].edge);
      add_end(half.facet, 2 * c.value + 1);
      add_end(body_.facet_of(half.twin), 2 * c.value);
    }
    for (std::size_t i = 0; i < scratch_.facets_with_several.size(); ++i)
      if (!link_in_facet(scratch_.facets_with_several[i], scratch_.chord_ends[i])) return false;
    return true;
  }

  /// Links the two ends of a facet that has no more, as most have.
  void add_end(BodyFacetId facet, int end) {
    Chords& here = scratch_.chords_in(facet);
    if (here.ends++ == 0) {
      here.first = end;
    } else if (here.ends == 2) {
      here.second = end;
      if (((here.first ^ end) & 1) != 0) link(here.first, end);
    } else {
      list_end(facet, here, end);
    }
  }

  /// Of more ends all are listed, to be linked in the order in which they lie along the line.
  [[gnu::noinline]] void list_end(BodyFacetId facet, Chords& here, int end) {
    if (here.number < 0) {
      here.number = static_cast<int>(scratch_.facets_with_several.size());
      auto& ends = scratch_.add_chord_ends(facet);
      ends.push_back({0, CrossingId{here.first >> 1}, (here.first & 1) != 0});
      ends.push_back({0, CrossingId{here.second >> 1}, (here.second & 1) != 0});
    }
    scratch_.chord_ends[at(here.number)].push_back({0, CrossingId{end >> 1}, (end & 1) != 0});
  }

  /// Makes one chord of two ends of which one begins it.
  void link(int one, int other) {
    const int begin = (one & 1) != 0 ? one : other, end = (one & 1) != 0 ? other : one;
    section_.crossings[CrossingId{begin >> 1}].next = CrossingId{end >> 1};
  }

  /// Sorts the ends along the line; where edges leave one point of the plane, by where they are
  /// just above it.
  bool link_in_facet(BodyFacetId facet, std::span<ChordEnd> ends) {
    if (ends.size() % 2 != 0) return false;
    const Vec3 line = line_in(facet);
    for (ChordEnd& end : ends) end.along = dot(line, section_.crossings[end.crossing].at);
    std::ranges::sort(ends, [](const ChordEnd& p, const ChordEnd& q) {
      if (p.along != q.along) return p.along < q.along;
      return std::pair(p.leads_down, p.crossing) < std::pair(q.leads_down, q.crossing);
    });
    for (std::size_t i = 0; i < ends.size();) {
      std::size_t j = i + 1;
      while (j < ends.size() && ends[j].along == ends[i].along) ++j;
      if (j > i + 1)
        std::ranges::stable_sort(ends.subspan(i, j - i), {}, [&](const ChordEnd& end) {
          return std::pair(slope(line, end), end.leads_down);
        });
      i = j;
    }
    for (std::size_t i = 0; i < ends.size(); i += 2) {
      if (!ends[i].leads_down || ends[i + 1].leads_down) return false;
      section_.crossings[ends[i].crossing].next = ends[i + 1].crossing;
    }
    return true;
  }

  [[nodiscard]] Vec3 line_in(BodyFacetId facet) const {
    return cross(axis_, world_.planes.normal(body_.facet(facet).side));
  }

  [[nodiscard]] double slope(Vec3 line, const ChordEnd& end) const {
    const Crossing& crossing = section_.crossings[end.crossing];
    const Vec3 up = body_.at(crossing.edge) - crossing.at;
    return dot(line, up) / dot(axis_, up);
  }

  /// False if some crossing begins no chord.
  bool close_loops() {
    auto& crossings = section_.crossings;
    for (const CrossingId start : crossings.ids()) {
      if (crossings[start].loop.is_valid()) continue;
      const SectionLoopId number = section_.loops.next_id();
      const Vec3 origin = crossings[start].at;
      Vec3 sum, from;
      CrossingId c = start, first = start;
      EdgeId least = crossings[start].edge;
      do {
        Crossing& here = crossings[c];
        if (here.loop.is_valid() || !here.next.is_valid()) return false;
        here.loop = number;
        if (here.edge < least) {
          least = here.edge;
          first = c;
        }
        c = here.next;
        const Vec3 to = crossings[c].at - origin;
        sum = sum + cross(from, to);
        from = to;
      } while (c != start);
      section_.loops.push_back({first, dot(sum, axis_) / 2});
    }
    return true;
  }

  [[nodiscard]] Outline outline(SectionLoopId l) const { return outline_of(section_, l); }

  /// Thinner than weld_m, as a keel that touches the plane is.
  [[nodiscard]] bool is_sliver(SectionLoopId l, double area) const {
    double around = 0;
    for_each_crossing(section_, l, [&](const Crossing& c) {
      around += length(section_.crossings[c.next].at - c.at);
    });
    return std::abs(area) < options_.weld_m * around / 2;
  }

  void find_regions() {
    nest_loops(section_, axis_);
    for (Region& region : section_.regions) judge(region);
  }

  /// Also of a region that was judged before: it is no sliver then if it was a candidate.
  void judge(Region& region) {
    const double old_area = section_.old_area(region);
    const bool is_known = region.is_candidate;
    region.covered.clear();
    region.is_natural = region.has_natural_outline = region.is_candidate = false;
    region.has_neck = false;
    region.new_area = region.area;
    if (old_area <= 0 && !options_.has_all_regions) return;
    const PlaneSide opposite = section_.split_side(region) ^ 1;
    if (has_facets_[region.is_material ? 0 : 1]) take_off_covered(region, opposite);
    region.has_natural_outline = is_natural(region.loops[0], region);
    region.is_natural = region.has_natural_outline &&
                        std::all_of(region.loops.begin() + 1, region.loops.end(),
                                    [&](SectionLoopId l) { return is_natural(l, region); });
    region.is_candidate =
        (region.is_natural || region.new_area < old_area) &&
        ((is_known && region.covered.empty()) || !is_sliver(region.loops[0], region.new_area));
  }

  [[nodiscard]] bool is_dead(const Crossing& c) const { return !body_.is_alive_edge(c.edge); }

  /// False if a loop is dead in part only, or a living one lies in a dead one.
  bool drop_dead_loops() {
    if (std::ranges::none_of(section_.crossings, [&](const Crossing& c) { return is_dead(c); }))
      return true;
    list_by_loop();
    NewLoops new_loop;
    if (!number_living_loops(new_loop) || !drop_dead_regions(new_loop)) return false;
    drop_dead_crossings(new_loop);
    return true;
  }

  /// The crossings of each loop stand together from then on, in the order of the loops.
  void list_by_loop() {
    if (section_.is_by_loop) return;
    section_.is_by_loop = true;
    IndexedVector<CrossingId, Crossing> crossings;
    crossings.reserve(section_.crossings.size());
    for (const SectionLoopId l : section_.loops.ids()) {
      const CrossingId first = crossings.next_id();
      for_each_crossing(section_, l, [&](const Crossing& c) {
        crossings.push_back({c.edge, c.at, CrossingId{crossings.next_id().value + 1}, l});
      });
      crossings.back().next = section_.loops[l].first = first;
    }
    section_.crossings = std::move(crossings);
  }

  [[nodiscard]] CrossingId end_of_loop(SectionLoopId l) const {
    const auto& loops = section_.loops;
    const SectionLoopId next{l.value + 1};
    return loops.contains(next) ? loops[next].first : section_.crossings.next_id();
  }

  /// By loop what it is called from then on; invalid: it is dead.
  using NewLoops = IndexedVector<SectionLoopId, SectionLoopId>;

  bool number_living_loops(NewLoops& new_loop) const {
    int living = 0;
    for (const SectionLoopId l : section_.loops.ids()) {
      const int first = section_.loops[l].first.value, last = end_of_loop(l).value;
      int dead = 0;
      for (int c = first; c < last; ++c) dead += is_dead(section_.crossings[CrossingId{c}]) ? 1 : 0;
      if (dead > 0 && dead < last - first) return false;
      new_loop.push_back(SectionLoopId{dead > 0 ? -1 : living++});
    }
    return true;
  }

  void drop_dead_crossings(const NewLoops& new_loop) {
    auto& crossings = section_.crossings;
    int kept = 0;
    std::size_t kept_loops = 0;
    for (const SectionLoopId l : new_loop.ids()) {
      if (!new_loop[l].is_valid()) continue;
      const int first = section_.loops[l].first.value, last = end_of_loop(l).value;
      const int shift = first - kept;
      for (int c = first; c < last && shift > 0; ++c) {
        const Crossing& from = crossings[CrossingId{c}];
        crossings[CrossingId{c - shift}] = {from.edge, from.at, CrossingId{from.next.value - shift},
                                            new_loop[l]};
      }
      section_.loops[new_loop[l]] = {CrossingId{kept}, section_.loops[l].area};
      ++kept_loops;
      kept += last - first;
    }
    crossings.resize(at(kept));
    section_.loops.resize(kept_loops);
  }

  bool drop_dead_regions(const NewLoops& new_loop) {
    const auto is_gone = [&](SectionLoopId l) { return !new_loop[l].is_valid(); };
    for (Region& region : section_.regions) {
      if (is_gone(region.loops[0])) {
        if (!std::ranges::all_of(region.loops, is_gone)) return false;
        region.loops.clear();
        continue;
      }
      for (const SectionLoopId l : region.loops)
        if (is_gone(l)) region.area += std::abs(section_.loops[l].area);
      region.loops.erase(std::remove_if(region.loops.begin(), region.loops.end(), is_gone),
                         region.loops.end());
      for (SectionLoopId& l : region.loops) l = new_loop[l];
    }
    section_.regions.erase_if([](const Region& region) { return region.loops.empty(); });
    return true;
  }

  void take_off_covered(Region& region, PlaneSide opposite) {
    const std::vector<BodyFacetId> facets = body_.facets_on(opposite);
    if (facets.empty()) return;
    std::vector<Outline> shape;
    for (const SectionLoopId l : region.loops) shape.push_back(outline(l));
    for (const BodyFacetId f : facets) {
      const auto inside = interior_point(body_.outlines(f), axis_);
      if (!inside || !contains(shape, axis_, *inside)) continue;
      region.covered.push_back(f);
      region.new_area -= body_.area(f);
    }
  }

  /// Notes in the loop's region if there is a neck.
  [[nodiscard]] bool is_natural(SectionLoopId l, Region& region) const {
    CrossingId c = section_.loops[l].first;
    do {
      if (!is_natural_chord(c)) {
        if (!options_.are_necks_free || !is_neck_chord(c)) return false;
        region.has_neck = true;
      }
      c = section_.crossings[c].next;
    } while (c != section_.loops[l].first);
    return true;
  }

  /// From where the facet's loop comes down to the plane it stays on it until it goes up again; or
  /// the facet lies in the ground, where a chord is free.
  [[nodiscard]] bool is_natural_chord(CrossingId c) const {
    const EdgeId begin = section_.crossings[c].edge;
    const EdgeId end = body_.twin(section_.crossings[section_.crossings[c].next].edge);
    if (body_.side_of_edge(begin) == options_.free_side) return true;
    EdgeId e = begin;
    do {
      if (level(body_.target(e)) != 0) return false;
      e = body_.next(e);
    } while (e != end && e != begin);
    return e == end;
  }

  /// A corner of a facet on the plane.
  struct NeckStop {
    double along;
    EdgeId in, out;
  };

  /// From corner to corner on the line the chord follows edges of its facet, or goes through a neck
  /// of it.
  [[nodiscard]] bool is_neck_chord(CrossingId c) const {
    const EdgeId begin = section_.crossings[c].edge;
    const EdgeId end = body_.twin(section_.crossings[section_.crossings[c].next].edge);
    if (level(body_.target(begin)) != 0 || level(body_.origin(end)) != 0) return false;
    const auto stops = stops_between(begin, end);
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const NeckStop &from = stops[i], &to = stops[i + 1];
      if (from.out != to.in && !(has_shoulder(from) && has_shoulder(to))) return false;
    }
    return stops.size() > 1;
  }

  /// The facet has an edge on the plane there.
  [[nodiscard]] bool has_shoulder(const NeckStop& stop) const {
    return level(body_.origin(stop.in)) == 0 || level(body_.target(stop.out)) == 0;
  }

  /// The ends of a chord, and the corners between them that touch the plane from the other side.
  [[nodiscard]] boost::container::small_vector<NeckStop, 8> stops_between(EdgeId begin,
                                                                          EdgeId end) const {
    const BodyFacetId f = body_.facet_of(begin);
    const Vec3 line = line_in(f);
    const EdgeId first_out = body_.next(begin), last_in = body_.prev(end);
    const double start = dot(line, body_.at(first_out)), goal = dot(line, body_.at(end));
    boost::container::small_vector<NeckStop, 8> stops{{start, begin, first_out}};
    if (body_.target(begin) == body_.origin(end)) return stops;
    body_.for_each_edge(f, [&](EdgeId e) {
      const EdgeId out = body_.next(e);
      if (level(body_.origin(out)) != 0 || level(body_.origin(e)) > 0 ||
          level(body_.target(out)) > 0)
        return;
      const double along = dot(line, body_.at(out));
      if (along > start && along < goal) stops.push_back({along, e, out});
    });
    std::ranges::sort(stops, [](const NeckStop& p, const NeckStop& q) {
      return std::pair(p.along, p.in) < std::pair(q.along, q.in);
    });
    stops.push_back({goal, last_in, end});
    return stops;
  }

  const Boundary& body_;
  World& world_;
  std::span<const EdgeId> edges_;
  SectionOptions options_;
  Scratch& scratch_;
  PlaneSide looking_;
  Vec3 axis_;
  double offset_m_;
  PointRanks ranks_;
  int plane_rank_;
  Section& section_;
  std::array<bool, 2> has_facets_{};  ///< on the split side of air, of material
};

}  // namespace

void section_at(const Boundary& body, Section& section, std::span<const EdgeId> edges,
                const SectionOptions& options) {
  ORIEL_ASSERT(section.plane >= 0 && std::abs(section.direction) == 1);
  section.crossings.clear();
  section.loops.clear();
  section.regions.clear();
  section.is_by_loop = false;
  Sectioner(body, section, edges, options).run();
}

bool prune_section(const Boundary& body, Section& section, const SectionOptions& options) {
  return Sectioner(body, section, {}, options).prune();
}

Outline outline_of(const Section& section, SectionLoopId loop) {
  Outline points;
  std::size_t size = 0;
  for_each_crossing(section, loop, [&](const Crossing&) { ++size; });
  points.reserve(size);
  for_each_crossing(section, loop, [&](const Crossing& c) { points.push_back(c.at); });
  return points;
}

}  // namespace oriel::detail
