#include "kernel/solidify/detail/mend/contacts.h"

#include "kernel/geometry/planar.h"
#include "kernel/solidify/detail/edge_groups.h"
#include "kernel/solidify/detail/mend/box_tree.h"
#include "kernel/solidify/detail/mend/soup_builder.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

using Edge = std::pair<int, int>;

/// Areas that differ by less than this part are the same: points lie beside the plane.
constexpr double kSameArea = 1e-3;

class ContactCutter {
 public:
  ContactCutter(const Soup& soup, const std::vector<PolygonShape>& shapes, double reach)
      : soup_(soup), shapes_(shapes), reach_(reach) {}

  SoupWithContacts run() {
    find_contacts();
    SoupBuilder builder(soup_);
    for (int p = 0; p < soup_.polygon_count(); ++p) {
      const auto found = contacts_.find(p);
      if (found == contacts_.end())
        builder.add_polygon(soup_, p);
      else
        cut(p, found->second, builder);
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
      if (group.size() != 1) return;
      const int own = mesh.polygon_of[at(group[0])];
      const Edge edge =
          std::minmax({soup_.corners[at(group[0])], soup_.corners[at(mesh.next[at(group[0])])]});
      const Vec3 from = place(edge.first), to = place(edge.second);
      tree.search([&](const Box& box) { return comes_near(box, from, to, reach_); },
                  [&](int p) {
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
    return contains_clearly(outlines_of(p), normal, 0.5 * (from + to), reach_);
  }

  [[nodiscard]] std::vector<Outline> outlines_of(int p) const {
    std::vector<Outline> outlines;
    for (const int r : soup_.rings_of(p)) {
      outlines.emplace_back();
      for (const int v : soup_.ring(r)) outlines.back().push_back(place(v));
    }
    return outlines;
  }

  /// Walks the faces that the rings and the edges on them make: every ring edge once, every other
  /// edge both ways.
  void cut(int p, const std::vector<Edge>& edges, SoupBuilder& builder) {
    std::map<int, std::vector<int>> ways;  // by point where they lead
    std::vector<Edge> half_edges;
    const auto add = [&](int from, int to) {
      ways[from].push_back(to);
      half_edges.emplace_back(from, to);
    };
    for (const int r : soup_.rings_of(p)) {
      const auto ring = soup_.ring(r);
      for (std::size_t i = 0; i < ring.size(); ++i) add(ring[i], ring[(i + 1) % ring.size()]);
    }
    for (const auto& [low, high] : edges) {
      add(low, high);
      add(high, low);
    }
    std::vector<std::vector<int>> loops;
    std::set<Edge> walked;
    for (const Edge& start : half_edges) {
      std::vector<int> loop;
      for (Edge e = start; walked.insert(e).second;) {
        loop.push_back(e.first);
        e = {e.second, leftmost(e, ways.at(e.second), shapes_[at(p)].unit)};
      }
      if (loop.size() >= 3) loops.push_back(std::move(loop));
    }
    add_faces(p, loops, builder);
  }

  /// Of the ways on from the end of an edge the first clockwise from where it came from.
  [[nodiscard]] int leftmost(const Edge& edge, const std::vector<int>& ways, Vec3 normal) const {
    const Vec3 back = normalised(place(edge.first) - place(edge.second));
    int best = -1;
    double least = 0;
    for (const int w : ways) {
      const Vec3 way = normalised(place(w) - place(edge.second));
      double angle = std::atan2(-dot(cross(back, way), normal), dot(back, way));
      if (angle <= 0 || w == edge.first) angle += 2 * std::numbers::pi;
      if (best >= 0 && angle >= least) continue;
      best = w;
      least = angle;
    }
    return best;
  }

  void add_faces(int p, const std::vector<std::vector<int>>& loops, SoupBuilder& builder) {
    const Vec3 normal = shapes_[at(p)].unit;
    std::vector<Outline> outlines;
    std::vector<double> areas;
    for (const auto& loop : loops) {
      outlines.emplace_back();
      for (const int v : loop) outlines.back().push_back(place(v));
      areas.push_back(signed_area(outlines.back(), normal));
    }
    // Where edges cross each other the faces do not add up: then the polygon stays whole.
    double sum = 0;
    for (const double area : areas) sum += area;
    const auto faces = std::ranges::count_if(areas, [](double area) { return area > 0; });
    const double whole = shapes_[at(p)].area;
    if (faces <= 1 || std::abs(sum - whole) > kSameArea * whole)
      return builder.add_polygon(soup_, p);
    ++cut_;
    const std::vector<int> face_of = faces_around(loops, outlines, areas, normal);
    for (std::size_t i = 0; i < loops.size(); ++i) {
      if (areas[i] <= 0) continue;
      builder.begin_polygon(soup_.polygons[at(p)]);
      builder.add_ring(loops[i]);
      for (std::size_t j = 0; j < loops.size(); ++j)
        if (face_of[j] == static_cast<int>(i)) builder.add_ring(loops[j]);
    }
  }

  /// For every loop that runs clockwise the smallest face that it is a hole of, -1 for the others.
  [[nodiscard]] static std::vector<int> faces_around(const std::vector<std::vector<int>>& loops,
                                                     const std::vector<Outline>& outlines,
                                                     const std::vector<double>& areas,
                                                     Vec3 normal) {
    std::vector<int> face_of(loops.size(), -1);
    for (std::size_t j = 0; j < loops.size(); ++j) {
      if (areas[j] >= 0) continue;
      for (std::size_t i = 0; i < loops.size(); ++i) {
        const int best = face_of[j];
        if (areas[i] <= 0 || (best >= 0 && areas[at(best)] <= areas[i])) continue;
        const bool is_own_side = std::ranges::find(loops[i], loops[j][0]) != loops[i].end();
        if (!is_own_side && contains({&outlines[i], 1}, normal, outlines[j].front()))
          face_of[j] = static_cast<int>(i);
      }
    }
    return face_of;
  }

  const Soup& soup_;
  const std::vector<PolygonShape>& shapes_;
  double reach_;
  std::map<int, std::vector<Edge>> contacts_;  ///< by polygon
  int cut_ = 0;
};

}  // namespace

SoupWithContacts cut_at_contacts(const Soup& soup, const std::vector<PolygonShape>& shapes,
                                 double reach) {
  return ContactCutter(soup, shapes, reach).run();
}

}  // namespace oriel::detail
