#include "io/mesh/mesh_writer.h"
#include "kernel/base/index.h"
#include "model/vec3.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace oriel {

namespace {

/// "WallSurface" as "wall".
std::string label_of_type(std::string type) {
  constexpr std::string_view kSuffix = "Surface";
  if (type.ends_with(kSuffix)) type.resize(type.size() - kSuffix.size());
  for (char& c : type) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return type;
}

MeshFeature feature_of(const std::string& building, const std::string& id, const FeatureLabel& said,
                       const std::string& otherwise) {
  return {building, said.label.empty() ? otherwise : said.label, id, said.score, said.rule};
}

/// The semantic surface of a polygon, or null.
const SemanticSurface* surface_of(const LabelledBuilding& labelled, std::size_t polygon) {
  const int index =
      polygon < labelled.surface_of_polygon.size() ? labelled.surface_of_polygon[polygon] : -1;
  return index < 0 ? nullptr : &labelled.surfaces.at(static_cast<std::size_t>(index));
}

std::string class_of(const LabelledBuilding& labelled, std::size_t polygon) {
  const SemanticSurface* surface = surface_of(labelled, polygon);
  return surface == nullptr ? std::string() : surface->type;
}

/// The feature of each of `count` polygons.
std::vector<MeshFeature> features_of(const LabelledBuilding& labelled, std::size_t count) {
  std::vector<MeshFeature> features(count, {labelled.building, "unlabelled", ""});
  const auto surface = [&](std::size_t polygon) { return surface_of(labelled, polygon); };
  for (std::size_t i = 0; i < count; ++i)
    if (surface(i) != nullptr)
      features[i] = feature_of(labelled.building, surface(i)->label->id, *surface(i)->label,
                               label_of_type(surface(i)->type));
  for (const Installation& installation : labelled.installations)
    for (const int polygon : installation.polygons) {
      const auto i = static_cast<std::size_t>(polygon);
      if (surface(i) == nullptr || !is_opening_type(surface(i)->type))
        features.at(i) =
            feature_of(labelled.building, installation.id, *installation.label, "installation");
    }
  return features;
}

/// Gathers the faces of one building.
class PolygonCollector {
 public:
  PolygonCollector(MeshSource& mesh, Vec3 origin_m)
      : mesh_(mesh), origin_m_(origin_m), first_(static_cast<int>(mesh.points.size())) {}

  void add_vertex(Vec3 local) { mesh_.points.push_back(local + origin_m_); }

  void add_face(std::vector<std::vector<int>> rings, Vec3 normal, const MeshFeature& feature,
                std::string surface, FacetId facet, std::optional<FaceColour> colour) {
    std::erase_if(rings, [](const std::vector<int>& ring) {
      return std::set<int>(ring.begin(), ring.end()).size() < 3;
    });
    if (rings.empty()) return;
    for (auto& ring : rings)
      for (int& v : ring) v += first_;
    mesh_.polygons.push_back(
        {std::move(rings), normal, number_of(feature), std::move(surface), facet, colour});
  }

 private:
  int number_of(const MeshFeature& feature) {
    const auto [found, is_new] =
        numbers_.try_emplace({feature.label, feature.id}, static_cast<int>(mesh_.features.size()));
    if (is_new) mesh_.features.push_back(feature);
    return found->second;
  }

  MeshSource& mesh_;
  Vec3 origin_m_;
  int first_;
  std::map<std::pair<std::string, std::string>, int> numbers_;
};

/// How often colours occur.
using ColourCounts = std::map<FaceColour, int>;

std::optional<FaceColour> most_frequent(const ColourCounts& counts) {
  const auto most = std::ranges::max_element(counts, {}, &ColourCounts::value_type::second);
  return most == counts.end() ? std::nullopt : std::optional(most->first);
}

/// The colour of each facet.
FaceColours colours_of(const Solid& solid, const LabelledBuilding& labelled,
                       const FaceColours& of_polygons) {
  FaceColours out(solid.facets.size());
  if (of_polygons.empty()) return out;
  std::map<std::string, ColourCounts> of_class;
  for (std::size_t f = 0; f < out.size(); ++f) {
    ColourCounts counts;
    for (const int polygon : solid.facets[f].polygons)
      if (at(polygon) < of_polygons.size() && of_polygons[at(polygon)])
        ++counts[*of_polygons[at(polygon)]];
    out[f] = most_frequent(counts);
    if (out[f]) ++of_class[class_of(labelled, f)][*out[f]];
  }
  for (std::size_t f = 0; f < out.size(); ++f)
    if (!out[f] && solid.facets[f].polygons.empty())
      out[f] = most_frequent(of_class[class_of(labelled, f)]);
  return out;
}

void add_polygons(MeshSource& mesh, const Building& building, const LabelledBuilding& labelled,
                  const FaceColours& colours) {
  PolygonCollector polygons(mesh, building.frame.origin_m);
  for (const Vec3 p : building.vertices) polygons.add_vertex(p);
  int count = 0;
  for (const Polygon& polygon : building.polygons) count = std::max(count, polygon.source + 1);
  const std::vector<MeshFeature> features = features_of(labelled, static_cast<std::size_t>(count));
  for (const Polygon& polygon : building.polygons) {
    if (polygon.rings.empty()) continue;
    const std::size_t source = at(polygon.source);
    polygons.add_face(polygon.rings, normalised(area_vector(building.vertices, polygon.rings[0])),
                      features[source], class_of(labelled, source), {},
                      source < colours.size() ? colours[source] : std::nullopt);
  }
}

void add_solid(MeshSource& mesh, const Solid& solid, Vec3 origin_m,
               const LabelledBuilding& labelled, const FaceColours& of_polygons) {
  PolygonCollector polygons(mesh, origin_m);
  const FaceColours colours = colours_of(solid, labelled, of_polygons);
  for (const Vertex& vertex : solid.vertices) polygons.add_vertex(vertex.point);
  const std::vector<MeshFeature> features = features_of(labelled, solid.facets.size());
  for (std::size_t f = 0; f < solid.facets.size(); ++f)
    polygons.add_face(solid.facets[f].loops, solid.planes[solid.facets[f].plane.index()].normal,
                      features[f], class_of(labelled, f), FacetId{static_cast<int>(f)}, colours[f]);
}

}  // namespace

void append_mesh(MeshSource& mesh, const Document& document,
                 const std::vector<LabelledBuilding>& labelled) {
  std::map<std::string_view, const LabelledBuilding*> labels_of;
  for (const LabelledBuilding& one : labelled) labels_of.try_emplace(one.building, &one);
  for (const Building& building : document.buildings) {
    LabelledBuilding bare;
    bare.building = building.id;
    const auto found = labels_of.find(building.id);
    const LabelledBuilding& labels = found == labels_of.end() ? bare : *found->second;
    append_building(mesh, building, labels);
  }
}

void append_building(MeshSource& mesh, const Building& building, const LabelledBuilding& labels,
                     const FaceColours& colours) {
  if (labels.geometry)
    add_solid(mesh, *labels.geometry, building.frame.origin_m, labels, colours);
  else
    add_polygons(mesh, building, labels, colours);
}

}  // namespace oriel
