#include "kernel/io/cityjson_collector.h"

#include "kernel/io/detail/geometry_text.h"
#include "kernel/io/detail/json_text.h"
#include "kernel/io/detail/raw_json.h"
#include "kernel/io/detail/vertex_pool.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace oriel {

namespace {

using detail::RawNode;

constexpr double kCoarsest_m = 0.001;

template <class Number>
std::array<Number, 3> three_numbers(std::string_view array) {
  std::array<Number, 3> numbers{};
  std::size_t count = 0;
  detail::for_each_element(array, [&](std::string_view number) {
    if (count < 3) std::from_chars(number.data(), number.data() + number.size(), numbers[count++]);
  });
  return numbers;
}

/// How many powers of ten all numbers have, up to where the scale is kCoarsest_m.
int common_digits(const std::vector<std::array<std::int64_t, 3>>& vertices, double scale) {
  int digits = 0;
  std::int64_t factor = 10;
  const auto is_whole = [&](const auto& vertex) {
    return std::ranges::all_of(vertex, [&](std::int64_t x) { return x % factor == 0; });
  };
  // The factor allows for scales such as 1.0000001e-4.
  for (; scale < 0.5 * kCoarsest_m && std::ranges::all_of(vertices, is_whole); ++digits) {
    scale *= 10;
    factor *= 10;
  }
  return digits;
}

}  // namespace

void CityJsonCollector::add(std::string_view line) {
  if (line.empty()) return;
  if (header_.empty()) {
    header_ = line;
    return;
  }
  const RawNode feature(line);
  const RawNode objects(feature.value_of("CityObjects"));
  const auto first = static_cast<std::int64_t>(vertices_.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!objects_.empty()) objects_ += ',';
    detail::append_json(objects_, std::string_view(objects.key(i)));
    objects_ += ':';
    objects_ += detail::with_vertex_numbers(objects.value(i), [&](std::size_t number) {
      return first + static_cast<std::int64_t>(number);
    });
  }
  detail::for_each_element(feature.value_of("vertices"), [&](std::string_view vertex) {
    vertices_.push_back(three_numbers<std::int64_t>(vertex));
  });
}

std::string CityJsonCollector::text() const {
  RawNode file(header_);
  RawNode transform(file.value_of("transform"));
  std::array<double, 3> scale = three_numbers<double>(transform.value_of("scale"));
  const int digits = common_digits(vertices_, *std::ranges::min_element(scale));
  std::int64_t factor = 1;
  for (int i = 0; i < digits; ++i) factor *= 10;
  for (double& number : scale) number = detail::scaled_down(number, -digits);
  std::string scale_text;
  detail::append_json_array(scale_text, scale);
  transform.set("scale", std::move(scale_text));
  file.set("transform", transform.text());
  file.set("CityObjects", "{" + objects_ + "}");
  std::string vertices = "[";
  for (const auto& [x, y, z] : vertices_) {
    if (vertices.size() > 1) vertices += ',';
    detail::append_json_array(vertices, std::array{x / factor, y / factor, z / factor});
  }
  file.set("vertices", vertices + "]");
  return file.text() + "\n";
}

}  // namespace oriel
