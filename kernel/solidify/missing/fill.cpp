#include "kernel/solidify/missing/fill.h"

#include "kernel/base/index.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/geometry/planar.h"
#include "kernel/solidify/cap_kinds.h"
#include "kernel/solidify/mend/duplicates.h"
#include "kernel/solidify/mend/t_vertices.h"
#include "kernel/solidify/missing/rim_pieces.h"
#include "kernel/solidify/missing/rims.h"
#include "kernel/solidify/soup/polygon_shape.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <span>
#include <utility>

namespace oriel::detail {

namespace {

/// A face that is missing from a surface: its outer ring, then those of its holes, as it would run.
struct MissingFace {
  std::vector<std::vector<int>> rings;
  double area = 0;  ///< grid units squared
  int beside = -1;  ///< a polygon at the same hole
};

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

/// The faces that are missing from a surface with open edges, so that with them no edge is open.
/// Edges of holes that lie in one plane within `reach` (grid units) bound one face or several, with
/// the holes that lie in them: the outline of a missing wall and those of the windows in it. Where
/// faces next to each other are missing their common edge runs straight between its ends
/// (rim_pieces.h); a corner at which nothing is left becomes a new point of the soup. Nothing if
/// what lies in a plane is no set of outlines with holes in them, or once `work` is used up.
std::optional<std::vector<MissingFace>> find_missing_faces(Soup& soup, const ShellMesh& mesh,
                                                           std::span<const PolygonShape> shapes,
                                                           double reach, Work& work) {
  auto rims = find_rims(soup, mesh, shapes);
  if (!rims) return std::nullopt;
  auto pieces = cut_into_plane_pieces(soup, shapes, std::move(*rims), reach, work);
  if (!pieces) return std::nullopt;
  return FaceFinder(soup, std::move(*pieces), reach, work).run();
}

/// A polygon as a plane figure, grid units.
struct Figure {
  std::vector<Outline> outlines;
  std::vector<std::span<const int>> rings;  ///< the points of the outlines
  std::vector<int> points;                  ///< all of them, sorted
  Vec3 normal;
  double level = 0;  ///< of its points along the normal, on average
  Box box;
  bool is_supposed = false;
};

/// Tells whether none of the soup's polygons without source runs through another polygon, or lies
/// on one, by more than `reach` (grid units). False once `work` is used up.
class FitCheck {
 public:
  FitCheck(const Soup& soup, std::span<const PolygonShape> shapes, double reach, Work& work)
      : reach_(reach), work_(work) {
    for (int p = 0; p < soup.polygon_count(); ++p) {
      Figure& figure = figures_.emplace_back();
      figure.normal = shapes[at(p)].unit;
      figure.is_supposed = soup.polygons[at(p)].source == kNoSource;
      figure.outlines = outlines_of(soup, p);
      for (const int r : soup.rings_of(p)) figure.rings.push_back(soup.ring(r));
      const auto corners = soup.corners_of(p);
      figure.points.assign(corners.begin(), corners.end());
      std::ranges::sort(figure.points);
      for (const Outline& outline : figure.outlines)
        for (const Vec3 point : outline) {
          figure.box.grow(point);
          figure.level += dot(figure.normal, point) / static_cast<double>(corners.size());
        }
    }
  }

  [[nodiscard]] bool run() const {
    std::vector<Box> boxes;
    for (const Figure& figure : figures_) boxes.push_back(figure.box);
    const BoxTree tree(std::move(boxes));
    bool fits = true;
    for (const Figure& figure : figures_) {
      if (!figure.is_supposed) continue;
      tree.for_each_overlap(figure.box, [&](int i) {
        const Figure& other = figures_[at(i)];
        work_.add(std::ssize(figure.points) + std::ssize(other.points));
        fits = fits && !work_.is_used_up() && (&other == &figure || !meet(figure, other));
      });
    }
    return fits;
  }

 private:
  [[nodiscard]] bool meet(const Figure& p, const Figure& q) const {
    return runs_through(p, q) || runs_through(q, p) || lies_on(p, q) || lies_on(q, p);
  }

  [[nodiscard]] double height(const Figure& figure, Vec3 point) const {
    return dot(figure.normal, point) - figure.level;
  }

  /// An edge of the one passes the inside of the other. One that begins or ends at a corner of the
  /// other is through its plane there.
  [[nodiscard]] bool runs_through(const Figure& one, const Figure& other) const {
    for (std::size_t r = 0; r < one.rings.size(); ++r)
      for (std::size_t i = 0; i < one.rings[r].size(); ++i) {
        const std::size_t j = (i + 1) % one.rings[r].size();
        if (has_corner(other, one.rings[r][i]) || has_corner(other, one.rings[r][j])) continue;
        const Vec3 from = one.outlines[r][i], to = one.outlines[r][j];
        const double before = height(other, from), after = height(other, to);
        if (std::min(before, after) >= -reach_ || std::max(before, after) <= reach_) continue;
        const Vec3 point = from + before / (before - after) * (to - from);
        if (contains_clearly(other.outlines, other.normal, point, reach_)) return true;
      }
    return false;
  }

  static bool has_corner(const Figure& figure, int point) {
    return std::ranges::binary_search(figure.points, point);
  }

  [[nodiscard]] bool lies_on(const Figure& one, const Figure& other) const {
    const auto inside = interior_point(one.outlines, one.normal);
    return inside && std::abs(height(other, *inside)) <= reach_ &&
           is_parallel(one.normal, other.normal) &&
           contains_clearly(other.outlines, other.normal, *inside, reach_);
  }

  /// To 5°: less is what faces that go on after each other differ by.
  static bool is_parallel(Vec3 p, Vec3 q) { return std::abs(dot(p, q)) > 0.996; }

  double reach_;
  Work& work_;
  std::vector<Figure> figures_;
};

/// The polygons as they meet each other: each once, with the vertices that lie on their edges.
Soup joined(const Soup& soup, double weld, RepairReport& report) {
  auto [whole, inserted] = insert_t_vertices(without_duplicates(soup, report.duplicates), weld);
  report.t_vertices = inserted;
  return std::move(whole);
}

Cap missing_cap(const Soup& soup, const MissingFace& face, const CapKinds& kinds) {
  Cap cap{face.area * soup.grid_m * soup.grid_m, {}, kinds.kind_of(face.rings)};
  for (const int v : face.rings[0])
    cap.centre = cap.centre + exact::to_metres(soup.points[at(v)], soup.grid_m);
  cap.centre = 1.0 / static_cast<double>(face.rings[0].size()) * cap.centre;
  return cap;
}

}  // namespace

std::optional<FilledShell> fill_missing_faces(const Soup& welded, const std::string& building,
                                              const Tolerances& tolerances, Work& work) {
  FilledShell filled;
  filled.report.was_needed = true;
  Soup soup = joined(welded, tolerances.weld_m / welded.grid_m, filled.report);
  ShellMesh mesh = build_shell_mesh(soup, building, filled.issues);
  if (has_errors(filled.issues)) return std::nullopt;
  const double reach = tolerances.plane_offset_m / soup.grid_m;
  auto faces = find_missing_faces(soup, mesh, shapes_of(soup), reach, work);
  if (!faces) return std::nullopt;
  std::vector<AddedFace> added;
  for (const MissingFace& face : *faces) added.push_back({face.rings, face.beside});
  const auto shapes = shapes_of(soup);
  const CapKinds kinds(soup, shapes, added, reach, work);
  for (const MissingFace& face : *faces)
    filled.report.caps.push_back(missing_cap(soup, face, kinds));
  filled.soup = with_faces(soup, std::move(added));
  if (!FitCheck(filled.soup, shapes_of(filled.soup), reach, work).run()) return std::nullopt;
  filled.mesh = build_shell_mesh(filled.soup, building, filled.issues);
  if (has_errors(filled.issues) ||
      std::ranges::find(filled.mesh.twin, -1) != filled.mesh.twin.end())
    return std::nullopt;
  return filled;
}

}  // namespace oriel::detail
