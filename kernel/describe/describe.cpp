#include "kernel/describe/describe.h"

#include "kernel/base/index.h"
#include "kernel/describe/features/facades.h"
#include "kernel/describe/features/parallel_polygons.h"
#include "kernel/describe/features/relations.h"
#include "kernel/describe/features/shape.h"
#include "kernel/describe/features/site.h"
#include "kernel/geometry/directions.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"
#include "model/building.h"
#include "model/description/feature_table.h"
#include "model/segmentation.h"
#include "model/tolerances.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// 64-bit FNV-1a, gone on with from the hash of what stands before.
constexpr std::uint64_t kHashOfNothing = 0xcbf29ce484222325ULL;
std::uint64_t hash_on(std::uint64_t hash, std::string_view text) {
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

/// A hash in 13 characters of base 32.
std::string written(std::uint64_t hash) {
  std::array<char, 14> digits{'f'};
  for (std::size_t i = 1; i < digits.size(); ++i, hash /= 32)
    digits[i] = "0123456789abcdefghjkmnpqrstvwxyz"[hash % 32];
  return {digits.data(), digits.size()};
}

/// The hash gone on with by "|" and the millimetres of each.
std::uint64_t hash_on_millimetres(std::uint64_t hash, std::initializer_list<double> metres) {
  for (const double m : metres) {
    std::array<char, 24> text{'|'};
    const auto end =
        std::to_chars(text.data() + 1, text.data() + text.size(), std::llround(m * 1000)).ptr;
    hash = hash_on(hash, {text.data(), end});
  }
  return hash;
}

/// Sets the ids of all features: 64 bits of what they are, which do not depend on the order of the
/// input.
void name_features(FeatureTable& table, const Building& building,
                   const Segmentation& segmentation) {
  std::unordered_map<std::uint64_t, int> uses;  // by hash
  uses.reserve(segmentation.features.size());
  const std::uint64_t start =
      hash_on(kHashOfNothing, fmt::format("{}|{}|", building.id, building.lod));
  for (std::size_t i = 0; i < segmentation.features.size(); ++i) {
    const Feature& f = segmentation.features[i];
    const Box box = f.box.moved(building.frame.origin_m);
    std::uint64_t hash =
        hash_on_millimetres(hash_on(start, to_string(f.sense)),
                            {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z});
    if (!f.planes.empty()) {
      const Vec3 n = segmentation.planes[f.planes.front().index()].normal;
      hash = hash_on_millimetres(hash, {n.x, n.y, n.z});
    }
    // Features that agree in all this (parts of one box) are told apart by their order.
    const int use = uses[hash]++;
    if (use > 0) hash = hash_on(hash, fmt::format("|{}", use));
    table.set_id(FeatureId{static_cast<int>(i)}, written(hash));
  }
}

}  // namespace

}  // namespace oriel::detail

namespace oriel {

namespace {

using detail::Extent;
using detail::InFacade;

/// A feature with what several attributes need of it.
struct DescribedFeature {
  FeatureId id;
  const Feature* feature;
  std::vector<Vec3> points;
  detail::StandingBox box;
  std::optional<Vec3> normal;  ///< of the largest cap, outward from the rest; missing for cavities
  Vec3 across{1, 0, 0};        ///< horizontal along the host's facet
  Extent width = {};           ///< along `across`
};

/// Horizontal in the plane of the cap; for a level cap, along the longer side of the standing box.
Vec3 direction_across(Vec3 normal, const detail::StandingBox& box) {
  const Vec3 across = cross({0, 0, 1}, normal);
  constexpr double kLevel =
      1e-6;  // tolerance of doubles: below it the cap has no horizontal direction of its own
  return length(across) > kLevel ? normalised(across) : box.along;
}

DescribedFeature subject_of(const Segmentation& segmentation, FeatureId id) {
  const Feature& feature = segmentation.features[id.index()];
  DescribedFeature subject{
      id, &feature, detail::points_of(segmentation, feature), {}, std::nullopt};
  subject.box = detail::standing_box(subject.points);
  if (!feature.planes.empty()) {
    subject.normal = segmentation.planes[feature.planes.front().index()].normal;
    subject.across = direction_across(*subject.normal, subject.box);
  }
  subject.width = detail::extent_along(subject.points, subject.across);
  return subject;
}

void describe_cut(FeatureTable& table, const DescribedFeature& s) {
  const Feature& f = *s.feature;
  table.set(s.id, Attribute::sense, to_string(f.sense));
  table.set(s.id, Attribute::natural, f.is_natural ? 1.0 : 0.0);
  if (f.value) table.set(s.id, Attribute::value, *f.value);
  if (f.quality) table.set(s.id, Attribute::quality, *f.quality);
  table.set(s.id, Attribute::new_area, f.new_area_m2);
  const bool has_cut = f.sense != Sense::imprint && !f.is_uncut;
  if (has_cut) table.set(s.id, Attribute::old_area, f.old_area_m2);
  if (!f.is_uncut || f.sense == Sense::imprint) table.set(s.id, Attribute::volume, f.volume_m3);
  table.set(s.id, Attribute::surface, f.surface_m2);
  table.set(s.id, Attribute::split_order, has_cut ? static_cast<double>(f.planes.size()) : 0);
}

/// What points of one plane are apart in doubles is nothing: an imprint has no depth.
double without_dust(double extent_m) {
  constexpr double kDust_m = 1e-9;  // tolerance of doubles
  return extent_m < kDust_m ? 0 : extent_m;
}

/// True for a cap that faces nowhere.
bool is_level(double inclination_deg) {
  constexpr double kLevel_deg = 0.5;  // as coplanar_deg
  return inclination_deg < kLevel_deg || inclination_deg > 180 - kLevel_deg;
}

void describe_size(FeatureTable& table, const DescribedFeature& s) {
  const auto [a, b, c] = s.box.edges();
  table.set(s.id, Attribute::a, a);
  table.set(s.id, Attribute::b, b);
  table.set(s.id, Attribute::c, without_dust(c));
  table.set(s.id, Attribute::silhouette, a * b);
  table.set(s.id, Attribute::width, s.width.size());
  table.set(s.id, Attribute::height, s.box.height);
  if (!s.normal) return;
  table.set(s.id, Attribute::depth, without_dust(detail::extent_along(s.points, *s.normal).size()));
  const double inclination = inclination_deg(*s.normal);
  table.set(s.id, Attribute::inclination, inclination);
  if (is_level(inclination)) return;
  table.set(s.id, Attribute::azimuth, azimuth_deg(*s.normal));
}

/// How far cells reach, each direction of a cell measured once.
class CellReaches {
 public:
  explicit CellReaches(const Segmentation& segmentation)
      : segmentation_(segmentation), points_(segmentation.cells.size()) {}

  [[nodiscard]] double reach(CellId cell, Vec3 direction) {
    const auto [entry, is_new] =
        known_.try_emplace({cell, direction.x, direction.y, direction.z}, 0.0);
    if (is_new) {
      auto& points = points_[cell.index()];
      if (points.empty())
        points = detail::points_of(segmentation_, segmentation_.cells[cell.index()]);
      entry->second = detail::extent_along(points, direction).high;
    }
    return entry->second;
  }

 private:
  const Segmentation& segmentation_;
  std::vector<std::vector<Vec3>> points_;
  std::map<std::tuple<CellId, double, double, double>, double> known_;
};

/// How far the feature sticks out of the box of the cell it sits on: the paper's difference of
/// bounding boxes.
void describe_growth(FeatureTable& table, const DescribedFeature& s, CellReaches& reaches) {
  if (!s.feature->host_facet) return;
  const CellId host = s.feature->host_facet->cell;
  const auto beyond = [&](Vec3 direction) {
    return std::max(
        0.0, detail::extent_along(s.points, direction).high - reaches.reach(host, direction));
  };
  table.set(s.id, Attribute::growth_up, beyond({0, 0, 1}));
  table.set(s.id, Attribute::growth_down, beyond({0, 0, -1}));
  table.set(s.id, Attribute::growth_out, beyond(*s.normal));
  double side = std::max(beyond(s.across), beyond(-s.across));
  // Along a wall's other direction, up and down, the two columns above say it.
  const Vec3 slope = cross(*s.normal, s.across);
  if (std::abs(s.normal->z) > kWallLean) side = std::max({side, beyond(slope), beyond(-slope)});
  table.set(s.id, Attribute::growth_side, side);
}

void describe_recess(FeatureTable& table, const DescribedFeature& s,
                     const Segmentation& segmentation, const detail::ParallelPolygons& polygons) {
  if (!s.normal) return;
  const Plane& plane = segmentation.planes[s.feature->planes.front().index()];
  if (const auto level_m = polygons.level_in(*s.feature, plane))
    table.set(s.id, Attribute::recess, -*level_m);
}

/// How far a feature reaches along a direction.
Extent extent_of(const Segmentation& segmentation, const Feature& feature, Vec3 direction) {
  Extent extent;
  for (const int v : feature.vertices) {
    const double along = dot(segmentation.vertices[at(v)].point, direction);
    extent.low = std::min(extent.low, along);
    extent.high = std::max(extent.high, along);
  }
  return extent;
}

/// Where the ground is looked for: below the middle of the cap, a little inside the body.
Vec3 foot_of(const Segmentation& segmentation, const Feature& feature) {
  const Vec3 middle = 0.5 * (feature.box.min + feature.box.max);
  if (feature.planes.empty()) return middle;
  constexpr double kInside_m = 0.01;  // off the wall's own plane, so that the facet below it is met
  const Vec3 normal = segmentation.planes[feature.planes.front().index()].normal;
  const Extent out = extent_of(segmentation, feature, normal);
  // The cap is the inner end of a protrusion and the outer end of a hole.
  double cap = feature.sense == Sense::hole ? out.high : out.low;
  if (feature.sense == Sense::imprint) cap = dot(feature.cap_point, normal);
  return middle + (cap - dot(middle, normal) - kInside_m) * normal;
}

/// The ground at the foot of a feature. Where that is the underside of a part that itself hangs in
/// the air (a window of a bay), the ground at the foot of that part, if it is lower.
detail::Foot ground_of(const DescribedFeature& s, const Segmentation& segmentation,
                       const detail::Site& site) {
  detail::Foot foot = site.ground_at(foot_of(segmentation, *s.feature), s.feature->host_facet);
  CellId cell = foot.cell;
  for (std::size_t steps = 0; cell.is_valid() && steps < segmentation.cells.size(); ++steps) {
    const FeatureId carrier = segmentation.cells[cell.index()].feature;
    if (!carrier.is_valid() || carrier == s.id) break;
    const Feature& carrying = segmentation.features[carrier.index()];
    const detail::Foot below = site.ground_at(foot_of(segmentation, carrying), carrying.host_facet);
    if (below.ground_m >= foot.ground_m) break;
    foot = below;
    cell = below.cell;
  }
  return foot;
}

void describe_place(FeatureTable& table, const DescribedFeature& s,
                    const Segmentation& segmentation, const detail::Site& site) {
  const Box& box = s.feature->box;
  const auto& facet = s.feature->host_facet;
  const detail::Foot foot = ground_of(s, segmentation, site);
  table.set(s.id, Attribute::base_height, box.min.z - foot.ground_m);
  table.set(s.id, Attribute::top, box.max.z - foot.ground_m);
  table.set(s.id, Attribute::ground_source, foot.source);
  table.set(s.id, Attribute::below_ridge, site.ridge_m() - box.max.z);
  if (!facet) return;
  const Cell& cell = segmentation.cells[facet->cell.index()];
  const Vec3 normal = segmentation.planes[cell.facets[at(facet->facet)].plane.index()].normal;
  // The facets of a void look away from it, into the building.
  table.set(s.id, Attribute::host_inclination, inclination_deg(cell.sign * normal));
  if (const auto eaves = site.eaves_m(facet->cell))
    table.set(s.id, Attribute::above_eaves, box.min.z - *eaves);
}

/// The smallest distance of the cap's corners to the outline of the host's facet.
void describe_edge_gap(FeatureTable& table, const DescribedFeature& s, const Plane& plane,
                       const Outline& outline, Work& work) {
  constexpr double kOnPlane_m =
      1e-6;  // tolerance of doubles: the corners of the cap lie on its plane
  double gap = Box::kInfinity;
  for (const Vec3 p : s.points) {
    if (std::abs(dot(plane.normal, p) - plane.offset_m) > kOnPlane_m) continue;
    work.add(std::ssize(outline));
    if (work.is_used_up()) return;
    for (std::size_t i = 0; i < outline.size(); ++i)
      gap = std::min(gap, distance_to_segment(p, outline[i], outline[(i + 1) % outline.size()]));
  }
  if (gap < Box::kInfinity) table.set(s.id, Attribute::edge_gap, gap);
}

/// Where it lies within the outline of the host's facet, and along its facade.
void describe_place_in_facet(FeatureTable& table, const DescribedFeature& s,
                             const Segmentation& segmentation, detail::Facades& facades,
                             Work& work) {
  if (!s.feature->host_facet) return;
  const Plane& plane = segmentation.planes[s.feature->planes.front().index()];
  const auto outline = detail::facet_outlines(segmentation, *s.feature->host_facet).front();
  describe_edge_gap(table, s, plane, outline, work);
  if (is_level(inclination_deg(*s.normal))) return;
  const CellFacet host = *s.feature->host_facet;
  const CellFacet facade = *facades.of(*s.feature);
  const bool is_host = facade.cell == host.cell && facade.facet == host.facet;
  const double left =
      detail::extent_along(is_host ? outline : detail::facet_outlines(segmentation, facade).front(),
                           s.across)
          .low;
  table.set(s.id, Attribute::along, s.width.middle() - left);
}

void count_companions(FeatureTable& table, const std::vector<DescribedFeature>& subjects,
                      const std::vector<int>& group_of, Attribute attribute) {
  std::map<std::pair<int, Sense>, int> counts;
  const auto kind = [&](std::size_t i) {
    return std::pair(group_of[i], detail::kind_of(subjects[i].feature->sense));
  };
  for (std::size_t i = 0; i < subjects.size(); ++i)
    if (group_of[i] >= 0) ++counts[kind(i)];
  for (std::size_t i = 0; i < subjects.size(); ++i)
    if (group_of[i] >= 0) table.set(subjects[i].id, attribute, counts[kind(i)]);
}

InFacade in_facade(const DescribedFeature& s, int facade) {
  const auto [a, b, c] = s.box.edges();
  return {facade,  detail::kind_of(s.feature->sense),
          s.width, detail::extent_along(s.points, {0, 0, 1}),
          a,       b};
}

/// A hole or an imprint in a steep facet.
bool is_opening(const DescribedFeature& s) {
  return detail::kind_of(s.feature->sense) == Sense::hole && s.normal &&
         std::abs(s.normal->z) < kSteepNormal;
}

/// "2.2"; nothing if the level of detail is no number.
std::optional<double> level_of_detail(const Building& building) {
  const std::string& text = building.lod;
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// What takes its time and is left out if nobody asks for it.
struct Asked {
  explicit Asked(const DescribeOptions& options) {
    const auto is_asked = [&](Attribute attribute) {
      return options.attributes.empty() || options.attributes.at(column_of(attribute));
    };
    recess = is_asked(Attribute::recess);
    growth = is_asked(Attribute::growth_up) || is_asked(Attribute::growth_down) ||
             is_asked(Attribute::growth_out) || is_asked(Attribute::growth_side);
    place_in_facet = is_asked(Attribute::edge_gap) || is_asked(Attribute::along);
    companions = is_asked(Attribute::per_facade) || is_asked(Attribute::per_storey);
    const auto leads = [&](const char* relation) {
      const auto found = std::ranges::find(relation_schema(), relation, &RelationKind::name);
      return options.relations.empty() ||
             options.relations.at(static_cast<std::size_t>(found - relation_schema().begin()));
    };
    neighbours = {leads("alike"), leads("beside"), leads("above")};
  }

  bool recess, growth, place_in_facet, companions;
  detail::AskedRelations neighbours;
};

}  // namespace

Description describe(const Building& building, const Segmentation& segmentation,
                     const DescribeOptions& options) {
  Description out{FeatureTable(building.id, segmentation.features.size()), {}};
  Work work(options.budget);
  const Asked asked(options);
  const detail::Site site(segmentation);
  std::optional<detail::ParallelPolygons> polygons;
  if (asked.recess) polygons.emplace(building, segmentation.grid_m);
  CellReaches reaches(segmentation);
  detail::Facades walls(segmentation, work);
  const std::vector<int> facades = walls.numbers();
  std::vector<DescribedFeature> subjects;
  std::vector<InFacade> placed;
  std::vector<char> openings;
  const auto lod = level_of_detail(building);
  subjects.reserve(segmentation.features.size());
  placed.reserve(segmentation.features.size());
  openings.reserve(segmentation.features.size());
  for (std::size_t i = 0; i < segmentation.features.size(); ++i) {
    subjects.push_back(subject_of(segmentation, FeatureId{static_cast<int>(i)}));
    const DescribedFeature& s = subjects.back();
    describe_cut(out.table, s);
    describe_size(out.table, s);
    if (lod) out.table.set(s.id, Attribute::lod, *lod);
    if (polygons) describe_recess(out.table, s, segmentation, *polygons);
    if (asked.growth) describe_growth(out.table, s, reaches);
    describe_place(out.table, s, segmentation, site);
    if (asked.place_in_facet) describe_place_in_facet(out.table, s, segmentation, walls, work);
    placed.push_back(in_facade(s, facades[i]));
    openings.push_back(is_opening(s) ? 1 : 0);
  }
  const std::vector<int> storeys = detail::storeys_of(placed, openings);
  for (std::size_t i = 0; i < subjects.size(); ++i)
    if (storeys[i] >= 0) out.table.set(subjects[i].id, Attribute::storey, storeys[i]);
  if (asked.companions) {
    count_companions(out.table, subjects, facades, Attribute::per_facade);
    count_companions(out.table, subjects, storeys, Attribute::per_storey);
  }
  detail::name_features(out.table, building, segmentation);
  out.graph = detail::relate(segmentation, placed, storeys, asked.neighbours, work);
  if (work.is_used_up())
    out.issues.push_back(used_up(building.id, options.budget, "describing",
                                 "relations and places of features may be missing"));
  return out;
}

}  // namespace oriel
