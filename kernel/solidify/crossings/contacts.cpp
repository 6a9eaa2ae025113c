#include "kernel/solidify/crossings/contacts.h"

#include "kernel/base/index.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/geometry/planar.h"
#include "kernel/solidify/crossings/faces.h"
#include "kernel/solidify/shells/edge_groups.h"

#include <algorithm>
#include <map>
#include <utility>

namespace oriel::detail {

namespace {

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
      if (group.size() != 1) return;
      const int own = mesh.polygon_of[at(group[0])];
      const PointPair edge =
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
    return contains_clearly(outlines_of(soup_, p), normal, 0.5 * (from + to), reach_);
  }

  const Soup& soup_;
  const std::vector<PolygonShape>& shapes_;
  double reach_;
  std::map<int, std::vector<PointPair>> contacts_;  ///< by polygon
  int cut_ = 0;
};

}  // namespace

SoupWithContacts cut_at_contacts(const Soup& soup, const std::vector<PolygonShape>& shapes,
                                 double reach) {
  return ContactCutter(soup, shapes, reach).run();
}

}  // namespace oriel::detail
