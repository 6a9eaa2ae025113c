#include "kernel/io/records/feature_place.h"

#include "kernel/io/json/raw_json.h"
#include "kernel/io/json/words.h"

#include <algorithm>
#include <array>
#include <limits>

namespace oriel {

namespace {

using detail::RawNode;

/// Zero for what is no number: Reader has reported it.
std::array<double, 3> three_of(std::string_view array) {
  std::array<double, 3> numbers{};
  std::size_t count = 0;
  for (const std::string_view text : detail::elements_of(array))
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
  detail::for_each_element(RawNode(feature).value_of("vertices"), [&](std::string_view vertex) {
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
