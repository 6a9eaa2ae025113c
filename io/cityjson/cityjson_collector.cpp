#include "io/cityjson/cityjson_collector.h"

#include "io/cityjson/write/geometry_text.h"
#include "io/cityjson/write/vertex_pool.h"
#include "io/json/raw_json.h"
#include "io/levels/written_grid.h"
#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <type_traits>
#include <utility>

namespace oriel {

namespace {

constexpr double kCoarsest_m = 0.001;
/// A coordinate in whole numbers that no building has, and that 64 bits hold.
constexpr double kFarthest = 9e18;

template <class Number>
std::array<Number, 3> three_numbers(std::string_view array) {
  std::array<Number, 3> numbers{};
  std::size_t count = 0;
  for_each_element(array, [&](std::string_view number) {
    if (count == 3) return;
    // Reader also takes whole numbers that are written as 1.0 or 1e3.
    double value = 0;
    if (std::is_integral_v<Number> && number.find_first_of(".eE") == std::string_view::npos) {
      std::from_chars(number.data(), number.data() + number.size(), numbers[count++]);
      return;
    }
    std::from_chars(number.data(), number.data() + number.size(), value);
    if (std::is_integral_v<Number>) value = std::clamp(value, -kFarthest, kFarthest);
    numbers[count++] = static_cast<Number>(value);
  });
  return numbers;
}

/// How many powers of ten all numbers have, up to where the scale is kCoarsest_m.
int common_digits(const std::vector<std::array<std::int64_t, 3>>& vertices, double scale) {
  constexpr int kMost = 18;  // of 64 bits
  int digits = 0;
  std::int64_t factor = 10;
  const auto is_whole = [&](const auto& vertex) {
    return std::ranges::all_of(vertex, [&](std::int64_t x) { return x % factor == 0; });
  };
  // The factor allows for scales such as 1.0000001e-4.
  while (digits < kMost && scale < 0.5 * kCoarsest_m && std::ranges::all_of(vertices, is_whole)) {
    scale *= 10;
    if (++digits < kMost) factor *= 10;
  }
  return digits;
}

/// The text that a list of "appearance" has under `number`; empty if it has none.
std::string_view element_at(const std::vector<std::string_view>& list, std::size_t number) {
  return number < list.size() ? list[number] : std::string_view();
}

/// `number` of a list of `count`, as it is where that list begins at `first`; what is not there is
/// not there then either.
std::int64_t moved(std::size_t number, std::size_t count, std::size_t first) {
  return number < count ? static_cast<std::int64_t>(first + number)
                        : std::numeric_limits<std::int64_t>::max();
}

/// The elements of the list `key` of an "appearance", which may be absent.
std::vector<std::string_view> list_of(std::string_view appearance, std::string_view key) {
  if (!RawNode::is_object(appearance)) return {};
  return elements_of(RawNode(appearance).value_of(key));
}

/// The object of a text, without what stands around it.
std::string_view root_in(std::string_view text) {
  const std::size_t start = text.find('{');
  return text.substr(start, end_of_value(text, start) - start);
}

}  // namespace

std::int64_t CityJsonCollector::Parts::add(std::string_view text) {
  const auto [found, is_new] =
      number_of.try_emplace(std::string(text), static_cast<std::int64_t>(texts.size()));
  if (is_new) texts.emplace_back(text);
  return found->second;
}

void CityJsonCollector::begin(std::string_view header) {
  header_ = header;
  grid_ = grid_of(header);
  // Geometry templates may use what the header has, by number: doubles stay.
  const std::string_view appearance = RawNode(header).value_of("appearance");
  for (const auto& [key, parts] : {std::pair("materials", &materials_), {"textures", &textures_}})
    for (const std::string_view text : list_of(appearance, key)) {
      parts->number_of.try_emplace(std::string(text),
                                   static_cast<std::int64_t>(parts->texts.size()));
      parts->texts.emplace_back(text);
    }
  for (const std::string_view text : list_of(appearance, "vertices-texture"))
    places_.emplace_back(text);
}

std::string CityJsonCollector::object_text(std::string_view object, std::size_t vertex_count,
                                           std::string_view appearance) {
  const std::size_t first_vertex = vertices_.size();
  std::string text = detail::with_vertex_numbers(
      object, [&](std::size_t number) { return moved(number, vertex_count, first_vertex); });
  if (appearance.empty()) return text;
  const auto materials = list_of(appearance, "materials"),
             textures = list_of(appearance, "textures");
  const std::size_t place_count = list_of(appearance, "vertices-texture").size();
  return detail::with_appearance_numbers(
      text, {[&](std::size_t n) { return materials_.add(element_at(materials, n)); },
             [&](std::size_t n) { return textures_.add(element_at(textures, n)); },
             [&](std::size_t n) { return moved(n, place_count, places_.size()); }});
}

std::optional<std::string> CityJsonCollector::add(std::string_view line) {
  if (line.empty()) return std::nullopt;
  const bool is_header = header_.empty();
  if (is_header) begin(line);
  return add_objects(line, is_header ? std::string_view() : RawNode(line).value_of("appearance"));
}

std::optional<std::string> CityJsonCollector::twin_in(std::string_view text) const {
  const RawNode objects(RawNode(root_in(text)).value_of("CityObjects"));
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (std::string id = objects.key(i); ids_.contains(id)) return id;
  return std::nullopt;
}

std::optional<std::string> CityJsonCollector::add_file(std::string_view text) {
  const std::string_view file = root_in(text);
  if (header_.empty()) return add(file);
  drop_extent();
  const Grid grid = grid_of(file);
  if (!origin_ && grid != grid_) go_to_micrometres();
  grid_ = grid;
  return add(file);
}

CityJsonCollector::Grid CityJsonCollector::grid_of(std::string_view file) {
  const std::string_view text = RawNode(file).value_of("transform");
  if (!RawNode::is_object(text)) return {};
  const RawNode transform(text);
  const auto [a, b, c] = three_numbers<double>(transform.value_of("scale"));
  const auto [x, y, z] = three_numbers<double>(transform.value_of("translate"));
  return {{a, b, c}, {x, y, z}};
}

/// The extent that the first file gives is not that of all.
void CityJsonCollector::drop_extent() {
  if (std::exchange(is_of_several_, true)) return;
  RawNode file(header_);
  const std::string_view there = file.value_of("metadata");
  if (!RawNode::is_object(there)) return;
  RawNode metadata(there);
  metadata.erase("geographicalExtent");
  file.set("metadata", metadata.text());
  header_ = file.text();
}

/// All files have their places in it, wherever their own grids begin.
void CityJsonCollector::go_to_micrometres() {
  const MicrometrePoint origin = grid_point({0, 0, 0}, grid_.scale, grid_.translate);
  origin_ = origin;
  for (Triple& vertex : vertices_) vertex = placed(vertex);
  constexpr double kMicrometre_m = 1e-6;  // the unit of the grid, no tolerance
  const Vec3 from = metres_of(origin);
  std::string scale, translate;
  append_json_array(scale, std::array{kMicrometre_m, kMicrometre_m, kMicrometre_m});
  append_json_array(translate, std::array{from.x, from.y, from.z});
  RawNode transform("{}");
  transform.set("scale", std::move(scale));
  transform.set("translate", std::move(translate));
  RawNode file(header_);
  file.set("transform", transform.text());
  header_ = file.text();
}

CityJsonCollector::Triple CityJsonCollector::placed(const Triple& vertex) const {
  if (!origin_) return vertex;
  const MicrometrePoint point = grid_point(vertex, grid_.scale, grid_.translate);
  return {point[0] - (*origin_)[0], point[1] - (*origin_)[1], point[2] - (*origin_)[2]};
}

std::optional<std::string> CityJsonCollector::add_objects(std::string_view line,
                                                          std::string_view appearance) {
  if (auto twin = twin_in(line)) return twin;
  const RawNode feature(line);
  const RawNode objects(feature.value_of("CityObjects"));
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < objects.size(); ++i) ids.push_back(objects.key(i));
  std::vector<Triple> vertices;
  for_each_element(feature.value_of("vertices"), [&](std::string_view vertex) {
    vertices.push_back(placed(three_numbers<std::int64_t>(vertex)));
  });
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!objects_.empty()) objects_ += ',';
    append_json(objects_, std::string_view(ids[i]));
    objects_ += ':' + object_text(objects.value(i), vertices.size(), appearance);
  }
  ids_.insert(ids.begin(), ids.end());
  for (const std::string_view place : list_of(appearance, "vertices-texture"))
    places_.emplace_back(place);
  vertices_.insert(vertices_.end(), vertices.begin(), vertices.end());
  return std::nullopt;
}

std::string CityJsonCollector::appearance_text(std::string_view header) const {
  RawNode appearance(RawNode::is_object(header) ? header : "{}");
  const auto set = [&](std::string_view key, const std::vector<std::string>& texts) {
    if (texts.empty()) return;
    std::string list = "[";
    for (const std::string& text : texts) {
      if (list.size() > 1) list += ',';
      list += text.empty() ? "{}" : text;
    }
    appearance.set(key, list + ']');
  };
  set("materials", materials_.texts);
  set("textures", textures_.texts);
  set("vertices-texture", places_);
  return appearance.text();
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
  append_json_array(scale_text, scale);
  transform.set("scale", std::move(scale_text));
  file.set("transform", transform.text());
  const std::string appearance = appearance_text(file.value_of("appearance"));
  if (appearance != "{}") file.set("appearance", appearance);
  file.set("CityObjects", "{" + objects_ + "}");
  std::string vertices = "[";
  for (const auto& [x, y, z] : vertices_) {
    if (vertices.size() > 1) vertices += ',';
    append_json_array(vertices, std::array{x / factor, y / factor, z / factor});
  }
  file.set("vertices", vertices + "]");
  return file.text() + "\n";
}

}  // namespace oriel
