#include "kernel/solidify/crossings/signed_faces.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace oriel::detail {

namespace {

/// How often the rings of a cut polygon wind round each of its faces.
class FaceWindings {
 public:
  FaceWindings(const Soup& soup, Vec3 normal, const CutPolygon& cut)
      : faces(soup, normal, both_ways(cut)) {
    for (const auto& ring : cut.rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const int from = ring[i], to = ring[(i + 1) % ring.size()];
        ++runs_[{from, to}];
        --runs_[{to, from}];
      }
    for (int l = 0; l < std::ssize(faces.loops); ++l)
      for_each_edge(l, [&](const Edge& edge) { left_of_[edge] = l; });
  }

  /// By loop: of what is to its left. Nothing if the rings are contradictory.
  std::optional<Numbers> run() {
    windings_.resize(faces.loops.size());
    for (int l = 0; l < std::ssize(faces.loops); ++l)
      if (faces.areas[at(l)] <= 0 && faces.face_of[at(l)] < 0) reach(l, 0);
    while (!reached_.empty()) {
      const int l = reached_.back();
      reached_.pop_back();
      spread(l);
    }
    if (is_contradictory_) return std::nullopt;
    Numbers windings;
    for (const auto& winding : windings_) windings.push_back(winding.value_or(0));
    return windings;
  }

 private:
  static std::vector<Edge> both_ways(const CutPolygon& cut) {
    std::set<Edge> edges(cut.edges.begin(), cut.edges.end());
    for (const auto& ring : cut.rings)
      for (std::size_t i = 0; i < ring.size(); ++i)
        edges.insert(std::minmax(ring[i], ring[(i + 1) % ring.size()]));
    std::vector<Edge> half_edges;
    for (const auto& [low, high] : edges) {
      half_edges.emplace_back(low, high);
      half_edges.emplace_back(high, low);
    }
    return half_edges;
  }

  template <class Visit>
  void for_each_edge(int loop, Visit visit) const {
    const auto& points = faces.loops[at(loop)];
    for (std::size_t i = 0; i < points.size(); ++i)
      visit(Edge(points[i], points[(i + 1) % points.size()]));
  }

  void reach(int loop, int winding) {
    auto& known = windings_[at(loop)];
    if (known) {
      is_contradictory_ |= *known != winding;
      return;
    }
    known = winding;
    reached_.push_back(loop);
  }

  /// To the loops of the same face, and across its edges: who goes over a ring to its left side
  /// finds one more.
  void spread(int loop) {
    const int winding = *windings_[at(loop)];
    if (faces.face_of[at(loop)] >= 0) reach(faces.face_of[at(loop)], winding);
    for (int l = 0; l < std::ssize(faces.loops); ++l)
      if (faces.face_of[at(l)] == loop) reach(l, winding);
    for_each_edge(loop, [&](const Edge& edge) {
      const auto other = left_of_.find({edge.second, edge.first});
      const auto run = runs_.find(edge);
      if (other != left_of_.end())
        reach(other->second, winding - (run == runs_.end() ? 0 : run->second));
    });
  }

 public:
  const Faces faces;

 private:
  std::map<Edge, int> runs_;  ///< how often rings run along a half-edge, less how often against it
  std::map<Edge, int> left_of_;  ///< by half-edge the loop that it is of
  std::vector<std::optional<int>> windings_;
  Numbers reached_;
  bool is_contradictory_ = false;
};

/// One face that the rings go round once.
bool is_one_face(const Faces& faces, const Numbers& windings) {
  int count = 0;
  for (std::size_t i = 0; i < windings.size(); ++i)
    if (faces.areas[i] > 0 && windings[i] != 0) {
      if (windings[i] != 1) return false;
      ++count;
    }
  return count == 1;
}

}  // namespace

bool add_signed_faces(const Soup& soup, const PolygonShape& shape, const CutPolygon& cut,
                      double slack, SoupBuilder& builder) {
  FaceWindings found(soup, shape.unit, cut);
  const Faces& faces = found.faces;
  const auto windings = found.run();
  double sum = 0;
  for (std::size_t i = 0; windings && i < faces.loops.size(); ++i)
    sum += (*windings)[i] * faces.areas[i];
  const SoupPolygon& said = soup.polygons[at(cut.polygon)];
  if (!windings || std::abs(sum - shape.area) > slack || is_one_face(faces, *windings)) {
    builder.begin_polygon(said);
    for (const auto& ring : cut.rings) builder.add_ring(ring);
    return false;
  }
  for (std::size_t i = 0; i < faces.loops.size(); ++i) {
    if (faces.areas[i] <= 0) continue;
    for (int n = std::abs((*windings)[i]); n > 0; --n) {
      builder.begin_polygon(said);
      for (const std::size_t j : faces.rings_of(i)) {
        std::vector<int> ring = faces.loops[j];
        if ((*windings)[i] < 0) std::ranges::reverse(ring);
        builder.add_ring(ring);
      }
    }
  }
  return true;
}

}  // namespace oriel::detail
