#include "kernel/solidify/missing/missing_faces.h"

#include "kernel/base/index.h"
#include "kernel/geometry/planar.h"
#include "kernel/solidify/missing/rim_pieces.h"
#include "kernel/solidify/missing/rims.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

namespace oriel::detail {

namespace {

/// What is missing in one plane.
struct PlaneOfPieces {
  Vec3 normal;  ///< that of its largest piece
  double level = 0;
  HoleRim edges;  ///< of all pieces; chords that two of them share are gone
};

/// A closed line of edges in a plane.
struct Outlined {
  std::vector<int> ring;
  Outline outline;
  double area = 0;  ///< negative: it runs clockwise
  int beside = -1;
  int around = -1;  ///< the smallest of the others that it lies in
};

class FaceFinder {
 public:
  FaceFinder(const Soup& soup, std::vector<PlanePiece> pieces, double reach, Work& work)
      : soup_(soup), pieces_(std::move(pieces)), reach_(reach), work_(work) {}

  std::optional<std::vector<MissingFace>> run() {
    divide_chords();
    for (const PlaneOfPieces& plane : planes())
      if (work_.is_used_up() || !add_faces(plane)) return std::nullopt;
    return std::move(faces_);
  }

 private:
  [[nodiscard]] Vec3 place(int point) const { return exact::to_metres(soup_.points[at(point)], 1); }

  /// Puts the points of rims that lie on a chord into it: there another face begins or ends.
  void divide_chords() {
    std::vector<int> points;
    for (const PlanePiece& piece : pieces_)
      for (const HoleEdge& edge : piece.rim) points.push_back(edge.from);
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (PlanePiece& piece : pieces_) {
      HoleRim divided;
      for (const HoleEdge& edge : piece.rim) {
        if (edge.polygon >= 0)
          divided.push_back(edge);
        else
          divide(edge, points, divided);
      }
      piece.rim = std::move(divided);
    }
  }

  void divide(const HoleEdge& chord, std::span<const int> points, HoleRim& divided) const {
    const Vec3 from = place(chord.from), way = place(chord.to) - from, axis = normalised(way);
    std::vector<std::pair<double, int>> on;
    work_.add(std::ssize(points));
    if (work_.is_used_up()) return;
    for (const int v : points) {
      if (v == chord.from || v == chord.to) continue;
      const double along = dot(place(v) - from, axis);
      if (along > 0 && along < length(way) && length(place(v) - from - along * axis) <= reach_)
        on.emplace_back(along, v);
    }
    std::ranges::sort(on);
    int last = chord.from;
    for (const auto& [along, v] : on)
      divided.push_back({std::exchange(last, v), v, -1, chord.beside});
    divided.push_back({last, chord.to, -1, chord.beside});
  }

  /// The largest piece of a plane says where it lies.
  std::vector<PlaneOfPieces> planes() {
    std::ranges::stable_sort(pieces_, std::ranges::greater{},
                             [](const PlanePiece& piece) { return length(piece.area); });
    std::vector<PlaneOfPieces> planes;
    for (const PlanePiece& piece : pieces_) {
      if (work_.is_used_up()) return planes;
      const auto holds = [&](const PlaneOfPieces& plane) {
        work_.add(1);
        return std::ranges::all_of(piece.rim, [&](const HoleEdge& edge) {
          return std::abs(dot(plane.normal, place(edge.from)) - plane.level) <= reach_;
        });
      };
      auto plane = std::ranges::find_if(planes, holds);
      if (plane == planes.end()) {
        const Vec3 normal = normalised(piece.area);
        double sum = 0;
        for (const HoleEdge& edge : piece.rim) sum += dot(normal, place(edge.from));
        plane =
            planes.insert(plane, {normal, sum / static_cast<double>(piece.rim.size()), HoleRim{}});
      }
      for (const HoleEdge& edge : piece.rim) add_edge(plane->edges, edge);
    }
    return planes;
  }

  /// Two pieces of one face share a chord.
  void add_edge(HoleRim& edges, const HoleEdge& edge) const {
    work_.add(std::ssize(edges));
    const auto opposite = std::ranges::find_if(edges, [&](const HoleEdge& other) {
      return other.from == edge.to && other.to == edge.from;
    });
    if (opposite == edges.end())
      edges.push_back(edge);
    else
      edges.erase(opposite);
  }

  bool add_faces(const PlaneOfPieces& plane) {
    std::vector<Outlined> lines = closed_lines(plane);
    std::ranges::stable_sort(lines, std::ranges::greater{},
                             [](const Outlined& line) { return std::abs(line.area); });
    std::vector<int> face_of(lines.size(), -1);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      work_.add(std::ssize(lines[i].ring));
      if (work_.is_used_up()) return false;
      const auto inside = interior_point({&lines[i].outline, 1}, plane.normal);
      if (!inside) return false;
      for (std::size_t j = i; j-- > 0 && lines[i].around < 0;) {
        work_.add(std::ssize(lines[j].ring));
        if (contains({&lines[j].outline, 1}, plane.normal, *inside))
          lines[i].around = static_cast<int>(j);
      }
      const int around = lines[i].around;
      // What lies in an outline runs against it: a hole in a face, a face in a hole.
      if (around >= 0 && (lines[at(around)].area > 0) == (lines[i].area > 0)) return false;
      const bool is_hole = around >= 0 && face_of[at(around)] >= 0;
      if (is_hole) {
        MissingFace& face = faces_[at(face_of[at(around)])];
        face.rings.push_back(std::move(lines[i].ring));
        face.area -= std::abs(lines[i].area);
        continue;
      }
      face_of[i] = static_cast<int>(faces_.size());
      faces_.push_back({{std::move(lines[i].ring)}, std::abs(lines[i].area), lines[i].beside});
    }
    return true;
  }

  [[nodiscard]] std::vector<Outlined> closed_lines(const PlaneOfPieces& plane) const {
    std::map<int, std::vector<std::size_t>> starting;
    for (std::size_t e = 0; e < plane.edges.size(); ++e) starting[plane.edges[e].from].push_back(e);
    std::vector<char> is_seen(plane.edges.size(), 0);
    std::vector<Outlined> lines;
    for (std::size_t start = 0; start < plane.edges.size(); ++start) {
      if (is_seen[start]) continue;
      Outlined line;
      for (std::size_t e = start; !std::exchange(is_seen[e], 1);) {
        const HoleEdge& edge = plane.edges[e];
        line.ring.push_back(edge.from);
        line.outline.push_back(place(edge.from));
        line.beside = edge.beside;
        e = following(plane, edge, starting.at(edge.to), is_seen, start);
      }
      line.area = signed_area(line.outline, plane.normal);
      lines.push_back(std::move(line));
    }
    return lines;
  }

  /// Of the edges that begin where another one ends, the one round whose corner the face lies.
  [[nodiscard]] std::size_t following(const PlaneOfPieces& plane, const HoleEdge& edge,
                                      std::span<const std::size_t> candidates,
                                      std::span<const char> is_seen, std::size_t start) const {
    if (candidates.size() == 1) return candidates[0];
    const Vec3 back = normalised(place(edge.from) - place(edge.to));
    std::size_t best = start;
    double least = 0;
    for (const std::size_t c : candidates) {
      if (is_seen[c] && c != start) continue;
      const Vec3 way = normalised(place(plane.edges[c].to) - place(edge.to));
      double angle = std::atan2(-dot(cross(back, way), plane.normal), dot(back, way));
      if (angle <= 0) angle += 2 * std::numbers::pi;
      if (least > 0 && angle >= least) continue;
      best = c;
      least = angle;
    }
    return best;
  }

  const Soup& soup_;
  std::vector<PlanePiece> pieces_;
  double reach_;
  Work& work_;
  std::vector<MissingFace> faces_;
};

}  // namespace

std::optional<std::vector<MissingFace>> find_missing_faces(Soup& soup, const ShellMesh& mesh,
                                                           std::span<const PolygonShape> shapes,
                                                           double reach, Work& work) {
  auto rims = find_rims(soup, mesh, shapes);
  if (!rims) return std::nullopt;
  auto pieces = cut_into_plane_pieces(soup, shapes, std::move(*rims), reach, work);
  if (!pieces) return std::nullopt;
  return FaceFinder(soup, std::move(*pieces), reach, work).run();
}

}  // namespace oriel::detail
