#include "kernel/io/gltf/glb_writer.h"

#include "kernel/io/gltf/colours.h"
#include "kernel/io/gltf/glb_buffers.h"
#include "kernel/io/gltf/property_table.h"
#include "kernel/model/version.h"

#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

namespace oriel {

using detail::bytes_of;
using detail::GlbBuffers;
using nlohmann::ordered_json;

namespace {

/// Ids of features are numbers with 24 binary digits, as vertices have no larger whole ones.
constexpr std::size_t kMostFeatures = 1U << 24U;
/// The colour of lines, nearly black.
constexpr double kLineShade = 0.05;

using Rgba = std::array<std::uint8_t, 4>;
using CornerTriples = std::vector<std::array<std::uint32_t, 3>>;

/// z up as y up.
FlatMesh::Point turned(const FlatMesh::Point& p) { return {p[0], p[2], p[1] == 0 ? 0 : -p[1]}; }

std::vector<FlatMesh::Point> turned(const std::vector<FlatMesh::Point>& points) {
  std::vector<FlatMesh::Point> out;
  out.reserve(points.size());
  for (const FlatMesh::Point& point : points) out.push_back(turned(point));
  return out;
}

/// Least and largest coordinates, which accessors of positions have.
ordered_json limits_of(const std::vector<FlatMesh::Point>& points) {
  FlatMesh::Point least = points.front(), most = points.front();
  for (const FlatMesh::Point& point : points)
    for (std::size_t i = 0; i < 3; ++i) {
      least[i] = std::min(least[i], point[i]);
      most[i] = std::max(most[i], point[i]);
    }
  return {{"min", least}, {"max", most}};
}

/// Writes one mesh.
class GlbWriter {
 public:
  GlbWriter(const FlatMesh& mesh, const GlbOptions& options)
      : mesh_(mesh), options_(options), buffers_(options.compression == GlbCompression::meshopt) {
    if (mesh.features.size() > kMostFeatures)
      throw std::length_error("a GLB has 16,777,216 features at most");
  }

  std::string write(Vec3 translation_m) {
    ordered_json head{
        {"asset", {{"version", "2.0"}, {"generator", std::string("oriel ") + kVersion}}}};
    if (mesh_.triangles.empty()) {
      head["scene"] = 0;
      head["scenes"] = ordered_json::array({ordered_json::object()});
      return detail::glb_file(head, "");
    }
    const ordered_json primitives = this->primitives();
    head["extensionsUsed"] = {"EXT_mesh_features", "EXT_structural_metadata"};
    if (buffers_.has_compressed()) {
      head["extensionsUsed"].push_back(detail::kMeshoptExtension);
      head["extensionsRequired"] = {detail::kMeshoptExtension};
    }
    head["extensions"]["EXT_structural_metadata"] =
        detail::structural_metadata(mesh_.features, labels(), surfaces(), buffers_);
    head["scene"] = 0;
    head["scenes"] = ordered_json::array({{{"nodes", {0}}}});
    ordered_json node{{"mesh", 0}};
    const Vec3 t = translation_m;
    if (t != Vec3{}) node["translation"] = {t.x, t.z, 0 - t.y};
    head["nodes"] = ordered_json::array({node});
    head["meshes"] = ordered_json::array({{{"primitives", primitives}}});
    head["materials"] = materials_;
    head["accessors"] = buffers_.accessors();
    head["bufferViews"] = buffers_.views();
    head["buffers"] = buffers_.buffers();
    return detail::glb_file(head, buffers_.bytes());
  }

 private:
  ordered_json primitives() {
    using ViewTarget = GlbBuffers::ViewTarget;
    using NumberType = GlbBuffers::NumberType;
    const auto vertices = [&](const auto& values, NumberType component, const char* type,
                              std::size_t stride, const ordered_json& more) {
      return buffers_.add_accessor(
          buffers_.add_view(bytes_of(values), ViewTarget::vertices, stride), component, type,
          values.size(), more);
    };
    const std::vector<FlatMesh::Point> points = turned(mesh_.points);
    const std::vector<float> ids(mesh_.feature_of.begin(), mesh_.feature_of.end());
    ordered_json attributes;
    attributes["POSITION"] =
        vertices(points, NumberType::single, "VEC3", sizeof(FlatMesh::Point), limits_of(points));
    const ordered_json lines_attributes = attributes;
    attributes["NORMAL"] = vertices(turned(mesh_.normals), NumberType::single, "VEC3",
                                    sizeof(FlatMesh::Point), ordered_json::object());
    const std::vector<Rgba> colours = this->colours();
    if (!colours.empty())
      attributes["COLOR_0"] =
          vertices(of_points(colours), NumberType::byte_u, "VEC4", 4, {{"normalized", true}});
    attributes["_FEATURE_ID_0"] =
        vertices(ids, NumberType::single, "SCALAR", sizeof(float), ordered_json::object());
    const auto [opaque, transparent] = by_opacity(colours);
    ordered_json all = ordered_json::array();
    if (!opaque.empty()) all.push_back(faces(attributes, opaque, "faces", "OPAQUE"));
    if (options_.has_outlines)
      all.push_back({{"attributes", lines_attributes},
                     {"indices", indices(mesh_.edges)},
                     {"material", add_material("edges", kLineShade, "OPAQUE")},
                     {"mode", 1}});
    if (!transparent.empty())
      all.push_back(faces(attributes, transparent, "transparent faces", "BLEND"));
    return all;
  }

  ordered_json faces(const ordered_json& attributes, const CornerTriples& triangles,
                     const char* name, const char* alpha_mode) {
    return {{"attributes", attributes},
            {"indices", indices(triangles)},
            {"material", add_material(name, 1, alpha_mode)},
            {"mode", 4},
            {"extensions", {{"EXT_mesh_features", feature_ids()}}}};
  }

  int add_material(const char* name, double shade, const char* alpha_mode) {
    ordered_json surface{{"metallicFactor", 0}, {"roughnessFactor", 1}};
    if (shade != 1) surface["baseColorFactor"] = {shade, shade, shade, 1};
    ordered_json material{{"name", name}, {"pbrMetallicRoughness", surface}};
    if (std::string_view(alpha_mode) != "OPAQUE") material["alphaMode"] = alpha_mode;
    materials_.push_back(std::move(material));
    return static_cast<int>(materials_.size()) - 1;
  }

  /// Those that nothing shines through, and the others.
  [[nodiscard]] std::pair<CornerTriples, CornerTriples> by_opacity(
      const std::vector<Rgba>& colours) const {
    std::pair<CornerTriples, CornerTriples> parts;
    for (const auto& triangle : mesh_.triangles) {
      const bool is_opaque =
          colours.empty() || colours[mesh_.feature_of[triangle[0]]][3] == detail::kOpaque;
      (is_opaque ? parts.first : parts.second).push_back(triangle);
    }
    return parts;
  }

  [[nodiscard]] ordered_json feature_ids() const {
    const ordered_json set{
        {"featureCount", mesh_.features.size()}, {"attribute", 0}, {"propertyTable", 0}};
    return {{"featureIds", ordered_json::array({set})}};
  }

  /// Numbers of points, short ones if they fit.
  template <class Tuples>
  int indices(const Tuples& tuples) {
    constexpr std::size_t kMostShort = 65'535;  // the number 65,535 itself says "begin anew"
    const std::size_t corners = tuples.front().size();
    int view = 0;
    const bool is_short = mesh_.points.size() <= kMostShort;
    if (is_short) {
      std::vector<std::uint16_t> numbers;
      for (const auto& tuple : tuples)
        for (const std::uint32_t v : tuple) numbers.push_back(static_cast<std::uint16_t>(v));
      view = buffers_.add_view(bytes_of(numbers), GlbBuffers::ViewTarget::indices,
                               sizeof(std::uint16_t));
    } else {
      view = buffers_.add_view(bytes_of(tuples), GlbBuffers::ViewTarget::indices,
                               sizeof(std::uint32_t));
    }
    return buffers_.add_accessor(
        view, is_short ? GlbBuffers::NumberType::short_u : GlbBuffers::NumberType::int_u, "SCALAR",
        corners * tuples.size());
  }

  [[nodiscard]] Rgba colour_of(const FlatFeature& feature) const {
    if (options_.colours == GlbColours::by_label)
      return detail::linear(detail::colour_of_label(feature.label));
    if (options_.colours == GlbColours::by_material && feature.colour) {
      const auto [red, green, blue, opacity] = *feature.colour;
      return detail::linear({red, green, blue}, opacity);
    }
    return detail::linear(detail::colour_of_surface(feature.surface));
  }

  /// Of the features; none if faces have no colours.
  [[nodiscard]] std::vector<Rgba> colours() const {
    std::vector<Rgba> out;
    if (options_.colours == GlbColours::none) return out;
    for (const FlatFeature& feature : mesh_.features) out.push_back(colour_of(feature));
    return out;
  }

  [[nodiscard]] std::vector<Rgba> of_points(const std::vector<Rgba>& of_features) const {
    std::vector<Rgba> out;
    out.reserve(mesh_.feature_of.size());
    for (const std::uint32_t feature : mesh_.feature_of) out.push_back(of_features[feature]);
    return out;
  }

  [[nodiscard]] std::set<std::string> labels() const {
    std::set<std::string> names = options_.labels;
    for (const FlatFeature& feature : mesh_.features) names.insert(feature.label);
    return names;
  }
  [[nodiscard]] std::set<std::string> surfaces() const {
    std::set<std::string> names = options_.surfaces;
    for (const FlatFeature& feature : mesh_.features) names.insert(feature.surface);
    return names;
  }

  const FlatMesh& mesh_;
  const GlbOptions& options_;
  GlbBuffers buffers_;
  ordered_json materials_ = ordered_json::array();
};

}  // namespace

std::string write_glb(const FlatMesh& mesh, Vec3 translation_m, const GlbOptions& options) {
  return GlbWriter(mesh, options).write(translation_m);
}

std::string write_glb(const MeshSource& source, const GlbOptions& options) {
  Box box;
  for (const MeshPolygon& polygon : source.polygons)
    for (const auto& ring : polygon.rings)
      for (const int v : ring) box.grow(source.points[static_cast<std::size_t>(v)]);
  if (box.is_empty()) return write_glb(FlatMesh{}, {}, options);
  const Vec3 middle = 0.5 * (box.min + box.max);
  const Vec3 origin{std::floor(middle.x), std::floor(middle.y), std::floor(middle.z)};
  return write_glb(flat_mesh(source, origin), origin, options);
}

}  // namespace oriel
