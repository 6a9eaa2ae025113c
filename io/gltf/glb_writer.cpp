#include "io/gltf/glb_writer.h"

#include "io/gltf/glb_buffers.h"
#include "io/mesh/label_colours.h"
#include "model/version.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace oriel {

using detail::bytes_of;
using detail::GlbBuffers;
using nlohmann::ordered_json;

namespace {

/// What a feature without a score has in its place.
constexpr float kNoScore = -1;

/// The number of each name of an enumeration is its place among them.
ordered_json enumeration(const std::string& name, const std::set<std::string>& names) {
  ordered_json values = ordered_json::array();
  for (const std::string& one : names)
    values.push_back({{"name", one.empty() ? "none" : one}, {"value", values.size()}});
  return {{"name", name}, {"valueType", "UINT16"}, {"values", values}};
}

ordered_json schema(const std::set<std::string>& labels, const std::set<std::string>& surfaces) {
  const auto text = [](const char* about) {
    return ordered_json{{"description", about}, {"type", "STRING"}, {"required", true}};
  };
  const auto choice = [](const char* about, const char* of) {
    return ordered_json{
        {"description", about}, {"type", "ENUM"}, {"enumType", of}, {"required", true}};
  };
  const ordered_json score{{"description", "How sure the label is, from 0 to 1"},
                           {"type", "SCALAR"},
                           {"componentType", "FLOAT32"},
                           {"noData", kNoScore}};
  const ordered_json height{{"description", "From the lowest point to the highest, in metres"},
                            {"type", "SCALAR"},
                            {"componentType", "FLOAT32"},
                            {"required", true}};
  const ordered_json properties{
      {"building", text("The id of the building")},
      {"id", text("The id of the feature, the same at all scales; empty for what is no feature")},
      {"label", choice("What it is", "label")},
      {"surface", choice("The type of its semantic surfaces", "surface")},
      {"score", score},
      {"rule", text("The rule that gave the label")},
      {"height", height}};
  return {{"id", "oriel"},
          {"classes", {{"feature", {{"name", "Feature"}, {"properties", properties}}}}},
          {"enums",
           {{"label", enumeration("Label", labels)},
            {"surface", enumeration("Type of surface", surfaces)}}}};
}

/// Writes the columns of a table.
class ColumnWriter {
 public:
  ColumnWriter(const std::vector<FlatFeature>& features, GlbBuffers& buffers)
      : features_(features), buffers_(buffers) {}

  template <class Text>
  ordered_json texts(Text text_of) {
    std::string values;
    std::vector<std::uint32_t> offsets{0};
    for (const FlatFeature& feature : features_) {
      values += text_of(feature);
      offsets.push_back(static_cast<std::uint32_t>(values.size()));
    }
    if (values.empty()) values += '\0';  // a view has at least one byte
    return {{"values", buffers_.add_view(values, GlbBuffers::ViewTarget::none)},
            {"stringOffsets", buffers_.add_view(bytes_of(offsets), GlbBuffers::ViewTarget::none)},
            {"stringOffsetType", "UINT32"}};
  }

  template <class Number, class Value>
  ordered_json numbers(Value value_of) {
    std::vector<Number> values;
    for (const FlatFeature& feature : features_)
      values.push_back(static_cast<Number>(value_of(feature)));
    return {{"values", buffers_.add_view(bytes_of(values), GlbBuffers::ViewTarget::none)}};
  }

 private:
  const std::vector<FlatFeature>& features_;
  GlbBuffers& buffers_;
};

/// The extension EXT_structural_metadata of a file: the schema, and the table of the features,
/// whose columns go to `buffers`. The enumerations name `labels` and `surfaces`, which have all of
/// the features.
ordered_json structural_metadata(const std::vector<FlatFeature>& features,
                                 const std::set<std::string>& labels,
                                 const std::set<std::string>& surfaces, GlbBuffers& buffers) {
  ColumnWriter columns(features, buffers);
  const auto place = [](const std::set<std::string>& names, const std::string& name) {
    return std::distance(names.begin(), names.find(name));
  };
  using Feature = const FlatFeature&;
  ordered_json properties;
  properties["building"] = columns.texts([](Feature f) { return f.building; });
  properties["id"] = columns.texts([](Feature f) { return f.id; });
  properties["label"] =
      columns.numbers<std::uint16_t>([&](Feature f) { return place(labels, f.label); });
  properties["surface"] =
      columns.numbers<std::uint16_t>([&](Feature f) { return place(surfaces, f.surface); });
  properties["score"] = columns.numbers<float>(
      [](Feature f) { return f.score ? static_cast<float>(*f.score) : kNoScore; });
  properties["rule"] = columns.texts([](Feature f) { return f.rule; });
  properties["height"] = columns.numbers<float>([](Feature f) { return f.height_m; });
  const ordered_json table{{"name", "features"},
                           {"class", "feature"},
                           {"count", features.size()},
                           {"properties", properties}};
  return {{"schema", schema(labels, surfaces)}, {"propertyTables", ordered_json::array({table})}};
}

/// The opacity of what nothing shines through.
constexpr std::uint8_t kOpaque = 255;

/// The same as glTF has colours of vertices: linear, with an opacity.
std::array<std::uint8_t, 4> linear(Colour colour, std::uint8_t opacity = kOpaque) {
  std::array<std::uint8_t, 4> out{0, 0, 0, opacity};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = colour[i] / 255.0;
    const double value = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    out[i] = static_cast<std::uint8_t>(std::lround(255 * value));
  }
  return out;
}

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
        structural_metadata(mesh_.features, labels(), surfaces(), buffers_);
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
          colours.empty() || colours[mesh_.feature_of[triangle[0]]][3] == kOpaque;
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
    if (options_.colours == GlbColours::by_label) return linear(colour_of_label(feature.label));
    if (options_.colours == GlbColours::by_material && feature.colour) {
      const auto [red, green, blue, opacity] = *feature.colour;
      return linear({red, green, blue}, opacity);
    }
    return linear(colour_of_surface(feature.surface));
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
