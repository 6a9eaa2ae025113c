#include "generalise/generalise.h"
#include "interpret/surfaces/label_classes.h"
#include "interpret/surfaces/surfaces.h"
#include "kernel/base/index.h"
#include "kernel/base/text/printable.h"
#include "kernel/base/text/suggest.h"
#include "kernel/describe/surfaces.h"
#include "kernel/geometry/directions.h"
#include "kernel/geometry/outlines.h"
#include "model/solid.h"
#include "oriel/drawing/targets.h"
#include "oriel/energy.h"
#include "oriel/options.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

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
    if (dot(cross(a, b), along) < 0 && dot(a, b) < std::cos(kSameWay_deg * kDegree_rad))
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

/// The form of the roof that these facets of a solid are: docs/energy.md#roof-form.
RoofForm roof_form_of(const Solid& solid, const std::vector<FacetId>& roof) {
  std::vector<RoofFace> faces;
  double all_m2 = 0, flat_m2 = 0;
  for (const FacetId id : roof) {
    const Facet& facet = solid.facets[id.index()];
    const Vec3 normal = solid.planes[facet.plane.index()].normal;
    RoofFace face{id, area_m2(solid.vertices, facet, normal)};
    face.slope_deg = inclination_deg(normal);
    face.azimuth_deg = azimuth_deg(normal);
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

/// Within this of level a normal has no azimuth, as in the tables of features and surfaces.
constexpr double kLevel_deg = 1;
/// An opening lies in a face whose plane is no further off and no more turned than this; planes of
/// the body that is left are those of the building, but for what a cut rounds.
constexpr double kInPlane_m = 0.02;
constexpr double kInPlane_cos = 0.9998;

/// Storeys are 2.4 m high at the least, rooms of 2.2 m under a slab; sills vary within a storey.
constexpr double kLeastStorey_m = 2.2;

std::optional<double> azimuth_of(Vec3 normal) {
  const double inclination = inclination_deg(normal);
  if (std::min(inclination, 180 - inclination) <= kLevel_deg) return std::nullopt;
  return azimuth_deg(normal);
}

/// One without a name of its own is told by its slope.
EnvelopeKind kind_of(const std::string& type, Vec3 normal) {
  if (type == "WallSurface") return EnvelopeKind::wall;
  if (type == "RoofSurface") return EnvelopeKind::roof;
  if (type == "GroundSurface") return EnvelopeKind::ground;
  if (type == "OuterCeilingSurface") return EnvelopeKind::ceiling;
  if (type == "OuterFloorSurface") return EnvelopeKind::floor;
  if (looks_up(normal)) return EnvelopeKind::roof;
  return looks_down(normal) ? EnvelopeKind::ceiling : EnvelopeKind::wall;
}

/// Builds the envelope of one building that has a body.
class EnvelopeSurvey {
 public:
  EnvelopeSurvey(const PipelineResult& result, const RuleBase& rules, const EnergyOptions& energy)
      : result_(result), segmentation_(*result.segmentation), rules_(rules), energy_(energy) {}

  void survey(const Building& building, const PipelineOptions& options, BuildingEnergy& out) {
    sort_features();
    Plan plan;
    for (const FeatureId feature : leaving_)
      plan.steps.push_back({feature, "omit", "energy/heated-body"});
    const Solid& whole = *result_.solid;
    auto made = oriel::generalise(redraw_context(building, result_, result_.output, options), plan);
    body_ = made.value ? std::move(made.value->solid) : whole;
    for (const FeatureId feature : leaving_)
      if (!made.value || !std::ranges::binary_search(made.value->removed, feature))
        staying_.push_back(feature);
    out.volume_m3 = volume_m3(body_);
    const Box box = box_of(body_);
    out.height_m = box.max.z - box.min.z;
    find_faces(out);
    for (const FeatureId feature : openings_) add_opening(feature, out);
    for (const FeatureId feature : staying_) subtract(feature, out);
    order_faces(out);
  }

  /// By the lower edges of openings in walls, from the lowest up: one begins a storey that lies
  /// kLeastStorey_m or more above the first one of the storey below.
  [[nodiscard]] std::optional<int> storeys_of_openings() const {
    std::vector<double> sills;
    for (const FeatureId id : openings_) {
      const Feature& of = feature(id);
      if (of.planes.empty()) continue;
      const Vec3 normal = segmentation_.planes[of.planes.front().index()].normal;
      if (looks_aside(normal)) sills.push_back(of.box.min.z);
    }
    if (sills.empty()) return std::nullopt;
    std::ranges::sort(sills);
    int storeys = 0;
    double first = -Box::kInfinity;
    for (const double sill : sills) {
      if (sill < first + kLeastStorey_m) continue;
      first = sill;
      ++storeys;
    }
    return storeys;
  }

 private:
  [[nodiscard]] const Feature& feature(FeatureId id) const {
    return segmentation_.features[id.index()];
  }

  [[nodiscard]] bool is_unheated(FeatureId id) const {
    const std::string& label = result_.interpretation.verdicts[id.index()].label;
    return !label.empty() && std::ranges::any_of(energy_.unheated, [&](const std::string& name) {
      return is_of_class(rules_, label, name);
    });
  }

  /// It is unheated, or sits on or in what is.
  [[nodiscard]] bool is_outside(FeatureId id) const {
    if (!id.is_valid()) return false;
    if (is_unheated(id)) return true;
    return is_outside(feature(id).parent) || is_outside(feature(id).host);
  }

  /// It sits on or in an opening, such as the light in a door: it is part of that.
  [[nodiscard]] bool is_in_opening(FeatureId id) const {
    for (const FeatureId above : {feature(id).parent, feature(id).host}) {
      if (!above.is_valid()) continue;
      if (is_opening(above) || is_in_opening(above)) return true;
    }
    return false;
  }

  [[nodiscard]] LabelledAs role(FeatureId id) const {
    return labelled_as(rules_, result_.interpretation.verdicts[id.index()].label);
  }
  [[nodiscard]] bool is_opening(FeatureId id) const { return role(id) != LabelledAs::other; }

  void sort_features() {
    for (int i = 0; i < static_cast<int>(segmentation_.features.size()); ++i) {
      const FeatureId id{i};
      const bool is_outer = is_outside(id);
      if (is_opening(id) && !is_outer && !is_in_opening(id)) openings_.push_back(id);
      if (is_outer ? is_unheated(id) : is_opening(id)) leaving_.push_back(id);
    }
  }

  void find_faces(BuildingEnergy& out) {
    const SurfaceTable table = describe_facets(body_, result_.tolerances);
    const auto names = interpret_surfaces(rules_, table);
    std::map<std::pair<EnvelopeKind, PlaneId>, std::size_t> face_of;
    std::vector<FacetId> roof;
    for (int i = 0; i < static_cast<int>(body_.facets.size()); ++i) {
      const Facet& facet = body_.facets[at(i)];
      if (is_of_staying(facet)) continue;
      const Plane& plane = body_.planes[facet.plane.index()];
      const EnvelopeKind kind = kind_of(names[at(i)].type, plane.normal);
      if (kind == EnvelopeKind::roof) roof.push_back(FacetId{i});
      const auto [place, is_new] = face_of.try_emplace({kind, facet.plane}, out.faces.size());
      if (is_new) {
        out.faces.push_back({kind, plane.normal, plane.offset_m, inclination_deg(plane.normal),
                             azimuth_of(plane.normal)});
        facets_of_.emplace_back();
      }
      add_facet(facet, plane.normal, out.faces[place->second]);
      facets_of_[place->second].push_back(i);
    }
    out.roof_form = roof_form_of(body_, roof);
  }

  void add_facet(const Facet& facet, Vec3 normal, EnvelopeFace& face) const {
    const double area = area_m2(body_.vertices, facet, normal);
    face.area_m2 += area;
    if (!result_.surroundings) return;
    face.party_m2 = face.party_m2.value_or(0);
    if (face.kind != EnvelopeKind::wall) return;
    const auto outlines = outlines_of(body_.vertices, facet.loops);
    *face.party_m2 += area * result_.surroundings->covered_share(outlines, normal);
  }

  /// Its polygons are all of a feature that could not be taken off.
  [[nodiscard]] bool is_of_staying(const Facet& facet) const {
    return !facet.polygons.empty() && std::ranges::any_of(staying_, [&](FeatureId id) {
      const auto& of = feature(id).source_polygons;
      return feature(id).sense != Sense::imprint && std::ranges::includes(of, facet.polygons);
    });
  }

  /// The face that a feature's cap lies in, if there is one; of several the one that has it inside.
  [[nodiscard]] EnvelopeFace* face_under(const Feature& of, BuildingEnergy& out) const {
    if (of.planes.empty()) return nullptr;
    const Plane& plane = segmentation_.planes[of.planes.front().index()];
    EnvelopeFace* found = nullptr;
    std::tuple<bool, double> best{true, kInPlane_m};
    for (std::size_t i = 0; i < out.faces.size(); ++i) {
      EnvelopeFace& face = out.faces[i];
      if (dot(face.normal, plane.normal) < kInPlane_cos) continue;
      const double off = std::abs(dot(face.normal, of.cap_point) - face.offset_m);
      const bool is_beside = std::ranges::none_of(facets_of_[i], [&](int f) {
        const auto outlines = outlines_of(body_.vertices, body_.facets[at(f)].loops);
        return contains(outlines, face.normal, of.cap_point);
      });
      if (std::tuple(is_beside, off) >= best) continue;
      best = {is_beside, off};
      found = &face;
    }
    return found;
  }

  /// Whether a cell is of a feature, or of one within it.
  [[nodiscard]] bool is_within(const Cell& cell, FeatureId of) const {
    for (FeatureId at = cell.feature; at.is_valid(); at = feature(at).parent)
      if (at == of) return true;
    return false;
  }

  /// The area of a feature in the plane of its largest cap: what its body, with all that is in it,
  /// has there. Of an imprint, and of what no cut splits off, the area of its outline.
  [[nodiscard]] double cap_m2(FeatureId id) const {
    const Feature& of = feature(id);
    if (!of.node.is_valid()) return of.new_area_m2;
    if (of.planes.empty()) return 0;
    const Plane& cap = segmentation_.planes[of.planes.front().index()];
    double area = 0;
    for (const Cell& cell : segmentation_.cells) {
      if (!is_within(cell, id)) continue;
      for (const Facet& facet : cell.facets) {
        const Plane& plane = segmentation_.planes[facet.plane.index()];
        const double side = side_of(plane, cap);
        if (side != 0)
          area += side * cell.sign * area_m2(segmentation_.vertices, facet, plane.normal);
      }
    }
    return std::abs(area);
  }

  /// 1 if they are one plane, -1 if one is the other turned round, else 0.
  static double side_of(const Plane& plane, const Plane& other) {
    for (const int side : {1, -1}) {
      bool is_same = plane.offset == side * other.offset;
      for (std::size_t k = 0; k < 3; ++k)
        is_same = is_same && plane.coefficients[k] == side * other.coefficients[k];
      if (is_same) return side;
    }
    return 0;
  }

  [[nodiscard]] bool stays(FeatureId id) const { return std::ranges::binary_search(staying_, id); }

  void add_opening(FeatureId id, BuildingEnergy& out) const {
    EnvelopeFace* face = face_under(feature(id), out);
    if (face == nullptr) return;
    const double area = cap_m2(id);
    face->openings.push_back(
        {result_.description.table.id(id), role(id) == LabelledAs::door, area});
  }

  /// Of what could not be taken off: its cap closes the face, and its volume goes.
  void subtract(FeatureId id, BuildingEnergy& out) const {
    const Feature& of = feature(id);
    if (of.sense == Sense::imprint) return;
    ++out.not_separated;
    out.volume_m3 += of.sense == Sense::protrusion ? -of.volume_m3 : of.volume_m3;
    if (EnvelopeFace* face = face_under(of, out)) face->area_m2 += cap_m2(id);
  }

  /// In an order that does not depend on that of the input.
  static void order_faces(BuildingEnergy& out) {
    const auto key = [](const EnvelopeFace& face) {
      const auto rounded = [](double value) { return std::round(value * 1e4); };
      return std::tuple(face.kind, rounded(face.azimuth_deg.value_or(-1)),
                        rounded(face.inclination_deg), rounded(face.offset_m), face.area_m2);
    };
    std::ranges::sort(
        out.faces, [&](const EnvelopeFace& a, const EnvelopeFace& b) { return key(a) < key(b); });
    for (EnvelopeFace& face : out.faces) std::ranges::sort(face.openings, {}, &EnvelopeOpening::id);
  }

  const PipelineResult& result_;
  const Segmentation& segmentation_;
  const RuleBase& rules_;
  const EnergyOptions& energy_;
  /// Openings of the heated body; what is to leave it; of that, what could not. Ascending.
  std::vector<FeatureId> openings_, leaving_, staying_;
  Solid body_;
  /// Facets of the body, by face.
  std::vector<std::vector<int>> facets_of_;
};

}  // namespace

std::string_view to_string(RoofForm form) {
  constexpr std::array<std::string_view, 8> kNames{"",       "flat",      "shed",    "gabled",
                                                   "hipped", "pyramidal", "mansard", "other"};
  return kNames.at(static_cast<std::size_t>(form));
}

BuildingEnergy energy_of(const Building& building, const PipelineResult& result,
                         const RuleBase& rules, const PipelineOptions& options,
                         const EnergyOptions& energy) {
  BuildingEnergy out;
  out.building = building.id;
  out.lod = building.lod;
  if (!result.is_done() || !result.is_solid()) return out;
  out.is_known = true;
  out.is_closed = !result.is_open();
  EnvelopeSurvey envelope(result, rules, energy);
  envelope.survey(building, options, out);
  out.storeys = envelope.storeys_of_openings();
  if (out.storeys) out.storeys_source = "openings";
  return out;
}

std::string unknown_class(const RuleBase& rules, const EnergyOptions& energy) {
  const std::vector<std::string> known = class_names(rules), usual = EnergyOptions{}.unheated;
  for (const std::string& name : energy.unheated)
    if (!name.empty() && !contains(known, name) && !contains(usual, name))
      return fmt::format("the pack has no class '{}'{}", printable(name),
                         did_you_mean(name, known));
  return {};
}

std::string_view to_string(EnvelopeKind kind) {
  constexpr std::array<std::string_view, 5> kNames{"wall", "roof", "ground", "ceiling", "floor"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::string_view to_string(Direction direction) {
  constexpr std::array<std::string_view, kDirections> kNames{"n", "ne", "e", "se",
                                                             "s", "sw", "w", "nw"};
  return kNames.at(static_cast<std::size_t>(direction));
}

Direction direction_of(double azimuth_deg) {
  constexpr double kWide_deg = 360.0 / kDirections;
  const double turned = std::fmod(azimuth_deg + kWide_deg / 2 + 360, 360);
  return static_cast<Direction>(
      std::min(kDirections - 1, static_cast<std::size_t>(turned / kWide_deg)));
}

}  // namespace oriel
