#include "io/cityjson/added_transform.h"

#include "io/json/raw_json.h"
#include "io/json/rings.h"
#include "io/json/words.h"
#include "kernel/base/text/json_text.h"
#include "model/vec3.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

using WrittenVertex = std::array<double, 3>;

constexpr double kMicrometresPerMetre = 1e6;
constexpr std::int64_t kMicrometresPerMillimetre = 1000;

/// The three numbers of a vertex, or nothing.
std::optional<WrittenVertex> written_vertex(std::string_view text) {
  const std::vector<std::string_view> words = elements_of(text);
  WrittenVertex numbers{};
  if (words.size() != numbers.size()) return std::nullopt;
  for (std::size_t axis = 0; axis < numbers.size(); ++axis) {
    const auto number = as_double(words[axis]);
    if (!number) return std::nullopt;
    numbers[axis] = *number;
  }
  return numbers;
}

bool is_near_enough(double coordinate) { return std::abs(coordinate) <= kMaxCoordinate_m; }

/// The vertices of a text without transform, and the transform that they get.
class Regridder {
 public:
  explicit Regridder(std::string_view vertices) {
    Box box;
    for_each_element(vertices, [&](std::string_view text) {
      texts_.push_back(text);
      vertices_.push_back(written_vertex(text));
      if (!vertices_.back()) return;
      const auto& [x, y, z] = *vertices_.back();
      if (is_near_enough(x) && is_near_enough(y) && is_near_enough(z)) box.grow(Vec3{x, y, z});
    });
    if (!box.is_empty())
      origin_ = {std::floor(box.min.x), std::floor(box.min.y), std::floor(box.min.z)};
    for (const auto& vertex : vertices_)
      if (vertex && !is_in_millimetres(*vertex)) unit_ = 1;
  }

  [[nodiscard]] std::string vertices_text() const {
    std::string out = "[";
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      if (i > 0) out += ',';
      if (vertices_[i])
        append_vertex(out, *vertices_[i]);
      else
        out += texts_[i];
    }
    return out + ']';
  }

  [[nodiscard]] std::string transform_text() const {
    const double scale = static_cast<double>(unit_) / kMicrometresPerMetre;
    std::string out = R"({"scale":)";
    append_json_array(out, std::array{scale, scale, scale});
    out += R"(,"translate":)";
    append_json_array(out, origin_);
    return out + '}';
  }

 private:
  /// Only for one that is near enough.
  [[nodiscard]] std::int64_t micrometres(double coordinate, std::size_t axis) const {
    return std::llround((coordinate - origin_[axis]) * kMicrometresPerMetre);
  }

  [[nodiscard]] bool is_in_millimetres(const WrittenVertex& vertex) const {
    for (std::size_t axis = 0; axis < vertex.size(); ++axis)
      if (is_near_enough(vertex[axis]) &&
          micrometres(vertex[axis], axis) % kMicrometresPerMillimetre != 0)
        return false;
    return true;
  }

  void append_vertex(std::string& out, const WrittenVertex& vertex) const {
    for (std::size_t axis = 0; axis < vertex.size(); ++axis) {
      out += axis == 0 ? '[' : ',';
      if (is_near_enough(vertex[axis]))
        append_json(out, micrometres(vertex[axis], axis) / unit_);
      else
        append_json(out, vertex[axis] * kMicrometresPerMetre);
    }
    out += ']';
  }

  std::vector<std::string_view> texts_;
  std::vector<std::optional<WrittenVertex>> vertices_;
  std::array<double, 3> origin_{};
  /// What the numbers count, in micrometres.
  std::int64_t unit_ = kMicrometresPerMillimetre;
};

}  // namespace

void add_transform(std::string& text) {
  const std::size_t begin = text.find('{');
  const std::size_t end = text.rfind('}') + 1;
  RawNode root(std::string_view(text).substr(begin, end - begin));
  const std::string_view vertices = root.value_of("vertices");
  if (!RawNode::is_array(vertices)) return;
  const Regridder regridder(vertices);
  root.set("vertices", regridder.vertices_text());
  root.set("transform", regridder.transform_text());
  std::string changed = root.text();
  text.replace(begin, end - begin, changed);
}

}  // namespace oriel::detail
