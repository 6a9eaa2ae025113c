#include "kernel/solidify/crossings/crossings.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/geometry/planar.h"
#include "kernel/solidify/crossings/chords.h"
#include "kernel/solidify/crossings/faces.h"
#include "kernel/solidify/shells/edge_groups.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace oriel::detail {

namespace {

/// A look at a polygon that an edge comes near, and at a corner of it.
constexpr std::int64_t kStepsPerContact = 4;

class ContactCutter {
 public:
  ContactCutter(const Soup& soup, std::span<const PolygonShape> shapes, double reach, Work& work)
      : soup_(soup), shapes_(shapes), reach_(reach), work_(work) {}

  SoupWithContacts run() {
    find_contacts();
    SoupBuilder builder(soup_);
    for (int p = 0; p < soup_.polygon_count(); ++p) {
      const auto found = contacts_.find(p);
      if (found == contacts_.end())
        builder.add_polygon(soup_, p);
      else
        cut_ += add_faces(soup_, shapes_[at(p)], {p, rings_of(soup_, p), found->second},
                          kSameArea * shapes_[at(p)].area, builder);
    }
    return {builder.finish(), cut_};
  }

 private:
  [[nodiscard]] Vec3 place(int point) const { return exact::to_metres(soup_.points[at(point)], 1); }

  void find_contacts() {
    std::vector<Box> boxes(soup_.polygons.size());
    for (int p = 0; p < soup_.polygon_count(); ++p)
      for (const int v : soup_.corners_of(p)) boxes[at(p)].grow(place(v));
    const BoxTree tree(std::move(boxes));
    const ShellMesh mesh = linked_rings(soup_);
    EdgeGroups(soup_, mesh).for_each([&](EdgeGroup group) {
      if (group.size() != 1 || work_.is_used_up()) return;
      const int own = mesh.polygon_of[at(group[0])];
      const PointPair edge =
          std::minmax({soup_.corners[at(group[0])], soup_.corners[at(mesh.next[at(group[0])])]});
      const Vec3 from = place(edge.first), to = place(edge.second);
      tree.search([&](const Box& box) { return comes_near(box, from, to, reach_); },
                  [&](int p) {
                    work_.add(kStepsPerContact);
                    const bool is_same_body =
                        soup_.polygons[at(p)].body == soup_.polygons[at(own)].body;
                    if (p != own && is_same_body && lies_on(from, to, p))
                      contacts_[p].push_back(edge);
                  });
    });
  }

  [[nodiscard]] bool lies_on(Vec3 from, Vec3 to, int p) const {
    const Vec3 normal = shapes_[at(p)].unit, base = place(soup_.corners_of(p).front());
    if (std::abs(dot(normal, from - base)) > reach_ || std::abs(dot(normal, to - base)) > reach_)
      return false;
    work_.add(kStepsPerContact * std::ssize(soup_.corners_of(p)));
    return contains_clearly(outlines_of(soup_, p), normal, 0.5 * (from + to), reach_);
  }

  const Soup& soup_;
  std::span<const PolygonShape> shapes_;
  double reach_;
  Work& work_;
  std::map<int, std::vector<PointPair>> contacts_;  ///< by polygon
  int cut_ = 0;
};

}  // namespace

SoupWithContacts cut_at_contacts(const Soup& soup, std::span<const PolygonShape> shapes,
                                 double reach, Work& work) {
  ORIEL_ASSERT(shapes.size() == soup.polygons.size());
  return ContactCutter(soup, shapes, reach, work).run();
}

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
      for_each_edge(l, [&](const PointPair& edge) { left_of_[edge] = l; });
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
  static std::vector<PointPair> both_ways(const CutPolygon& cut) {
    std::set<PointPair> edges(cut.edges.begin(), cut.edges.end());
    for (const auto& ring : cut.rings)
      for (std::size_t i = 0; i < ring.size(); ++i)
        edges.insert(std::minmax(ring[i], ring[(i + 1) % ring.size()]));
    std::vector<PointPair> half_edges;
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
      visit(PointPair(points[i], points[(i + 1) % points.size()]));
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
    for_each_edge(loop, [&](const PointPair& edge) {
      const auto other = left_of_.find({edge.second, edge.first});
      const auto run = runs_.find(edge);
      if (other != left_of_.end())
        reach(other->second, winding - (run == runs_.end() ? 0 : run->second));
    });
  }

 public:
  const Faces faces;

 private:
  std::map<PointPair, int>
      runs_;  ///< how often rings run along a half-edge, less how often against it
  std::map<PointPair, int> left_of_;  ///< by half-edge the loop that it is of
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

/// Adds the faces that a polygon encloses once its rings, which may cross each other, and the edges
/// on it are cut where they meet: each as often as the rings wind round it, turned round where they
/// wind clockwise. So what is added has the boundary that the rings have, whatever they do: the
/// part of a hole that reaches beyond its outer ring is a face that looks the other way. True if
/// that is anything else than the rings as they are. They are added as they are if the faces' area
/// differs from the rings' by more than `slack` (grid units squared), as something did not meet.
/// The builder is like `soup`.
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

/// What finding out how two edges meet takes, and what sorting one into faces.
constexpr std::int64_t kStepsPerMeeting = 8, kStepsPerFaceEdge = 32;

/// The edges of a polygon's rings and the chords on it, cut where they meet.
class ChordSubdivision {
 public:
  ChordSubdivision(const Soup& soup, const PolygonShape& shape, int polygon,
                   std::span<const PointPair> chords, GrowingPoints& points, double weld,
                   RingKind kind, Work& work)
      : shape_(shape),
        polygon_(polygon),
        rings_(rings_of(soup, polygon)),
        points_(points),
        weld_(weld),
        kind_(kind),
        work_(work) {
    for (const auto& ring : rings_)
      for (std::size_t i = 0; i < ring.size(); ++i)
        edges_.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
    ring_edges_ = edges_.size();
    std::set<PointPair> rim;
    for (const PointPair& e : edges_) rim.insert(std::minmax(e.first, e.second));
    for (const PointPair& e : chords)
      if (!rim.contains(e)) edges_.push_back(e);
    on_.resize(edges_.size());
  }

  [[nodiscard]] bool has_chords() const { return edges_.size() > ring_edges_; }

  CutPolygon run() {
    find_meetings();
    CutPolygon cut{polygon_, {}, {}};
    std::set<PointPair> rim;
    std::size_t e = 0;
    for (const auto& ring : rings_) {
      cut.rings.emplace_back();
      for (std::size_t i = 0; i < ring.size(); ++i, ++e) {
        const auto pieces = pieces_of(e);
        for (const PointPair& piece : pieces) {
          cut.rings.back().push_back(piece.first);
          rim.insert(std::minmax(piece.first, piece.second));
        }
      }
    }
    std::set<PointPair> inside;
    for (; e < edges_.size(); ++e)
      for (const PointPair& piece : pieces_of(e)) {
        const PointPair edge = std::minmax(piece.first, piece.second);
        const bool is_wanted = kind_ == RingKind::crossing || lies_within(edge);
        if (!rim.contains(edge) && is_wanted) inside.insert(edge);
      }
    cut.edges.assign(inside.begin(), inside.end());
    return cut;
  }

 private:
  [[nodiscard]] Vec3 flat(Vec3 way) const { return way - dot(way, shape_.unit) * shape_.unit; }

  /// Puts on every edge the points at which others meet it.
  void find_meetings() {
    std::vector<Box> boxes(edges_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      boxes[e].grow(points_.place(edges_[e].first));
      boxes[e].grow(points_.place(edges_[e].second));
    }
    const BoxTree tree(std::move(boxes));
    // Chords may lie beside the plane by more than the weld distance.
    const double reach = 4 * weld_;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const Vec3 from = points_.place(edges_[e].first), to = points_.place(edges_[e].second);
      tree.search([&](const Box& box) { return comes_near(box, from, to, reach); },
                  [&](int other) {
                    if (other > static_cast<int>(e)) meet(e, at(other));
                  });
    }
  }

  void meet(std::size_t e, std::size_t f) {
    work_.add(kStepsPerMeeting);
    if (work_.is_used_up()) return;
    bool is_met = false;
    for (const int v : {edges_[f].first, edges_[f].second}) is_met |= put_on(e, v);
    for (const int v : {edges_[e].first, edges_[e].second}) is_met |= put_on(f, v);
    if (is_met) return;
    if (const auto where = crossing(edges_[e], edges_[f])) {
      const int point = points_.point_at(*where);
      on_[e].push_back(point);
      on_[f].push_back(point);
    }
  }

  /// Puts a point on an edge if it lies there, seen along the normal; true too for an end of it.
  bool put_on(std::size_t e, int point) {
    if (point == edges_[e].first || point == edges_[e].second) return true;
    const Vec3 from = points_.place(edges_[e].first);
    const Vec3 way = flat(points_.place(edges_[e].second) - from);
    const Vec3 there = flat(points_.place(point) - from);
    const double share = dot(there, way) / dot(way, way);
    if (!(share > 0 && share < 1) || length(there - share * way) > weld_) return false;
    on_[e].push_back(point);
    return true;
  }

  /// Where two edges cross between their ends, on the first one.
  [[nodiscard]] std::optional<Vec3> crossing(const PointPair& e, const PointPair& f) const {
    const Vec3 a = points_.place(e.first), b = points_.place(e.second);
    const Vec3 c = points_.place(f.first), d = points_.place(f.second);
    const auto side = [&](Vec3 from, Vec3 to, Vec3 p) {
      return dot(shape_.unit, cross(to - from, p - from));
    };
    const double at_a = side(c, d, a), at_b = side(c, d, b);
    if ((at_a > 0) == (at_b > 0) || (side(a, b, c) > 0) == (side(a, b, d) > 0)) return std::nullopt;
    return a + (at_a / (at_a - at_b)) * (b - a);
  }

  /// An edge as it runs, cut at the points on it.
  [[nodiscard]] std::vector<PointPair> pieces_of(std::size_t e) const {
    const Vec3 from = points_.place(edges_[e].first);
    const Vec3 way = points_.place(edges_[e].second) - from;
    std::vector<std::pair<double, int>> stops;
    for (const int v : on_[e]) stops.emplace_back(dot(points_.place(v) - from, way), v);
    std::ranges::sort(stops);
    stops.emplace_back(0, edges_[e].second);
    std::vector<PointPair> pieces;
    int last = edges_[e].first;
    for (const auto& [along, v] : stops) {
      if (v != last) pieces.emplace_back(last, v);
      last = v;
    }
    return pieces;
  }

  [[nodiscard]] bool lies_within(const PointPair& edge) {
    work_.add(static_cast<std::int64_t>(ring_edges_));
    if (outlines_.empty())
      for (const auto& ring : rings_) {
        outlines_.emplace_back();
        for (const int v : ring) outlines_.back().push_back(points_.place(v));
      }
    return contains(outlines_, shape_.unit,
                    0.5 * (points_.place(edge.first) + points_.place(edge.second)));
  }

  PolygonShape shape_;
  int polygon_;
  std::vector<std::vector<int>> rings_;
  GrowingPoints& points_;
  double weld_;
  RingKind kind_;
  Work& work_;
  std::vector<PointPair> edges_;  ///< of the rings as they run, then the chords
  std::size_t ring_edges_ = 0;
  std::vector<std::vector<int>> on_;  ///< by edge the points between its ends
  std::vector<Outline> outlines_;
};

std::int64_t edges_in(const CutPolygon& cut) {
  std::int64_t count = std::ssize(cut.edges);
  for (const auto& ring : cut.rings) count += std::ssize(ring);
  return count;
}

}  // namespace

SoupWithoutCrossings cut_at_crossings(const Soup& soup, double reach, double weld, Work& work,
                                      RingKind rings) {
  ORIEL_ASSERT(reach >= 0 && weld > 0);
  const std::vector<PolygonShape> shapes = shapes_of(soup);
  GrowingPoints points(soup.points, weld);
  const auto chords = find_chords(soup, shapes, reach, points, work);
  std::vector<std::optional<CutPolygon>> cuts(soup.polygons.size());
  for (int p = 0; p < soup.polygon_count(); ++p) {
    work.add(std::ssize(chords[at(p)]) + std::ssize(soup.corners_of(p)));
    if (work.is_used_up()) break;
    ChordSubdivision subdivision(soup, shapes[at(p)], p, chords[at(p)], points, weld, rings, work);
    if (rings == RingKind::crossing || subdivision.has_chords()) cuts[at(p)] = subdivision.run();
  }
  if (work.is_used_up()) return {soup, 0};
  Soup grown = soup;
  grown.points = points.take();
  SoupBuilder builder(grown);
  SoupWithoutCrossings out;
  for (int p = 0; p < soup.polygon_count(); ++p) {
    if (cuts[at(p)]) work.add(kStepsPerFaceEdge * edges_in(*cuts[at(p)]));
    if (work.is_used_up()) return {soup, 0};
    if (!cuts[at(p)]) {
      builder.add_polygon(grown, p);
      continue;
    }
    double rim = 0;
    for (const Outline& outline : outlines_of(grown, p)) rim += perimeter(outline);
    const double slack = kSameArea * shapes[at(p)].area + weld * rim;
    const auto add = rings == RingKind::crossing ? add_signed_faces : add_faces;
    out.cut += add(grown, shapes[at(p)], *cuts[at(p)], slack, builder);
  }
  out.soup = builder.finish();
  return out;
}

}  // namespace oriel::detail
