#include "kernel/segment/detail/section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

class Sectioner {
 public:
  Sectioner(const Boundary& body, int plane, int direction, std::span<const int> edges,
            const SectionOptions& options, Scratch& scratch)
      : body_(body),
        world_(body.world()),
        edges_(edges),
        options_(options),
        scratch_(scratch),
        axis_(direction > 0 ? world_.planes.plane(plane).normal
                            : -world_.planes.plane(plane).normal),
        ranks_(world_.points.ranks(world_.planes.class_of(plane))),
        plane_rank_(world_.planes.rank_of(plane)) {
    section_.plane = plane;
    section_.direction = direction;
  }

  Section run() {
    find_crossings();
    if (section_.crossings.empty() || !link_chords() || !close_loops()) {
      section_.loops.clear();
      return std::move(section_);
    }
    find_regions();
    return std::move(section_);
  }

 private:
  /// +1 on the side looked to, 0 on the plane, -1 on the other side.
  [[nodiscard]] int level(int point) const {
    const int difference = (ranks_[at(point)] - plane_rank_) * section_.direction;
    return (difference > 0) - (difference < 0);
  }
  [[nodiscard]] bool is_up(int point) const { return level(point) > 0; }

  [[nodiscard]] double height(Vec3 p) const {
    const Side looking = 2 * section_.plane + (section_.direction > 0 ? 0 : 1);
    return dot(axis_, p) - world_.planes.offset_m(looking);
  }

  void find_crossings() {
    std::vector<int> crossing;
    for (const int one : edges_) {
      if (!body_.is_alive_edge(one)) continue;
      const int other = body_.twin(one);
      const bool is_first_up = is_up(body_.origin(one));
      if (is_first_up != is_up(body_.origin(other))) crossing.push_back(is_first_up ? one : other);
    }
    std::ranges::sort(crossing);
    crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
    section_.crossings.reserve(crossing.size());
    for (const int e : crossing)
      section_.crossings.push_back({e, meeting(body_.origin(e), body_.target(e)), -1, -1});
  }

  [[nodiscard]] Vec3 meeting(int up, int down) const {
    if (level(down) == 0) return world_.points.at(down);
    const Vec3 p = world_.points.at(up), q = world_.points.at(down);
    const double hp = height(p), hq = height(q);
    return hp > hq ? p + (hp / (hp - hq)) * (q - p) : q;
  }

  /// A crossing as one of its two facets sees it.
  struct End {
    int crossing;
    bool leads_down;  ///< the facet's own half-edge leads down here: a chord begins
    int before;       ///< the end in the same facet that was met before, -1: none
    double along = 0;
    double slope = 0;
  };

  /// Pairs the crossings of every facet along its line with the plane. A chord runs with the
  /// material above it to its left, from a half-edge that leads down to one that leads up.
  bool link_chords() {
    const int stamp =
        Scratch::stamp(scratch_.facet_stamps, body_.facet_count(), scratch_.last_facet_stamp);
    auto& newest = scratch_.first_end;
    newest.resize(scratch_.facet_stamps.size());
    std::vector<End> ends;
    std::vector<int> facets;
    ends.reserve(2 * section_.crossings.size());
    const auto add = [&](int facet, int crossing, bool leads_down) {
      const bool is_new = scratch_.facet_stamps[at(facet)] != stamp;
      if (is_new) facets.push_back(facet);
      scratch_.facet_stamps[at(facet)] = stamp;
      ends.push_back({crossing, leads_down, is_new ? -1 : newest[at(facet)]});
      newest[at(facet)] = static_cast<int>(ends.size()) - 1;
    };
    for (int c = 0; c < std::ssize(section_.crossings); ++c) {
      const int e = section_.crossings[at(c)].edge;
      add(body_.facet_of(e), c, true);
      add(body_.facet_of(body_.twin(e)), c, false);
    }
    std::vector<End> in_facet;
    for (const int f : facets) {
      in_facet.clear();
      for (int i = newest[at(f)]; i >= 0; i = ends[at(i)].before) in_facet.push_back(ends[at(i)]);
      if (!link_in_facet(f, in_facet)) return false;
    }
    return true;
  }

  bool link_in_facet(int facet, std::span<End> ends) {
    if (ends.size() % 2 != 0) return false;
    if (ends.size() > 2)
      sort_along(facet, ends);
    else if (!ends[0].leads_down)
      std::swap(ends[0], ends[1]);
    for (std::size_t i = 0; i < ends.size(); i += 2) {
      if (!ends[i].leads_down || ends[i + 1].leads_down) return false;
      section_.crossings[at(ends[i].crossing)].next = ends[i + 1].crossing;
    }
    return true;
  }

  /// By place on the line; where edges leave one point of the plane, by where they are just above
  /// it.
  void sort_along(int facet, std::span<End> ends) const {
    const Vec3 line = cross(axis_, world_.planes.normal(body_.facet(facet).side));
    for (End& end : ends) {
      const Crossing& crossing = section_.crossings[at(end.crossing)];
      const Vec3 up = body_.at(crossing.edge) - crossing.at;
      end.along = dot(line, crossing.at);
      end.slope = dot(line, up) / dot(axis_, up);
    }
    std::ranges::sort(
        ends, {}, [](const End& end) { return std::tuple(end.along, end.slope, end.leads_down); });
  }

  bool close_loops() {
    auto& crossings = section_.crossings;
    for (int start = 0; start < std::ssize(crossings); ++start) {
      if (crossings[at(start)].loop >= 0) continue;
      const int number = static_cast<int>(section_.loops.size());
      Vec3 sum;
      int c = start;
      do {
        if (crossings[at(c)].loop >= 0 || crossings[at(c)].next < 0) return false;
        crossings[at(c)].loop = number;
        const int n = crossings[at(c)].next;
        sum = sum + cross(crossings[at(c)].at - crossings[at(start)].at,
                          crossings[at(n)].at - crossings[at(start)].at);
        c = n;
      } while (c != start);
      section_.loops.push_back({start, dot(sum, axis_) / 2});
    }
    return true;
  }

  [[nodiscard]] Outline outline(int l) const { return outline_of(section_, l); }

  /// Thinner than weld_m, as a keel that touches the plane is.
  [[nodiscard]] bool is_sliver(const Outline& points, double area) const {
    return std::abs(area) < options_.weld_m * perimeter(points) / 2;
  }

  /// A loop with what is needed to find the loops inside it.
  struct Shape {
    int loop;
    double area;
    Outline points;
    Box box;
  };

  /// Loops nest by turns: around material, around air in it, around material in that. Each loop
  /// belongs to the region inside it and is a hole in the region that its parent bounds.
  void find_regions() {
    std::vector<Shape> shapes;
    for (int l = 0; l < std::ssize(section_.loops); ++l) {
      Shape shape{l, section_.loops[at(l)].area, outline(l), {}};
      for (const Vec3 p : shape.points) shape.box.grow(p);
      shapes.push_back(std::move(shape));
    }
    std::ranges::sort(shapes, std::greater{},
                      [](const Shape& s) { return std::tuple(std::abs(s.area), -s.loop); });
    std::vector<int> region_of(section_.loops.size(), -1);
    std::array<std::vector<int>, 2> larger;  // around air, around material
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      region_of[at(shapes[i].loop)] = static_cast<int>(section_.regions.size());
      const double area = std::abs(shapes[i].area);
      section_.regions.push_back({shapes[i].area > 0, {shapes[i].loop}, area, 0, {}, false, false});
      const bool is_material = shapes[i].area > 0;
      const int parent = parent_of(shapes, larger[is_material ? 0 : 1], shapes[i]);
      larger[is_material ? 1 : 0].push_back(static_cast<int>(i));
      if (parent < 0) continue;
      Region& around = section_.regions[at(region_of[at(shapes[at(parent)].loop)])];
      around.loops.push_back(shapes[i].loop);
      around.area -= area;
    }
    for (Region& region : section_.regions) judge(region);
  }

  /// The smallest of the larger loops of the other kind that is around `inner`, or -1.
  static int parent_of(const std::vector<Shape>& shapes, const std::vector<int>& others,
                       const Shape& inner) {
    for (std::size_t j = others.size(); j-- > 0;) {
      const Shape& outer = shapes[at(others[j])];
      if (is_within(inner.box, outer.box) && is_inside(inner.points, outer)) return others[j];
    }
    return -1;
  }

  static bool is_within(const Box& inner, const Box& outer) {
    return inner.min.x >= outer.min.x && inner.min.y >= outer.min.y && inner.min.z >= outer.min.z &&
           inner.max.x <= outer.max.x && inner.max.y <= outer.max.y && inner.max.z <= outer.max.z;
  }

  /// Loops do not cross, so one point tells; the middle of the figure may lie in a loop further in,
  /// so it is asked from points of the loop itself until one is clear of the outer loop's own
  /// points.
  static bool is_inside(const Outline& inner, const Shape& outer) {
    const Vec3 normal = normalised(area_vector(outer.points));
    for (std::size_t i = 0; i < inner.size(); ++i) {
      const Vec3 p = inner[i];
      if (std::ranges::find(outer.points, p) == outer.points.end())
        return contains({&outer.points, 1}, normal, p);
    }
    const auto middle = interior_point({&inner, 1}, normal);
    return middle && contains({&outer.points, 1}, normal, *middle);
  }

  static Vec3 area_vector(const Outline& points) {
    Vec3 sum;
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
      sum = sum + cross(points[i] - points[0], points[i + 1] - points[0]);
    return sum;
  }

  void judge(Region& region) {
    const Side split = section_.split_side(region);
    region.new_area = region.area;
    if (body_.area_on(split) <= 0) return;
    take_off_covered(region, split ^ 1);
    region.is_candidate = !is_sliver(outline(region.loops[0]), region.new_area);
    region.is_natural = std::ranges::all_of(region.loops, [&](int l) { return is_natural(l); });
  }

  void take_off_covered(Region& region, Side opposite) {
    const std::vector<int> facets = body_.facets_on(opposite);
    if (facets.empty()) return;
    std::vector<Outline> shape;
    for (const int l : region.loops) shape.push_back(outline(l));
    for (const int f : facets) {
      const auto inside = interior_point(body_.outlines(f), axis_);
      if (!inside || !contains(shape, axis_, *inside)) continue;
      region.covered.push_back(f);
      region.new_area -= body_.area(f);
    }
  }

  [[nodiscard]] bool is_natural(int l) const {
    int c = section_.loops[at(l)].first;
    do {
      if (!is_natural_chord(c)) return false;
      c = section_.crossings[at(c)].next;
    } while (c != section_.loops[at(l)].first);
    return true;
  }

  /// From where the facet's loop comes down to the plane it stays on it until it goes up again; or
  /// the facet lies in the ground, where a chord is free.
  [[nodiscard]] bool is_natural_chord(int c) const {
    const int begin = section_.crossings[at(c)].edge;
    const int end = body_.twin(section_.crossings[at(section_.crossings[at(c)].next)].edge);
    if (body_.side_of_edge(begin) == options_.free_side) return true;
    int e = begin;
    do {
      if (level(body_.target(e)) != 0) return false;
      e = body_.next(e);
    } while (e != end && e != begin);
    return e == end;
  }

  const Boundary& body_;
  World& world_;
  std::span<const int> edges_;
  SectionOptions options_;
  Scratch& scratch_;
  Vec3 axis_;
  std::span<const int> ranks_;
  int plane_rank_;
  Section section_;
};

}  // namespace

Outline outline_of(const Section& section, int loop) {
  Outline points;
  const int first = section.loops[at(loop)].first;
  int c = first;
  do {
    points.push_back(section.crossings[at(c)].at);
    c = section.crossings[at(c)].next;
  } while (c != first);
  return points;
}

Section section_at(const Boundary& body, int plane, int direction, std::span<const int> edges,
                   const SectionOptions& options, Scratch& scratch) {
  return Sectioner(body, plane, direction, edges, options, scratch).run();
}

}  // namespace oriel::detail
