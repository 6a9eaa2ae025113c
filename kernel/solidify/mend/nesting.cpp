#include "kernel/solidify/mend/nesting.h"

#include "kernel/base/index.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace oriel::detail {

namespace {

/// The boundary of a piece, as far as its role depends on it.
struct PieceBoundary {
  int polygon = -1;         ///< its first one
  double input_volume = 0;  ///< as the input's polygons run
};

class RoleFinder {
 public:
  RoleFinder(const Soup& soup, const std::vector<PolygonShape>& shapes, const PolygonCells& cells,
             bool is_solid)
      : soup_(soup), shapes_(shapes), cells_(cells), is_solid_(is_solid) {}

  std::vector<PieceRole> run() {
    std::vector<PieceRole> roles(at(cells_.piece_count), PieceRole::nothing);
    const std::vector<PieceBoundary> pieces = boundaries();
    Numbers enclosing;
    for (int i = 0; i < cells_.piece_count; ++i)
      if (pieces[at(i)].polygon >= 0) enclosing.push_back(i);
    if (enclosing.size() == 1) roles[at(enclosing[0])] = PieceRole::lump;
    if (enclosing.size() <= 1) return roles;

    const std::vector<Numbers> around = pieces_around(pieces);
    std::ranges::stable_sort(enclosing, {}, [&](int i) { return around[at(i)].size(); });
    for (const int i : enclosing) {
      int depth = 0;  // how much material there is around it
      for (const int j : around[at(i)])
        depth += (roles[at(j)] == PieceRole::lump) - (roles[at(j)] == PieceRole::cavity);
      roles[at(i)] = depth <= 0                    ? PieceRole::lump
                     : wants_cavity(pieces[at(i)]) ? PieceRole::cavity
                                                   : PieceRole::within;
    }
    return roles;
  }

 private:
  [[nodiscard]] Vec3 place(int point) const { return exact::to_metres(soup_.points[at(point)], 1); }

  [[nodiscard]] std::vector<PieceBoundary> boundaries() const {
    std::vector<PieceBoundary> pieces(at(cells_.piece_count));
    for (int p = 0; p < soup_.polygon_count(); ++p) {
      if (!cells_.is_boundary(p)) continue;
      PieceBoundary& piece = pieces[at(cells_.piece[at(p)])];
      if (piece.polygon < 0) piece.polygon = p;
      piece.input_volume += shapes_[at(p)].area *
                            dot(shapes_[at(p)].unit, place(soup_.corners_of(p).front()) - place(0));
    }
    return pieces;
  }

  [[nodiscard]] bool wants_cavity(const PieceBoundary& piece) const {
    return is_solid_ ? soup_.polygons[at(piece.polygon)].shell > 0 : piece.input_volume < 0;
  }

  [[nodiscard]] Box box_of_polygon(int p) const {
    Box box;
    for (const int v : soup_.corners_of(p)) box.grow(place(v));
    return box;
  }

  /// Of every piece that encloses something the others of its body whose boundary it lies in: a ray
  /// from its first point crosses that an odd number of times.
  [[nodiscard]] std::vector<Numbers> pieces_around(const std::vector<PieceBoundary>& pieces) const {
    Numbers polygons;
    std::vector<Box> boxes;
    Box all;
    for (int p = 0; p < soup_.polygon_count(); ++p) {
      if (!cells_.is_boundary(p)) continue;
      polygons.push_back(p);
      boxes.push_back(box_of_polygon(p));
      all.grow(boxes.back());
    }
    const BoxTree tree(std::move(boxes));
    std::vector<Numbers> around(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].polygon < 0) continue;
      const Vec3 eye = place(soup_.corners_of(pieces[i].polygon).front());
      const Vec3 far = eye + 2 * length(all.max - all.min) * kRay;
      std::map<int, int> crossings;
      tree.search([&](const Box& box) { return comes_near(box, eye, far, 0); },
                  [&](int item) {
                    const int p = polygons[at(item)], piece = cells_.piece[at(p)];
                    if (piece == static_cast<int>(i) || body(p) != body(pieces[i].polygon)) return;
                    if (is_hit(p, eye)) ++crossings[piece];
                  });
      for (const auto& [piece, count] : crossings)
        if (count % 2 == 1) around[i].push_back(piece);
    }
    return around;
  }

  [[nodiscard]] int body(int polygon) const { return soup_.polygons[at(polygon)].body; }

  [[nodiscard]] bool is_hit(int p, Vec3 eye) const {
    const Vec3 normal = shapes_[at(p)].unit;
    const double slope = dot(normal, kRay);
    if (slope == 0) return false;
    const double way = dot(normal, place(soup_.corners_of(p).front()) - eye) / slope;
    if (way <= 0) return false;
    std::vector<Outline> outlines;
    for (const int r : soup_.rings_of(p)) {
      outlines.emplace_back();
      for (const int v : soup_.ring(r)) outlines.back().push_back(place(v));
    }
    return contains(outlines, normal, eye + way * kRay);
  }

  /// A direction that no wall, roof or edge of a building has.
  static constexpr Vec3 kRay{0.3127716, 0.5418393, 0.7801215};

  const Soup& soup_;
  const std::vector<PolygonShape>& shapes_;
  const PolygonCells& cells_;
  bool is_solid_;
};

}  // namespace

std::vector<PieceRole> find_roles(const Soup& soup, const std::vector<PolygonShape>& shapes,
                                  const PolygonCells& cells, bool is_solid) {
  return RoleFinder(soup, shapes, cells, is_solid).run();
}

}  // namespace oriel::detail
