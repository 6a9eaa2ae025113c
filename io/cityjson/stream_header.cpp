#include "io/cityjson/stream_header.h"

#include "io/json/raw_json.h"
#include "io/json/words.h"
#include "kernel/base/sha256.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <nlohmann/json.hpp>

namespace oriel {

namespace {

using nlohmann::json;

json facts_of(const RawNode& root, const std::vector<std::string>& keys) {
  json facts = json::object();
  const auto take = [&](const RawNode& node, const std::string& key) {
    const std::string_view value = node.value_of(key);
    if (!value.empty()) facts[key] = json::parse(value, nullptr, false);
  };
  for (const std::string& key : keys) take(root, key);
  if (const std::string_view metadata = root.value_of("metadata"); RawNode::is_object(metadata))
    take(RawNode(metadata), "referenceSystem");
  return facts;
}

}  // namespace

std::string stream_header_facts(std::string_view header) {
  return facts_of(RawNode(header), {"version", "transform"}).dump();
}

std::string feature_id(std::string_view line) {
  if (!RawNode::is_object(line)) return {};
  return decoded(RawNode(line).value_of("id"));
}

std::string file_facts(std::string_view header) {
  const RawNode root(header);
  json facts = facts_of(root, {"version"});
  constexpr const char* kTemplates = "geometry-templates";
  if (const std::string_view templates = root.value_of(kTemplates); !templates.empty())
    facts[kTemplates] = sha256(templates);
  return facts.dump();
}

namespace {

/// Zero for what is no number: Reader has reported it.
std::array<double, 3> three_of(std::string_view array) {
  std::array<double, 3> numbers{};
  std::size_t count = 0;
  for (const std::string_view text : elements_of(array))
    if (count < numbers.size()) numbers[count++] = detail::as_double(text).value_or(0);
  return numbers;
}

Vec3 as_point(const std::array<double, 3>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

}  // namespace

FeaturePlace::FeaturePlace(std::string_view header) {
  const RawNode transform(RawNode(header).value_of("transform"));
  scale_ = as_point(three_of(transform.value_of("scale")));
  translate_ = as_point(three_of(transform.value_of("translate")));
}

std::optional<Vec3> FeaturePlace::middle_of(std::string_view feature) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> least{kInfinity, kInfinity, kInfinity},
      most{-kInfinity, -kInfinity, -kInfinity};
  for_each_element(RawNode(feature).value_of("vertices"), [&](std::string_view vertex) {
    const auto numbers = three_of(vertex);
    for (std::size_t axis = 0; axis < numbers.size(); ++axis) {
      least[axis] = std::min(least[axis], numbers[axis]);
      most[axis] = std::max(most[axis], numbers[axis]);
    }
  });
  if (least[0] > most[0]) return std::nullopt;
  const Vec3 middle = 0.5 * (as_point(least) + as_point(most));
  return Vec3{translate_.x + scale_.x * middle.x, translate_.y + scale_.y * middle.y,
              translate_.z + scale_.z * middle.z};
}

}  // namespace oriel
