#include "kernel/segment/complex/sheet.h"

#include "kernel/segment/complex/arrangement.h"
#include "kernel/segment/complex/refine.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace oriel::detail {

namespace {

/// The cells on either side. Both invalid where they are the same: there is no face.
struct FaceCells {
  CellId front, behind;
  friend bool operator==(FaceCells, FaceCells) = default;
};

/// Joins the regions of an arrangement that have the same sides, and traces what is left.
class Sheet {
 public:
  Sheet(const Arrangement& arrangement, Owners& owners)
      : arrangement_(arrangement), group_(arrangement.region_count()) {
    for (const std::vector<int>& labels : arrangement.labels()) {
      std::vector<int> front, behind;
      for (const int label : labels)
        (is_in_front(label) ? front : behind).push_back(cell_of(label));
      const FaceCells sides{owners.of(front), owners.of(behind)};
      sides_.push_back(sides.front == sides.behind ? FaceCells{} : sides);
    }
    std::iota(group_.begin(), group_.end(), std::size_t{0});
    for (std::size_t h = 0; h < arrangement.half_edge_count(); h += 2)
      if (!is_border(h)) group_[group_of(region(h))] = group_of(region(Arrangement::twin(h)));
  }

  /// The loops of the faces, in no order.
  [[nodiscard]] std::vector<Face> faces(PlaneId plane) {
    std::map<std::size_t, Face> faces;
    std::vector<char> is_traced(arrangement_.half_edge_count(), 0);
    for (std::size_t start = 0; start < is_traced.size(); ++start) {
      const FaceCells& sides = sides_[region(start)];
      if (is_traced[start] != 0 || !is_border(start) || sides == FaceCells{}) continue;
      Loop loop;
      for (std::size_t h = start; is_traced[h] == 0; h = next_border(h)) {
        is_traced[h] = 1;
        loop.push_back(arrangement_.origin(h));
      }
      Face& face = faces[group_of(region(start))];
      face.plane = plane;
      face.front = sides.front;
      face.behind = sides.behind;
      face.loops.push_back(std::move(loop));
    }
    std::vector<Face> list;
    for (auto& [group, face] : faces) list.push_back(std::move(face));
    return list;
  }

 private:
  [[nodiscard]] std::size_t region(std::size_t h) const { return arrangement_.region(h); }
  [[nodiscard]] bool is_border(std::size_t h) const {
    return sides_[region(h)] != sides_[region(Arrangement::twin(h))];
  }
  [[nodiscard]] std::size_t next_border(std::size_t h) const {
    h = arrangement_.next(h);
    while (!is_border(h)) h = arrangement_.next(Arrangement::twin(h));
    return h;
  }
  std::size_t group_of(std::size_t region) {
    while (group_[region] != region) region = group_[region] = group_[group_[region]];
    return region;
  }

  const Arrangement& arrangement_;
  std::vector<FaceCells> sides_;
  std::vector<std::size_t> group_;
};

/// The outer loop first, each loop from its smallest vertex on.
void put_in_order(Face& face, const PlaneAxes& axes, const VertexPool& pool) {
  const auto area = [&](const Loop& loop) {
    const Vec2 base = axes(pool.at(loop[0]));
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
      sum +=
          cross(axes(pool.at(loop[i])) - base, axes(pool.at(loop[(i + 1) % loop.size()])) - base);
    return sum;
  };
  for (Loop& loop : face.loops) std::ranges::rotate(loop, std::ranges::min_element(loop));
  std::ranges::sort(face.loops);
  const auto outer = std::ranges::max_element(face.loops, {}, area);
  std::rotate(face.loops.begin(), outer, outer + 1);
}

}  // namespace

std::vector<Face> faces_of_sheet(PlaneId plane, Vec3 normal, std::vector<Chord> chords,
                                 Owners& owners, VertexPool& pool) {
  const PlaneAxes axes(normal);
  const std::vector<PlanarEdge> edges = refine(std::move(chords), axes, pool);
  const Arrangement arrangement(edges, axes, pool);
  std::vector<Face> faces = Sheet(arrangement, owners).faces(plane);
  for (Face& face : faces) put_in_order(face, axes, pool);
  std::ranges::sort(faces, {}, [](const Face& face) {
    return std::pair{std::pair{face.behind, face.front}, face.loops};
  });
  return faces;
}

}  // namespace oriel::detail
