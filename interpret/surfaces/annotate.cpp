#include "interpret/surfaces/annotate.h"

#include "interpret/explain/explain.h"
#include "interpret/pack/names.h"
#include "interpret/pack/pack.h"
#include "interpret/surfaces/polygon_shape.h"
#include "interpret/surfaces/surfaces.h"
#include "kernel/base/index.h"
#include "kernel/geometry/boxes.h"
#include "model/description/feature_names.h"
#include "model/version.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace oriel {

namespace {

using rules::Emission;
using rules::Role;

/// Four digits are enough to compare and keep the files short.
double rounded(double score) { return std::round(score * 1e4) / 1e4; }

class Annotator {
 public:
  Annotator(const Building& building, const Segmentation& segmentation, const FeatureTable& table,
            const FeatureGraph& graph, const SurfaceTable& surfaces,
            const Interpretation& interpretation, const RuleBase& base,
            const AnnotateOptions& options)
      : building_(building),
        segmentation_(segmentation),
        table_(table),
        surfaces_(surfaces),
        interpretation_(interpretation),
        base_(base),
        options_(options) {
    if (options.has_reasons && options.feature_reasons.empty() && table.rows() > 0)
      explainer_.emplace(base, table, graph, interpretation);
  }

  LabelledBuilding run();

 private:
  void find_roles();
  void find_parts();
  void find_owners();
  void name_surfaces();
  void count_own_polygons();
  int surface_naming(int feature, const std::string& type, int opening);
  void add_surfaces();
  void add_parents();
  void add_installations();
  void add_attributes();

  /// Features that list a polygon, the smallest first.
  [[nodiscard]] std::span<const int> features_of(const Polygon& polygon) const {
    return (*owners_)[oriel::at(polygon.source)];
  }
  /// The smallest feature that lists the polygon and whose class the pack emits, or -1.
  [[nodiscard]] int find_emitted(const Polygon& polygon) const;
  /// The feature without a type of its own that the polygon's surface names, or -1.
  [[nodiscard]] int find_named(const Polygon& polygon, int emitted) const;
  [[nodiscard]] int surface_around(const Feature& opening) const;
  [[nodiscard]] int nearest_surface(const Box& box, Vec3 normal,
                                    const std::vector<int>& sources) const;
  [[nodiscard]] FeatureLabel label_of(int feature) const;
  void add_codes(const Emission& emission, FeatureLabel& label) const;
  [[nodiscard]] bool is_host_surface(const Polygon& polygon) const;

  const Building& building_;
  const Segmentation& segmentation_;
  const FeatureTable& table_;
  const SurfaceTable& surfaces_;
  const Interpretation& interpretation_;
  const RuleBase& base_;
  const AnnotateOptions& options_;
  std::optional<Explainer> explainer_;
  std::vector<Role> roles_;
  /// What each feature is written as, in short: every polygon asks for it. Without an emission a
  /// protrusion is a generic installation, and any other feature is named by its surfaces.
  enum class Kind : char { nothing, opening, installation, generic_installation, named };
  std::vector<Kind> kinds_;
  /// By feature, the ids of its groups, and those of its parts.
  std::vector<std::vector<std::string>> groups_, parts_;
  /// By feature: feature_names().
  std::vector<std::string> names_;
  /// By source; null for numbers that no polygon has.
  std::vector<const Polygon*> polygons_;
  PolygonOwners own_owners_;
  const PolygonOwners* owners_ = nullptr;
  /// By row; reasons if they are asked for.
  std::vector<SurfaceVerdict> own_verdicts_;
  std::span<const SurfaceVerdict> verdicts_;
  std::vector<std::string> reasons_;
  /// By opening, how many polygons no feature within it takes.
  std::vector<int> own_polygons_;
  /// The surfaces that name a feature, by feature and type, each with the opening that it is or
  /// lies in, or -1.
  struct NamedSurface {
    int surface = -1;
    int opening = -1;
  };
  std::map<std::pair<int, std::string>, NamedSurface> named_surfaces_;
  LabelledBuilding result_;
};

LabelledBuilding Annotator::run() {
  result_.building = building_.id;
  find_roles();
  find_owners();
  add_surfaces();
  add_parents();
  add_installations();
  add_attributes();
  return std::move(result_);
}

void Annotator::find_roles() {
  roles_.resize(segmentation_.features.size());
  kinds_.resize(roles_.size(), Kind::nothing);
  for (const Verdict& verdict : interpretation_.verdicts) {
    if (verdict.label.empty()) continue;
    Role& role = roles_[verdict.feature.index()];
    role = rules::role_of(base_.pack(), verdict.label);
    Kind& kind = kinds_[verdict.feature.index()];
    if (role.emission != nullptr) {
      kind = role.is_opening() ? Kind::opening : Kind::installation;
      continue;
    }
    role.label = verdict.label;
    const bool stands_out =
        segmentation_.features[verdict.feature.index()].sense == Sense::protrusion;
    kind = stands_out ? Kind::generic_installation : Kind::named;
  }
  groups_ = groups_by_feature(interpretation_);
  names_ = feature_names(segmentation_, table_, &interpretation_);
  find_parts();
}

void Annotator::find_parts() {
  std::vector<FeatureId> hosts;
  for (const Feature& feature : segmentation_.features) hosts.push_back(feature.host);
  const std::vector<FeatureId> wholes = wholes_by_feature(interpretation_, hosts);
  parts_.resize(wholes.size());
  for (std::size_t row = 0; row < wholes.size(); ++row)
    if (wholes[row].is_valid())
      parts_[wholes[row].index()].push_back(table_.id(FeatureId{static_cast<int>(row)}));
}

void Annotator::find_owners() {
  if (options_.owners != nullptr) {
    owners_ = options_.owners;
    return;
  }
  own_owners_ = polygon_owners(segmentation_, building_);
  owners_ = &own_owners_;
}

int Annotator::find_emitted(const Polygon& polygon) const {
  for (const int feature : features_of(polygon)) {
    const Kind kind = kinds_[oriel::at(feature)];
    if (kind == Kind::opening || kind == Kind::installation) return feature;
  }
  return -1;
}

/// The smallest feature with a label, unless that has another place in the file: then none.
int Annotator::find_named(const Polygon& polygon, int emitted) const {
  for (const int feature : features_of(polygon)) {
    if (feature == emitted || kinds_[oriel::at(feature)] == Kind::generic_installation) return -1;
    if (kinds_[oriel::at(feature)] == Kind::named) return feature;
  }
  return -1;
}

void Annotator::count_own_polygons() {
  own_polygons_.assign(roles_.size(), 0);
  for (const Polygon& polygon : building_.polygons)
    if (const int feature = find_emitted(polygon); feature >= 0 &&
                                                   kinds_[oriel::at(feature)] == Kind::opening &&
                                                   find_named(polygon, feature) < 0)
      ++own_polygons_[oriel::at(feature)];
}

/// They may be named already.
void Annotator::name_surfaces() {
  verdicts_ = options_.surfaces;
  SurfaceTable with;
  const SurfaceTable* table = &surfaces_;
  if (verdicts_.empty()) {
    with = with_parts(surfaces_, building_, segmentation_, interpretation_, base_);
    table = &with;
    verdicts_ = own_verdicts_ = interpret_surfaces(base_, with);
  }
  if (options_.has_reasons)
    reasons_ = surface_reasons(base_, *table, {verdicts_.begin(), verdicts_.end()});
}

/// One surface for all polygons of the feature that are of the same type.
int Annotator::surface_naming(int feature, const std::string& type, int opening) {
  const auto [entry, is_new] = named_surfaces_.try_emplace({feature, type});
  if (is_new) {
    entry->second = {static_cast<int>(result_.surfaces.size()), opening};
    result_.surfaces.push_back({type, -1, label_of(feature)});
  }
  return entry->second.surface;
}

void Annotator::add_surfaces() {
  name_surfaces();
  count_own_polygons();
  result_.surface_of_polygon.assign(owners_->polygons(), -1);
  polygons_.assign(owners_->polygons(), nullptr);
  result_.surfaces.reserve(building_.polygons.size());
  for (std::size_t row = 0; row < building_.polygons.size(); ++row) {
    const Polygon& polygon = building_.polygons[row];
    polygons_[oriel::at(polygon.source)] = &polygon;
    int& surface = result_.surface_of_polygon[oriel::at(polygon.source)];
    const int feature = find_emitted(polygon);
    const bool is_in_opening = feature >= 0 && kinds_[oriel::at(feature)] == Kind::opening;
    // An opening keeps at least one polygon.
    const int named =
        is_in_opening && own_polygons_[oriel::at(feature)] == 0 ? -1 : find_named(polygon, feature);
    const std::string& type =
        is_in_opening ? roles_[oriel::at(feature)].emission->type : verdicts_[row].type;
    if (named >= 0 || is_in_opening) {
      surface = surface_naming(named >= 0 ? named : feature, type, is_in_opening ? feature : -1);
      continue;
    }
    surface = static_cast<int>(result_.surfaces.size());
    result_.surfaces.emplace_back().type = type;
    if (options_.has_reasons)
      result_.surfaces.back().label = FeatureLabel{.why = std::move(reasons_[row])};
  }
}

bool Annotator::is_host_surface(const Polygon& polygon) const {
  const int surface = result_.surface_of_polygon[oriel::at(polygon.source)];
  if (surface < 0) return false;
  const std::string& type = result_.surfaces[oriel::at(surface)].type;
  return type == "WallSurface" || type == "RoofSurface";
}

/// The surface of the polygon that the opening was cut into: one of those that make up its host's
/// facet or, where a cut made that facet, one of all.
int Annotator::surface_around(const Feature& opening) const {
  if (!opening.host_facet) return -1;
  const Cell& cell = segmentation_.cells[opening.host_facet->cell.index()];
  const Facet& facet = cell.facets[oriel::at(opening.host_facet->facet)];
  const Vec3 normal = segmentation_.planes[facet.plane.index()].normal;
  const int surface = nearest_surface(opening.box, normal, facet.polygons);
  if (surface >= 0) return surface;
  std::vector<int> all;
  for (const Polygon& polygon : building_.polygons) all.push_back(polygon.source);
  return nearest_surface(opening.box, normal, all);
}

/// Of the polygons that are walls or roofs the nearest one; of several the one that lies most in
/// the direction of the facet, then the largest, then the first.
int Annotator::nearest_surface(const Box& box, Vec3 normal, const std::vector<int>& sources) const {
  std::optional<std::tuple<double, double, double, int>> best;
  for (const int source : sources) {
    const Polygon* polygon = polygons_[oriel::at(source)];
    if (polygon == nullptr || !is_host_surface(*polygon)) continue;
    const Vec3 area = rules::area_vector(building_, *polygon);
    const double percent_aligned = std::round(100 * std::abs(dot(normalised(area), normal)));
    const double distance = distance_m(rules::box_of(building_, *polygon), box);
    const std::tuple key(distance, -percent_aligned, -length(area), source);
    if (!best || key < *best) best = key;
  }
  return best ? result_.surface_of_polygon[oriel::at(std::get<3>(*best))] : -1;
}

void Annotator::add_parents() {
  for (const auto& [key, named] : named_surfaces_)
    if (named.opening >= 0)
      result_.surfaces[oriel::at(named.surface)].parent =
          surface_around(segmentation_.features[oriel::at(named.opening)]);
}

FeatureLabel Annotator::label_of(int feature) const {
  const Verdict& verdict = interpretation_.verdicts[oriel::at(feature)];
  const Role& role = roles_[oriel::at(feature)];
  FeatureLabel label{.id = table_.id(verdict.feature),
                     .name = names_[oriel::at(feature)],
                     .label = role.label,
                     .subclass = role.subclass,
                     .score = rounded(verdict.score),
                     .rule = verdict.rule,
                     .groups = groups_[oriel::at(feature)],
                     .parts = parts_[oriel::at(feature)]};
  if (explainer_)
    label.why = reason(explainer_->explain(verdict.feature));
  else if (options_.has_reasons)
    label.why = options_.feature_reasons.at(oriel::at(feature));
  return label;
}

void Annotator::add_codes(const Emission& emission, FeatureLabel& label) const {
  label.class_code = emission.class_code;
  const auto code = emission.function.find(options_.codelist);
  if (code == emission.function.end() || code->second.empty()) return;
  label.function = code->second;
  label.codelist = options_.codelist;
}

void Annotator::add_installations() {
  const auto is_installation = [&](int feature) {
    const Kind kind = kinds_[oriel::at(feature)];
    return kind == Kind::installation || kind == Kind::generic_installation;
  };
  std::vector<std::vector<int>> polygons(roles_.size());
  for (const Polygon& polygon : building_.polygons)
    for (const int feature : features_of(polygon))
      if (is_installation(feature)) {
        polygons[oriel::at(feature)].push_back(polygon.source);
        break;
      }
  for (std::size_t feature = 0; feature < roles_.size(); ++feature) {
    if (polygons[feature].empty()) continue;
    Installation installation;
    installation.id = table_.id(FeatureId{static_cast<int>(feature)});
    FeatureLabel label = label_of(static_cast<int>(feature));
    if (const Emission* emission = roles_[feature].emission; emission != nullptr)
      add_codes(*emission, label);
    installation.label = std::move(label);
    std::ranges::sort(polygons[feature]);
    for (const int polygon : polygons[feature])
      installation.surfaces.push_back(result_.surface_of_polygon[oriel::at(polygon)]);
    installation.polygons = std::move(polygons[feature]);
    result_.installations.push_back(std::move(installation));
  }
}

void Annotator::add_attributes() {
  result_.attributes = {{"oriel_version", std::string(kVersion)},
                        {"oriel_pack", base_.name() + " " + base_.version()},
                        {"oriel_pack_sha256", base_.sha256()}};
  for (const auto& attribute : options_.attributes) result_.attributes.push_back(attribute);
}

}  // namespace

LabelledBuilding annotate(const Building& building, const Segmentation& segmentation,
                          const FeatureTable& table, const FeatureGraph& graph,
                          const SurfaceTable& surfaces, const Interpretation& interpretation,
                          const RuleBase& base, const AnnotateOptions& options) {
  return Annotator(building, segmentation, table, graph, surfaces, interpretation, base, options)
      .run();
}

}  // namespace oriel
