#include "kernel/io/gltf/property_table.h"

#include <iterator>
#include <utility>

namespace oriel::detail {

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

}  // namespace

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

}  // namespace oriel::detail
