#include "kernel/solidify/open_shell.h"

#include "kernel/base/index.h"
#include "kernel/solidify/planes/plane_clusters.h"
#include "kernel/solidify/shells/open_mesh.h"
#include "kernel/solidify/soup/soup.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace oriel {

namespace {

using detail::ShellMesh;
using detail::Soup;

bool has_room(const Building& building, const Tolerances& tolerances) {
  const double limit =
      static_cast<double>(exact::kMaxCoordinate) * detail::grid_for(tolerances.weld_m);
  return std::ranges::all_of(building.vertices, [&](Vec3 p) {
    return std::abs(p.x) <= limit && std::abs(p.y) <= limit && std::abs(p.z) <= limit;
  });
}

class FacetMaker {
 public:
  FacetMaker(const Soup& soup, const ShellMesh& mesh, const detail::PlaneClusters& clusters)
      : soup_(soup),
        mesh_(mesh),
        clusters_(clusters),
        facet_of_(soup.polygons.size(), -1),
        half_edges_of_(soup.polygons.size()) {}

  Solid run() {
    out_.grid_m = soup_.grid_m;
    out_.planes = clusters_.planes;
    for (const auto& p : soup_.points)
      out_.vertices.push_back({exact::to_metres(p, soup_.grid_m), false});
    for (int h = 0; h < std::ssize(mesh_.next); ++h)
      half_edges_of_[at(mesh_.polygon_of[at(h)])].push_back(h);
    is_walked_.assign(mesh_.next.size(), 0);
    for (int p = 0; p < soup_.polygon_count(); ++p)
      if (facet_of_[at(p)] < 0) grow(p);
    return std::move(out_);
  }

 private:
  /// The facet of all polygons that hang together with this one in its plane.
  void grow(int seed) {
    const int number = next_number_++;
    Facet facet{PlaneId{clusters_.plane_of[at(seed)]}, {}, {}};
    std::vector<int> members{seed};
    facet_of_[at(seed)] = number;
    for (std::size_t i = 0; i < members.size(); ++i)
      for (const int h : half_edges_of_[at(members[i])]) {
        const int twin = mesh_.twin[at(h)];
        if (twin < 0) continue;
        const int other = mesh_.polygon_of[at(twin)];
        if (facet_of_[at(other)] >= 0 ||
            clusters_.plane_of[at(other)] != clusters_.plane_of[at(seed)])
          continue;
        facet_of_[at(other)] = number;
        members.push_back(other);
      }
    for (const int p : members) facet.polygons.push_back(soup_.polygons[at(p)].source);
    std::ranges::sort(facet.polygons);
    std::ranges::sort(members);
    for (const int p : members)
      for (const int h : half_edges_of_[at(p)])
        if (!is_walked_[at(h)] && !is_inside(h)) facet.loops.push_back(walk(h));
    if (facet.loops.empty()) return;  // both sides of one sheet: they bound nothing
    put_outer_first(facet);
    out_.facets.push_back(std::move(facet));
  }

  /// Both sides of the edge are in one facet.
  [[nodiscard]] bool is_inside(int h) const {
    const int twin = mesh_.twin[at(h)];
    return twin >= 0 &&
           facet_of_[at(mesh_.polygon_of[at(h)])] == facet_of_[at(mesh_.polygon_of[at(twin)])];
  }

  Loop walk(int start) {
    Loop loop;
    for (int h = start; !is_walked_[at(h)];) {
      is_walked_[at(h)] = 1;
      loop.push_back(soup_.corners[at(h)]);
      h = mesh_.next[at(h)];
      while (is_inside(h)) h = mesh_.next[at(mesh_.twin[at(h)])];
    }
    return loop;
  }

  void put_outer_first(Facet& facet) const {
    const Vec3 normal = out_.planes[facet.plane.index()].normal;
    const auto outer = std::ranges::max_element(facet.loops, {}, [&](const Loop& loop) {
      return signed_area_m2(out_.vertices, loop, normal);
    });
    std::iter_swap(facet.loops.begin(), outer);
  }

  const Soup& soup_;
  const ShellMesh& mesh_;
  const detail::PlaneClusters& clusters_;
  std::vector<int> facet_of_;
  std::vector<std::vector<int>> half_edges_of_;
  std::vector<char> is_walked_;
  int next_number_ = 0;  ///< of a facet in facet_of_
  Solid out_;
};

}  // namespace

std::optional<Solid> open_shell(const Building& building, const Tolerances& tolerances) {
  if (!has_room(building, tolerances)) return std::nullopt;
  std::vector<Issue> of_solidify;  // it has told them
  Soup soup = detail::weld(building, tolerances, of_solidify);
  if (soup.polygons.empty()) return std::nullopt;
  const ShellMesh mesh = detail::build_open_mesh(soup);
  const detail::PlaneClusters clusters = detail::cluster_planes(soup, mesh, tolerances);
  Solid shell = FacetMaker(soup, mesh, clusters).run();
  if (shell.facets.empty()) return std::nullopt;
  return shell;
}

}  // namespace oriel
