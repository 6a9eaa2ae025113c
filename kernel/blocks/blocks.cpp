#include "kernel/blocks/blocks.h"

#include "kernel/base/index.h"
#include "kernel/blocks/plan_view.h"
#include "kernel/blocks/simplify_outlines.h"
#include "kernel/blocks/upright_block.h"
#include "kernel/geometry/disjoint_sets.h"
#include "kernel/geometry/planar.h"
#include "kernel/solidify/solidify.h"
#include "model/building.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

/// A body of upright blocks over a simpler footprint.
struct SimplerFootprint {
  Solid solid;
  /// Edges of the footprint that are shorter than was asked for and had to stay.
  int short_edges = 0;
};

Vec3 seen_from_above(Vec3 p) { return {p.x, p.y, 0}; }

/// The blocks by their ground facets; the heights of walls are those of the tops over them.
std::vector<UprightBlock> blocks_of(const Solid& solid) {
  std::map<std::pair<double, double>, double> tops;
  std::vector<UprightBlock> blocks;
  for (const Vertex& vertex : solid.vertices) {
    const auto [entry, is_new] = tops.try_emplace({vertex.point.x, vertex.point.y}, vertex.point.z);
    entry->second = std::max(entry->second, vertex.point.z);
  }
  for (const Facet& facet : solid.facets) {
    if (solid.planes[facet.plane.index()].coefficients[2] >= 0) continue;
    UprightBlock& block = blocks.emplace_back();
    for (const Loop& loop : facet.loops) {
      Outline& outline = block.outlines.emplace_back();
      for (const int v : loop) outline.push_back(solid.vertices[at(v)].point);
      std::ranges::reverse(outline);
    }
    const Vec3 corner = block.outlines[0][0];
    block.ground_m = corner.z;
    block.top_m = tops.at({corner.x, corner.y});
    for (Outline& outline : block.outlines)
      std::ranges::transform(outline, outline.begin(), seen_from_above);
  }
  return blocks;
}

/// The outlines of all blocks simplified at the same time, so that none comes to touch another.
int simplify(std::vector<UprightBlock>& blocks, const OutlineLimits& limits) {
  std::vector<Outline> all;
  for (const UprightBlock& block : blocks)
    all.insert(all.end(), block.outlines.begin(), block.outlines.end());
  const int left = simplify_outlines(all, limits);
  auto next = all.begin();
  for (UprightBlock& block : blocks)
    for (Outline& outline : block.outlines) outline = std::move(*next++);
  return left;
}

/// What blocks() made, one block for each piece of the footprint, over the footprint that
/// simplify_outlines() leaves; each block keeps its height. Nothing if no closed solid comes of it.
std::optional<SimplerFootprint> simplify_footprint(const Solid& solid, const BlockOptions& options,
                                                   const Tolerances& tolerances) {
  std::vector<UprightBlock> blocks = blocks_of(solid);
  SimplerFootprint out;
  out.short_edges = simplify(
      blocks, {options.least_edge_m, tolerances.weld_m, options.may_cover, options.is_shared});
  auto made = block_solid(blocks, tolerances);
  if (!made) return std::nullopt;
  out.solid = std::move(*made);
  return out;
}

class PrismBuilder {
 public:
  PrismBuilder(const PlanView& view, const std::vector<int>& part_of,
               const std::vector<double>& heights_m)
      : view_(view), plan_(view.arrangement()), part_of_(part_of), heights_m_(heights_m) {
    body_.resize(heights_m.size());
    std::iota(body_.begin(), body_.end(), 0);
    for (std::size_t h = 0; h < plan_.half_edge_count(); ++h) {
      const int p = part(h), q = part(Arrangement::twin(h));
      if (p == q) continue;
      auto& levels = levels_[plan_.origin(h)];
      levels.insert({height_m(p), height_m(q)});
      if (p >= 0 && q >= 0) body_[at(body_of(p))] = body_of(q);
    }
  }

  Building run() {
    add_tops_and_ground();
    for (std::size_t h = 0; h < plan_.half_edge_count(); ++h) add_wall(h);
    return std::move(out_);
  }

 private:
  [[nodiscard]] int part(std::size_t h) const { return part_of_[plan_.region(h)]; }
  [[nodiscard]] double height_m(int part) const {
    return part < 0 ? view_.ground_m() : heights_m_[at(part)];
  }
  int body_of(int part) {
    while (body_[at(part)] != part) part = body_[at(part)] = body_[at(body_[at(part)])];
    return part;
  }

  int vertex(int of_plan, double z) {
    const auto [entry, is_new] =
        vertices_.emplace(std::pair{of_plan, z}, static_cast<int>(out_.vertices.size()));
    if (is_new) {
      const Vec3 p = view_.point(of_plan);
      out_.vertices.push_back({p.x, p.y, z});
    }
    return entry->second;
  }

  void add_polygon(std::vector<std::vector<int>> rings, int body) {
    Polygon polygon;
    polygon.rings = std::move(rings);
    polygon.source = static_cast<int>(out_.polygons.size());
    polygon.body = body;
    out_.polygons.push_back(std::move(polygon));
  }

  /// Rings by area, so that the outer one stands first.
  void add_horizontal(std::vector<Loop> loops, double z, bool looks_up, int body) {
    const auto area = [&](const Loop& loop) {
      Outline outline;
      for (const int v : loop) outline.push_back(view_.point(v));
      return signed_area(outline, {0, 0, 1});
    };
    std::ranges::stable_sort(loops, std::ranges::greater{}, area);
    std::vector<std::vector<int>> rings;
    for (const Loop& loop : loops) {
      std::vector<int>& ring = rings.emplace_back();
      for (const int v : loop) ring.push_back(vertex(v, z));
      if (!looks_up) std::ranges::reverse(ring);
    }
    add_polygon(std::move(rings), body);
  }

  /// The outlines of all pieces that `group` joins: connected regions of one group are one piece.
  template <class Group>
  std::vector<std::vector<Loop>> pieces(Group group) {
    std::vector<std::size_t> piece(part_of_.size());
    std::iota(piece.begin(), piece.end(), std::size_t{0});
    const auto find = [&](std::size_t r) {
      while (piece[r] != r) r = piece[r] = piece[piece[r]];
      return r;
    };
    const auto is_border = [&](std::size_t h) {
      return group(part(h)) != group(part(Arrangement::twin(h)));
    };
    for (std::size_t h = 0; h < plan_.half_edge_count(); ++h)
      if (!is_border(h)) piece[find(plan_.region(h))] = find(plan_.region(Arrangement::twin(h)));
    std::map<std::size_t, std::vector<Loop>> loops;
    std::vector<char> is_traced(plan_.half_edge_count(), 0);
    for (std::size_t start = 0; start < is_traced.size(); ++start) {
      if (is_traced[start] != 0 || !is_border(start) || part(start) < 0) continue;
      Loop loop;
      for (const std::size_t h : border_from(plan_, start, is_border, is_traced))
        loop.push_back(plan_.origin(h));
      part_at_[find(plan_.region(start))] = part(start);
      loops[find(plan_.region(start))].push_back(std::move(loop));
    }
    std::vector<std::vector<Loop>> all;
    owners_.clear();
    for (auto& [root, of_piece] : loops) {
      all.push_back(std::move(of_piece));
      owners_.push_back(part_at_[root]);
    }
    return all;
  }

  void add_tops_and_ground() {
    const auto tops = pieces([](int p) { return p; });
    for (std::size_t i = 0; i < tops.size(); ++i)
      add_horizontal(tops[i], height_m(owners_[i]), true, body_of(owners_[i]));
    const auto grounds = pieces([](int p) { return p < 0 ? 0 : 1; });
    for (std::size_t i = 0; i < grounds.size(); ++i)
      add_horizontal(grounds[i], view_.ground_m(), false, body_of(owners_[i]));
  }

  /// The wall to the left of which the higher block stands.
  void add_wall(std::size_t h) {
    const int p = part(h), q = part(Arrangement::twin(h));
    const double high = height_m(p), low = height_m(q);
    if (p == q || high <= low) return;
    const int a = plan_.origin(h), b = plan_.origin(Arrangement::twin(h));
    std::vector<int> ring{vertex(a, low), vertex(b, low)};
    const auto climb = [&](int v, std::vector<int>& to) {
      for (const double z : levels_[v])
        if (z > low && z < high) to.push_back(vertex(v, z));
    };
    climb(b, ring);
    ring.push_back(vertex(b, high));
    ring.push_back(vertex(a, high));
    std::vector<int> down;
    climb(a, down);
    ring.insert(ring.end(), down.rbegin(), down.rend());
    add_polygon({std::move(ring)}, body_of(p));
  }

  const PlanView& view_;
  const Arrangement& plan_;
  const std::vector<int>& part_of_;
  const std::vector<double>& heights_m_;
  std::vector<int> body_;                   ///< by part: union-find of connected ones
  std::map<int, std::set<double>> levels_;  ///< by vertex of the plan: the heights that meet there
  std::map<std::pair<int, double>, int> vertices_;
  std::map<std::size_t, int> part_at_;
  std::vector<int> owners_;  ///< a part of each of the pieces
  Building out_;
};

/// The boundary of upright blocks as polygons that meet along whole edges, ready for solidify: the
/// tops, the walls between blocks of different height and to the outside, and the ground.
/// `part_of` gives for each region of the view its block, or -1: the outside; `heights_m` the tops
/// of blocks. Blocks that are connected share Polygon::body; those that meet in a point do not.
Building prisms(const PlanView& view, const std::vector<int>& part_of,
                const std::vector<double>& heights_m) {
  return PrismBuilder(view, part_of, heights_m).run();
}

}  // namespace

}  // namespace oriel::detail

namespace oriel {

namespace {

using detail::PlanView;

/// A corner of a triangle seen from above, with the height of the roof over it.
struct RoofCorner {
  Vec3 plan;
  double z = 0;
};

/// The area of a triangle, seen from above, in which it lies lower than `z`. Signed, so that the
/// fans of any outline add up.
double area_below(std::array<RoofCorner, 3> t, double z) {
  const double area = cross(t[1].plan - t[0].plan, t[2].plan - t[0].plan).z / 2;
  std::ranges::sort(t, {}, &RoofCorner::z);
  const double low = t[0].z, mid = t[1].z, high = t[2].z;
  if (z >= high) return area;
  if (z <= low) return 0;
  if (z <= mid) return area * (z - low) * (z - low) / ((mid - low) * (high - low));
  return area * (1 - (high - z) * (high - z) / ((high - mid) * (high - low)));
}

/// Corners of the plan are one as those of the solid are. Of a noisy building, whose planes are
/// taken as one further apart than by default, they are as far apart as its planes.
double reach_m(const Tolerances& tolerances) {
  const bool is_noisy = tolerances.plane_offset_m > Tolerances{}.plane_offset_m;
  return is_noisy ? std::max(tolerances.weld_m, tolerances.plane_offset_m) : tolerances.weld_m;
}

class BlockBuilder {
 public:
  BlockBuilder(const Solid& solid, const std::string& name, const BlockOptions& options,
               const Tolerances& tolerances, Work& work)
      : name_(name),
        options_(options),
        tolerances_(tolerances),
        work_(work),
        view_(solid, options.ground_reach_m, reach_m(tolerances), work),
        plan_(view_.arrangement()) {}

  Checked<Blocks> run() {
    Checked<Blocks> out;
    Blocks result;
    result.is_from_above = is_ground_too_small();
    for (const bool is_by_roof : {true, false}) {
      if (is_by_roof && !options_.is_by_roof) continue;
      divide(is_by_roof, result.is_from_above);
      if (heights_m_.empty()) break;
      if (!stands_above_ground()) continue;
      Building building = detail::prisms(view_, part_of_, heights_m_);
      building.id = name_;
      auto solid = solidify(building, tolerances_, {Closing::planar});
      if (!solid.value || !is_closed(*solid.value)) continue;
      result.solid = std::move(*solid.value);
      if (!is_by_roof && options_.least_edge_m > 0) simplify(result);
      for (Facet& facet : result.solid.facets) facet.polygons.clear();
      result.parts = static_cast<int>(heights_m_.size());
      result.is_simplified = options_.is_by_roof && !is_by_roof;
      out.value = std::move(result);
      return out;
    }
    out.issues.push_back(building_issue(
        Severity::error, Code::G406, name_,
        work_.is_used_up()   ? "no block can be made: the work budget is used up"
        : heights_m_.empty() ? "no block can be made: the building covers no ground"
        : stands_above_ground()
            ? "no block can be made: its outline touches itself in a point"
            : "no block can be made: a part of its roof lies no higher than its ground"));
    return out;
  }

 private:
  [[nodiscard]] const std::vector<PlanView::PlanRegion>& regions() const { return view_.regions(); }

  [[nodiscard]] bool stands_above_ground() const {
    return std::ranges::all_of(heights_m_, [&](double top_m) { return top_m > view_.ground_m(); });
  }

  /// Where that makes no closed solid the footprint stays as it is.
  void simplify(Blocks& result) const {
    auto simpler = detail::simplify_footprint(result.solid, options_, tolerances_);
    result.keeps_footprint = !simpler;
    if (!simpler) return;
    result.solid = std::move(simpler->solid);
    result.short_edges = simpler->short_edges;
  }

  [[nodiscard]] bool is_ground_too_small() const {
    double ground_m2 = 0, all_m2 = 0;
    for (const PlanView::PlanRegion& region : regions()) {
      if (region.top < 0) continue;
      all_m2 += region.area_m2;
      if (region.is_on_ground) ground_m2 += region.area_m2;
    }
    return ground_m2 < all_m2 / 2;
  }

  /// Gives every region its block: first one to each, then joined.
  void divide(bool is_by_roof, bool is_from_above) {
    part_of_.assign(regions().size(), -1);
    for (std::size_t r = 1; r < regions().size(); ++r)
      if (regions()[r].top >= 0 && (is_from_above || regions()[r].is_on_ground))
        part_of_[r] = static_cast<int>(r);
    give_thin_regions_away();
    drop_small_pieces();
    join(is_by_roof);
    if (is_by_roof) join_small_parts();
    number_parts();
    find_heights();
  }

  [[nodiscard]] double length_m(std::size_t half_edge) const {
    return length(view_.point(plan_.origin(half_edge)) -
                  view_.point(plan_.origin(Arrangement::twin(half_edge))));
  }

  /// Regions narrower than the reach come of corners that do not lie above each other: they go to
  /// what they share most of their border with.
  void give_thin_regions_away() {
    constexpr int kThin = 1 << 30;  // beyond all numbers of regions
    std::vector<std::size_t> thin;
    for (std::size_t r = 1; r < regions().size(); ++r)
      if (regions()[r].is_thin) thin.push_back(r);
    for (const std::size_t r : thin) part_of_[r] = kThin + static_cast<int>(r);
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      for (const std::size_t r : thin) {
        if (part_of_[r] < kThin) continue;
        std::map<int, double> border_m;
        for_each_edge_of(r, [&](std::size_t h) {
          const int other = part_of_[plan_.region(Arrangement::twin(h))];
          if (other < kThin) border_m[other] += length_m(h);
        });
        if (border_m.empty()) continue;
        part_of_[r] =
            std::ranges::max_element(border_m, {}, [](const auto& e) { return e.second; })->first;
        has_changed = true;
      }
    }
    for (const std::size_t r : thin)
      if (part_of_[r] >= kThin) part_of_[r] = -1;
  }

  template <class Visit>
  void for_each_edge_of(std::size_t region, Visit visit) {
    if (edges_of_.empty()) {
      edges_of_.resize(regions().size());
      for (std::size_t h = 0; h < plan_.half_edge_count(); ++h)
        edges_of_[plan_.region(h)].push_back(h);
    }
    for (const std::size_t h : edges_of_[region]) visit(h);
  }

  /// Connected regions of the footprint, or of what lies around, as one: courtyards and separate
  /// pieces that are too small change sides.
  void drop_small_pieces() {
    if (options_.least_piece_m2 <= 0) return;
    std::vector<std::size_t> piece(regions().size());
    std::iota(piece.begin(), piece.end(), std::size_t{0});
    const auto find = [&](std::size_t r) {
      while (piece[r] != r) r = piece[r] = piece[piece[r]];
      return r;
    };
    for (std::size_t h = 0; h < plan_.half_edge_count(); ++h) {
      const std::size_t r = plan_.region(h), s = plan_.region(Arrangement::twin(h));
      if ((part_of_[r] < 0) == (part_of_[s] < 0)) piece[find(r)] = find(s);
    }
    std::map<std::size_t, double> area_m2;
    for (std::size_t r = 1; r < regions().size(); ++r) area_m2[find(r)] += regions()[r].area_m2;
    const std::size_t outside = find(0);
    double largest_m2 = 0;
    for (std::size_t r = 1; r < regions().size(); ++r)
      if (part_of_[r] >= 0) largest_m2 = std::max(largest_m2, area_m2[find(r)]);
    for (std::size_t r = 1; r < regions().size(); ++r) {
      const double here_m2 = area_m2[find(r)];
      if (find(r) == outside || here_m2 >= options_.least_piece_m2) continue;
      if (part_of_[r] < 0)
        part_of_[r] = static_cast<int>(r);
      else if (here_m2 < largest_m2)
        part_of_[r] = -1;
    }
  }

  /// Joins regions that are to have one top. In a courtyard that was closed no roof is seen: it
  /// takes the height of what is around it.
  void join(bool is_by_roof) {
    DisjointSets joined(regions().size());
    for (std::size_t h = 0; h < plan_.half_edge_count(); ++h) {
      const std::size_t r = plan_.region(h), s = plan_.region(Arrangement::twin(h));
      if (part_of_[r] < 0 || part_of_[s] < 0) continue;
      const int p = joined.find(part_of_[r]), q = joined.find(part_of_[s]);
      if (p != q && (!is_by_roof || step_m(h) <= options_.step_m)) joined.unite(p, q);
    }
    for (int& part : part_of_)
      if (part >= 0) part = joined.find(part);
  }

  /// The largest jump of the roof along an edge of the plan.
  [[nodiscard]] double step_m(std::size_t h) const {
    const int f = regions()[plan_.region(h)].top;
    const int g = regions()[plan_.region(Arrangement::twin(h))].top;
    if (f < 0 || g < 0) return 0;
    double jump_m = 0;
    for (const std::size_t end : {h, Arrangement::twin(h)}) {
      const Vec3 point = view_.point(plan_.origin(end));
      jump_m = std::max(jump_m, std::abs(view_.height_m(f, point) - view_.height_m(g, point)));
    }
    return jump_m;
  }

  /// The smallest first; the outside takes none of them.
  void join_small_parts() {
    while (true) {
      std::map<int, double> area_m2;
      for (std::size_t r = 1; r < regions().size(); ++r)
        if (part_of_[r] >= 0) area_m2[part_of_[r]] += regions()[r].area_m2;
      std::map<int, std::map<int, double>> border_m;
      for (std::size_t h = 0; h < plan_.half_edge_count(); ++h) {
        const int p = part_of_[plan_.region(h)];
        const int q = part_of_[plan_.region(Arrangement::twin(h))];
        if (p >= 0 && q >= 0 && p != q) border_m[p][q] += length_m(h);
      }
      int smallest = -1;
      for (const auto& [part, size_m2] : area_m2)
        if (size_m2 < options_.least_part_m2 && border_m.contains(part) &&
            (smallest < 0 || size_m2 < area_m2[smallest]))
          smallest = part;
      if (smallest < 0) return;
      const auto& around = border_m[smallest];
      const int into =
          std::ranges::max_element(around, {}, [](const auto& e) { return e.second; })->first;
      std::ranges::replace(part_of_, smallest, into);
    }
  }

  void number_parts() {
    std::map<int, int> number;
    for (int& part : part_of_)
      if (part >= 0) part = number.try_emplace(part, static_cast<int>(number.size())).first->second;
    heights_m_.assign(number.size(), 0);
  }

  /// Tops are whole millimetres: what is no measure of the building need not look like one.
  void find_heights() {
    std::vector<std::vector<std::array<RoofCorner, 3>>> fans(heights_m_.size());
    for (std::size_t r = 1; r < regions().size(); ++r) {
      const PlanView::PlanRegion& region = regions()[r];
      if (part_of_[r] < 0 || region.top < 0 || region.is_thin) continue;
      for (const Outline& outline : region.outlines)
        for (std::size_t i = 2; i < outline.size(); ++i)
          fans[at(part_of_[r])].push_back({corner(region.top, outline[0]),
                                           corner(region.top, outline[i - 1]),
                                           corner(region.top, outline[i])});
    }
    for (std::size_t p = 0; p < fans.size(); ++p)
      heights_m_[p] = std::round(quantile_m(fans[p]) * 1000) / 1000;
  }

  [[nodiscard]] RoofCorner corner(int facet, Vec3 point) const {
    return {point, view_.height_m(facet, point)};
  }

  /// The height below which the wanted share of the area lies.
  [[nodiscard]] double quantile_m(const std::vector<std::array<RoofCorner, 3>>& fan) const {
    double low = Box::kInfinity, high = -Box::kInfinity, all_m2 = 0;
    for (const auto& triangle : fan) {
      for (const RoofCorner& c : triangle) {
        low = std::min(low, c.z);
        high = std::max(high, c.z);
      }
      all_m2 += area_below(triangle, Box::kInfinity);
    }
    constexpr int kSteps = 40;  // of a hundred metres to far less than a micrometre
    for (int step = 0; step < kSteps; ++step) {
      const double mid = (low + high) / 2;
      double below_m2 = 0;
      for (const auto& triangle : fan) below_m2 += area_below(triangle, mid);
      (below_m2 < options_.height_share * all_m2 ? low : high) = mid;
    }
    return high;
  }

  const std::string& name_;
  const BlockOptions& options_;
  const Tolerances& tolerances_;
  Work& work_;
  PlanView view_;
  const Arrangement& plan_;
  std::vector<int> part_of_;  ///< by region; -1: outside
  std::vector<double> heights_m_;
  std::vector<std::vector<std::size_t>> edges_of_;  ///< by region, once they are asked for
};

}  // namespace

Checked<Blocks> blocks(const Solid& solid, const std::string& name, const BlockOptions& options,
                       const Tolerances& tolerances, Work& work) {
  return BlockBuilder(solid, name, options, tolerances, work).run();
}

}  // namespace oriel
