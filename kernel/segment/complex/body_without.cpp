#include "kernel/segment/complex/body_without.h"

#include "kernel/segment/complex/arrangement.h"
#include "kernel/segment/complex/outlines.h"
#include "kernel/segment/complex/refine.h"
#include "kernel/segment/complex/vertex_pool.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

namespace oriel {

namespace {

/// As in cell_complex(): points nearer than this part of weld_m are one.
constexpr double kBodyReach = 0.25;

/// The only label: how often the body is behind the plane, less how often it is before it.
constexpr int kBehind = 0;

/// Bodies with the sign with which each counts, the solid first, on common planes and vertices.
struct SignedBodies {
  std::vector<Plane> planes;
  VertexPool pool;
  std::vector<std::vector<Facet>> facets;  ///< by body
  std::vector<int> signs;
};

void move_numbers(Facet& facet, int planes, int vertices) {
  facet.plane = PlaneId{static_cast<int>(facet.plane.index()) + planes};
  for (Loop& loop : facet.loops)
    for (int& v : loop) v += vertices;
}

SignedBodies signed_bodies(const Solid& solid, const Segmentation& segmentation,
                           const VertexPool& pool, std::span<const CellId> leaves) {
  SignedBodies bodies{segmentation.planes, pool, {solid.facets}, {1}};
  const int planes = static_cast<int>(bodies.planes.size());
  const int vertices = static_cast<int>(pool.vertices().size());
  bodies.planes.insert(bodies.planes.end(), solid.planes.begin(), solid.planes.end());
  bodies.pool.append(solid.vertices);
  for (Facet& facet : bodies.facets[0]) move_numbers(facet, planes, vertices);
  for (const CellId leaf : leaves) {
    bodies.facets.push_back(segmentation.cells[leaf.index()].facets);
    bodies.signs.push_back(-segmentation.cells[leaf.index()].sign);
  }
  return bodies;
}

/// A piece of a plane, its loops counter-clockwise about the normal, and how often it is there.
struct SheetPiece {
  std::vector<Loop> loops;
  int count = 0;
};

std::vector<SheetPiece> sheet_pieces_of(std::vector<Chord> chords, Vec3 normal, VertexPool& pool,
                                        Work& work) {
  const PlaneAxes axes(normal);
  const auto edges = refine(std::move(chords), axes, pool, work);
  const Arrangement arrangement(edges, axes, pool);
  const auto windings = arrangement.windings();
  std::vector<SheetPiece> pieces(arrangement.region_count());
  for (std::size_t r = 0; r < pieces.size(); ++r)
    if (!windings[r].empty()) pieces[r].count = windings[r][0].second;
  std::vector<char> is_traced(arrangement.half_edge_count(), 0);
  for (std::size_t start = 0; start < is_traced.size(); ++start) {
    SheetPiece& piece = pieces[arrangement.region(start)];
    if (is_traced[start] != 0 || piece.count == 0) continue;
    Loop loop;
    for (std::size_t h = start; is_traced[h] == 0; h = arrangement.next(h)) {
      is_traced[h] = 1;
      loop.push_back(arrangement.origin(h));
    }
    piece.loops.push_back(std::move(loop));
  }
  std::erase_if(pieces, [](const SheetPiece& piece) { return piece.count == 0; });
  return pieces;
}

class BodySummer {
 public:
  explicit BodySummer(SignedBodies bodies)
      : planes_(std::move(bodies.planes)),
        signs_(std::move(bodies.signs)),
        pool_(std::move(bodies.pool)),
        sheets_(detail::sheets_of(planes_)),
        facets_(detail::whole_outlines(std::move(bodies.facets), sheets_, pool_)) {}

  std::optional<CellComplex> run(Work& work) {
    std::map<PlaneId, std::vector<std::pair<std::size_t, const Facet*>>> facets_in;
    for (std::size_t body = 0; body < facets_.size(); ++body)
      for (const Facet& facet : facets_[body])
        facets_in[sheets_[facet.plane.index()]].emplace_back(body, &facet);
    for (const auto& [sheet, facets] : facets_in) {
      if (facets.back().first == 0) {
        for (const auto& [body, facet] : facets) add_whole(sheet, *facet);
        continue;
      }
      std::vector<Chord> chords;
      for (const auto& [body, facet] : facets) add_chords(*facet, signs_[body], chords);
      for (SheetPiece& piece : sheet_pieces_of(std::move(chords), normal_of(sheet), pool_, work))
        for (int i = 0; i < std::abs(piece.count); ++i) add(sheet, piece.loops, piece.count > 0);
      if (work.is_used_up()) return std::nullopt;
    }
    detail::conform(faces_, pool_.vertices(), pool_.reach_m() / 2);
    for (Face& face : faces_)
      for (const Loop& loop : face.loops)
        face.area_m2 += signed_area_m2(pool_.vertices(), loop, normal_of(face.plane));
    return CellComplex(pool_.take(), std::move(faces_), 1);
  }

 private:
  [[nodiscard]] Vec3 normal_of(PlaneId plane) const { return planes_[plane.index()].normal; }

  static void add_chords(const Facet& facet, int count, std::vector<Chord>& chords) {
    for (const Loop& loop : facet.loops)
      for (std::size_t i = 0; i < loop.size(); ++i)
        chords.push_back({loop[i], loop[(i + 1) % loop.size()], kBehind, count});
  }

  /// A facet that nothing is taken from.
  void add_whole(PlaneId sheet, const Facet& facet) {
    const bool looks_forward = dot(normal_of(facet.plane), normal_of(sheet)) > 0;
    std::vector<Loop> loops = facet.loops;
    if (!looks_forward)
      for (Loop& loop : loops) std::ranges::reverse(loop);
    add(sheet, std::move(loops), looks_forward);
  }

  /// `loops` are counter-clockwise about the normal.
  void add(PlaneId sheet, std::vector<Loop> loops, bool is_behind) {
    std::erase_if(loops, [](const Loop& loop) { return loop.size() < 3; });
    if (loops.empty()) return;
    const auto area_m2 = [&](const Loop& loop) {
      return signed_area_m2(pool_.vertices(), loop, normal_of(sheet));
    };
    const auto outer = std::ranges::max_element(loops, {}, area_m2);
    std::rotate(loops.begin(), outer, outer + 1);
    Face face{sheet, std::move(loops), {}, {}};
    (is_behind ? face.behind : face.front) = CellId{0};
    faces_.push_back(std::move(face));
  }

  std::vector<Plane> planes_;
  std::vector<int> signs_;
  VertexPool pool_;
  std::vector<PlaneId> sheets_;
  std::vector<std::vector<Facet>> facets_;  ///< by body
  std::vector<Face> faces_;
};

}  // namespace

std::optional<CellComplex> body_without(const Solid& solid, const Segmentation& segmentation,
                                        const VertexPool& vertices, std::span<const CellId> leaves,
                                        Work& work) {
  return BodySummer(signed_bodies(solid, segmentation, vertices, leaves)).run(work);
}

VertexPool vertices_of(const Segmentation& segmentation, const Tolerances& tolerances) {
  return {segmentation.vertices, tolerances.weld_m * kBodyReach};
}

}  // namespace oriel
