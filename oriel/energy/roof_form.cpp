#include "oriel/energy/roof_form.h"

#include "kernel/base/index.h"
#include "kernel/geometry/directions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace oriel {

namespace {

/// A roof that rises less is flat: tiles need more, so that it is covered by membranes.
constexpr double kFlat_deg = 10;
/// Faces of less than this share of the roof (dormers, bays) do not make its form, and a form holds
/// if the others are no more than that together.
constexpr double kLeastShare = 0.1;
/// Faces slope the same way within this.
constexpr double kSameWay_deg = 15;
/// Two slopes one over the other make a mansard from this difference on.
constexpr double kBreak_deg = 15;

struct RoofFace {
  FacetId facet;
  double area_m2 = 0;
  double slope_deg = 0;
  double azimuth_deg = 0;
};

/// Between two directions, 0 to 180.
double turn_deg(double a, double b) {
  const double turn = std::abs(a - b);
  return std::min(turn, 360 - turn);
}

/// Faces that slope one way.
struct SlopeWay {
  double azimuth_deg = 0;
  double area_m2 = 0;
  double least_deg = 90, most_deg = 0;
};

/// The largest faces first.
std::vector<SlopeWay> ways_of(const std::vector<RoofFace>& faces) {
  std::vector<SlopeWay> ways;
  for (const RoofFace& face : faces) {
    auto way = std::ranges::find_if(ways, [&](const SlopeWay& known) {
      return turn_deg(known.azimuth_deg, face.azimuth_deg) <= kSameWay_deg;
    });
    if (way == ways.end()) way = ways.insert(ways.end(), {face.azimuth_deg});
    way->area_m2 += face.area_m2;
    way->least_deg = std::min(way->least_deg, face.slope_deg);
    way->most_deg = std::max(way->most_deg, face.slope_deg);
  }
  return ways;
}

bool are_opposite(const SlopeWay& a, const SlopeWay& b) {
  return turn_deg(a.azimuth_deg, b.azimuth_deg) >= 180 - kSameWay_deg;
}

/// Two faces that slope different ways meet in a valley.
bool has_valley(const Solid& solid, const std::vector<RoofFace>& faces) {
  std::map<std::pair<int, int>, FacetId> face_of_edge;
  for (const RoofFace& face : faces)
    for (const Loop& loop : solid.facets[face.facet.index()].loops)
      for (std::size_t i = 0; i < loop.size(); ++i)
        face_of_edge[{loop[i], loop[(i + 1) % loop.size()]}] = face.facet;
  for (const auto& [edge, facet] : face_of_edge) {
    const auto other = face_of_edge.find({edge.second, edge.first});
    if (other == face_of_edge.end() || other->second < facet) continue;
    const Vec3 a = solid.planes[solid.facets[facet.index()].plane.index()].normal;
    const Vec3 b = solid.planes[solid.facets[other->second.index()].plane.index()].normal;
    const Vec3 along = solid.vertices[at(edge.second)].point - solid.vertices[at(edge.first)].point;
    // The interior of a facet is to the left of its edges.
    if (dot(cross(a, b), along) < 0 && dot(a, b) < std::cos(kSameWay_deg * detail::kDegree_rad))
      return true;
  }
  return false;
}

bool are_triangles(const Solid& solid, const std::vector<RoofFace>& faces) {
  return std::ranges::all_of(faces, [&](const RoofFace& face) {
    const auto& loops = solid.facets[face.facet.index()].loops;
    return loops.size() == 1 && loops[0].size() == 3;
  });
}

/// Of faces none of which is flat.
RoofForm form_of_slopes(const Solid& solid, const std::vector<RoofFace>& faces) {
  const std::vector<SlopeWay> ways = ways_of(faces);
  if (ways.size() == 1) return RoofForm::shed;
  const bool is_paired = std::ranges::all_of(ways, [&](const SlopeWay& way) {
    return std::ranges::any_of(ways,
                               [&](const SlopeWay& other) { return are_opposite(way, other); });
  });
  if (!is_paired || ways.size() > 4 || ways.size() == 3) return RoofForm::other;
  if (has_valley(solid, faces)) return RoofForm::other;
  const bool is_broken = std::ranges::all_of(
      ways, [](const SlopeWay& way) { return way.most_deg - way.least_deg >= kBreak_deg; });
  if (is_broken) return RoofForm::mansard;
  if (ways.size() == 2) return RoofForm::gabled;
  return are_triangles(solid, faces) ? RoofForm::pyramidal : RoofForm::hipped;
}

}  // namespace

RoofForm roof_form_of(const Solid& solid, const std::vector<FacetId>& roof) {
  std::vector<RoofFace> faces;
  double all_m2 = 0, flat_m2 = 0;
  for (const FacetId id : roof) {
    const Facet& facet = solid.facets[id.index()];
    const Vec3 normal = solid.planes[facet.plane.index()].normal;
    RoofFace face{id, area_m2(solid.vertices, facet, normal)};
    face.slope_deg = detail::inclination_deg(normal);
    face.azimuth_deg = detail::azimuth_deg(normal);
    all_m2 += face.area_m2;
    if (face.slope_deg <= kFlat_deg)
      flat_m2 += face.area_m2;
    else
      faces.push_back(face);
  }
  if (all_m2 <= 0) return RoofForm::none;
  if (flat_m2 >= (1 - kLeastShare) * all_m2) return RoofForm::flat;
  if (flat_m2 > kLeastShare * all_m2) return RoofForm::other;
  double small_m2 = 0;
  std::erase_if(faces, [&](const RoofFace& face) {
    const bool is_small = face.area_m2 < kLeastShare / 2 * all_m2;
    if (is_small) small_m2 += face.area_m2;
    return is_small;
  });
  if (faces.empty() || small_m2 > 2 * kLeastShare * all_m2) return RoofForm::other;
  std::ranges::sort(faces, [](const RoofFace& a, const RoofFace& b) {
    return std::pair(-a.area_m2, a.facet) < std::pair(-b.area_m2, b.facet);
  });
  return form_of_slopes(solid, faces);
}

std::string_view to_string(RoofForm form) {
  constexpr std::array<std::string_view, 8> kNames{"",       "flat",      "shed",    "gabled",
                                                   "hipped", "pyramidal", "mansard", "other"};
  return kNames.at(static_cast<std::size_t>(form));
}

}  // namespace oriel
