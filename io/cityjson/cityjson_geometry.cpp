#include "io/cityjson/cityjson_geometry.h"

#include "io/json/rings.h"
#include "kernel/base/index.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

std::string_view found_kind(const std::optional<dom::element>& element) {
  if (!element) return "nothing";
  switch (element->type()) {
    case dom::element_type::OBJECT:
      return "an object";
    case dom::element_type::ARRAY:
      return "an array";
    case dom::element_type::STRING:
      return "a string";
    case dom::element_type::BOOL:
      return "true or false";
    case dom::element_type::NULL_VALUE:
      return "null";
    default:
      return "a number";
  }
}

std::optional<GeometryKind> kind_of_geometry(std::string_view type) {
  constexpr std::array kKinds{
      GeometryKind{0, false, false, "MultiSurface"},
      GeometryKind{0, false, true, "CompositeSurface"}, GeometryKind{1, true, false, "Solid"},
      GeometryKind{2, true, false, "MultiSolid"}, GeometryKind{2, true, true, "CompositeSolid"}};
  const auto* found = std::ranges::find(kKinds, type, &GeometryKind::name);
  if (found == kKinds.end()) return std::nullopt;
  return *found;
}

std::size_t number_of_array(dom::element element) {
  while (const auto array = as_array(element)) element = *array->begin();
  return static_cast<std::size_t>(*as_integer(element));
}

GeometryReader::GeometryReader(const std::vector<Vec3>& stored, const Transform& transform)
    : stored_(stored), transform_(transform), local_of_(stored.size(), -1) {}

void GeometryReader::use(const PlainArrays* plain, std::string_view text) {
  plain_ = plain;
  text_ = text;
}

std::optional<Fault> GeometryReader::read(dom::object geometry, GeometryKind kind,
                                          Building& building) {
  polygons_.clear();
  used_.clear();
  warnings_.clear();
  fault_.reset();
  repeats_.clear();
  without_outer_.clear();
  for (auto& level : ends_) level.clear();
  body_ = 0;
  shell_ = 0;
  const auto boundaries = member(geometry, "boundaries");
  if (!boundaries) {
    fail(Code::E201, "the geometry has no 'boundaries'");
  } else if (read_boundaries(*boundaries, kind) && place_vertices(building)) {
    building.is_solid = kind.is_solid;
    building.is_composite = kind.is_composite;
  }
  for (const std::size_t number : used_) local_of_[number] = -1;
  if (fault_) return fault_;
  building.repeats = std::move(repeats_);

  const auto semantics = member(geometry, "semantics");
  if (const auto object = as_object(semantics))
    read_hints(*object, kind);
  else if (semantics && !semantics->is_null())
    warnings_.push_back(
        {Code::E208, fmt::format("'semantics' is {}; expected an object, so none are "
                                 "read",
                                 found_kind(semantics))});
  if (!building.repeats.empty())
    warnings_.push_back({Code::E312,
                         "a ring names a vertex twice in a row; it is read once (val3dity 102 "
                         "CONSECUTIVE_POINTS_SAME)"});
  if (auto degenerate = find_degenerate(polygons_, building.vertices))
    warnings_.push_back(std::move(*degenerate));
  building.polygons = std::move(polygons_);
  return std::nullopt;
}

std::optional<Fault> GeometryReader::add(dom::object geometry, GeometryKind kind,
                                         Building& building) {
  const std::vector<std::size_t> own = used_;
  Building added;
  auto fault = read(geometry, kind, added);
  std::unordered_map<std::size_t, int> number_of;
  for (const std::size_t vertex : own)
    number_of.emplace(vertex, static_cast<int>(number_of.size()));
  std::vector<std::size_t> all = own;
  std::vector<int> renumbered;
  for (const std::size_t vertex : used_) {
    const auto [found, is_new] = number_of.emplace(vertex, static_cast<int>(all.size()));
    if (is_new) all.push_back(vertex);
    renumbered.push_back(found->second);
  }
  if (!fault) {
    used_ = std::move(all);
    fault = find_beyond_limits(points());
  }
  if (fault) {
    used_ = own;
    return fault;
  }
  append_vertices(building);
  const auto first = static_cast<int>(building.polygons.size());
  const int body = first > 0 ? building.polygons.back().body : 0;
  for (Polygon& polygon : added.polygons) {
    for (auto& ring : polygon.rings)
      for (int& vertex : ring) vertex = renumbered[at(vertex)];
    polygon.source += first;
    polygon.body = body;
    building.polygons.push_back(std::move(polygon));
  }
  for (const RepeatedVertex& repeat : added.repeats)
    building.repeats.push_back(
        {repeat.polygon + first, repeat.ring, renumbered[at(repeat.vertex)]});
  return std::nullopt;
}

bool GeometryReader::fail(Code code, std::string sentence) {
  fault_ = {code, std::move(sentence)};
  return false;
}

bool GeometryReader::read_boundaries(dom::element boundaries, GeometryKind kind) {
  if (plain_ == nullptr) return read_bodies(boundaries, kind);
  const std::size_t array = number_of_array(boundaries);
  const NestedNumbers& nested = plain_->boundaries(array);
  // Arrays of surfaces, of rings and of numbers are below those that the kind says.
  if (nested.depth == kind.depth + 3) return read_plain(nested);
  const auto [begin, end] = plain_->place(array);
  return read_bodies(parser_.parse(text_.data() + begin, end - begin), kind);
}

bool GeometryReader::read_plain(const NestedNumbers& nested) {
  const auto& [rings, surfaces, shells, bodies, all] = nested.ends;
  ends_ = {shells, bodies};
  polygons_.reserve(surfaces.size());
  std::size_t ring = 0, shell = 0;
  for (const int end : surfaces) {
    const int number = static_cast<int>(polygons_.size());
    if (number == shells[shell]) {
      ++shell;
      ++shell_;
      if (static_cast<int>(shell) == bodies[at(body_)]) {
        ++body_;
        shell_ = 0;
      }
    }
    begin_polygon().rings.reserve(at(end) - ring);
    for (; ring < at(end); ++ring) {
      const std::size_t first = ring > 0 ? at(rings[ring - 1]) : 0;
      std::vector<int> vertices(at(rings[ring]) - first);
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        vertices[i] = local_vertex(nested.numbers[first + i]);
        if (vertices[i] < 0) return false;
      }
      append_ring(std::move(vertices));
    }
  }
  return true;
}

bool GeometryReader::read_bodies(dom::element boundaries, GeometryKind kind) {
  if (kind.depth == 0) {
    if (!read_surfaces(boundaries)) return false;
  } else if (kind.depth == 1) {
    if (!read_shells(boundaries)) return false;
  } else {
    const auto bodies = as_array(boundaries);
    if (!bodies)
      return fail(Code::E202, fmt::format("'boundaries' is {}; expected an array of solids",
                                          found_kind(boundaries)));
    for (const dom::element body : *bodies) {
      if (!read_shells(body)) return false;
      ++body_;
    }
  }
  if (polygons_.empty())
    return fail(Code::E313, "the geometry has no polygon (val3dity 902 EMPTY_PRIMITIVE)");
  std::ptrdiff_t empty = 0;
  for (const std::vector<int>& ends : ends_)
    for (std::size_t i = 0; i < ends.size(); ++i) empty += ends[i] == (i > 0 ? ends[i - 1] : 0);
  if (empty > 0)
    warnings_.push_back(
        {Code::E313, fmt::format("{} no polygon (val3dity 902 EMPTY_PRIMITIVE)",
                                 counted(empty, "shell or solid has", "shells or solids have"))});
  if (!without_outer_.empty())
    warnings_.push_back(
        {Code::E201,
         fmt::format("{} no exterior ring, the first is polygon {}; nothing of {} is read",
                     counted(without_outer_.size(), "polygon has", "polygons have"),
                     without_outer_[0], agreeing(without_outer_.size(), "it", "them"))});
  return true;
}

bool GeometryReader::read_shells(dom::element body) {
  const auto shells = as_array(body);
  if (!shells)
    return fail(Code::E202,
                fmt::format("a solid is {}; expected an array of shells", found_kind(body)));
  shell_ = 0;
  for (const dom::element shell : *shells) {
    if (!read_surfaces(shell)) return false;
    ++shell_;
  }
  ends_[1].push_back(static_cast<int>(ends_[0].size()));
  return true;
}

bool GeometryReader::read_surfaces(dom::element shell) {
  const auto surfaces = as_array(shell);
  if (!surfaces)
    return fail(Code::E202, fmt::format("a list of surfaces is {}; expected an array of surfaces",
                                        found_kind(shell)));
  for (const dom::element surface : *surfaces) {
    const std::size_t number = polygons_.size();
    const auto rings = as_array(surface);
    if (!rings)
      return fail(Code::E202, fmt::format("polygon {} is {}; expected an array of rings", number,
                                          found_kind(surface)));
    Polygon& polygon = begin_polygon();
    for (const dom::element ring : *rings) {
      // Holes need an outer ring around them.
      if (!polygon.rings.empty() && polygon.rings[0].empty()) break;
      if (!read_ring(ring)) return false;
    }
    if (polygon.rings.empty()) append_ring({});
    if (polygon.rings[0].empty() && rings->size() != 1) without_outer_.push_back(polygon.source);
  }
  ends_[0].push_back(static_cast<int>(polygons_.size()));
  return true;
}

bool GeometryReader::read_ring(dom::element element) {
  const std::size_t polygon = polygons_.size() - 1;
  const auto numbers = as_array(element);
  if (!numbers)
    return fail(Code::E202, fmt::format("a ring of polygon {} is {}; expected an array of vertex "
                                        "numbers",
                                        polygon, found_kind(element)));
  std::vector<int> ring;
  ring.reserve(numbers->size());
  for (const dom::element value : *numbers) {
    const auto number = as_integer(value);
    if (!number)
      return fail(Code::E202, fmt::format("a ring of polygon {} holds {}; expected a whole number",
                                          polygon, found_kind(value)));
    const int vertex = local_vertex(*number);
    if (vertex < 0) return false;
    ring.push_back(vertex);
  }
  append_ring(std::move(ring));
  return true;
}

/// -1 if there is none; then fault_ says why.
inline int GeometryReader::local_vertex(std::int64_t number) {
  const auto index = static_cast<std::uint64_t>(number);
  if (index < local_of_.size() && local_of_[index] >= 0) return local_of_[index];
  return new_vertex(number);
}

int GeometryReader::new_vertex(std::int64_t number) {
  const std::size_t polygon = polygons_.size() - 1;
  if (number < 0 || static_cast<std::size_t>(number) >= stored_.size()) {
    fail(Code::E203, fmt::format("polygon {} uses vertex {}; there {} {}, counted from 0", polygon,
                                 number, agreeing(stored_.size(), "is", "are"),
                                 counted(stored_.size(), "vertex", "vertices")));
    return -1;
  }
  const auto index = static_cast<std::size_t>(number);
  if (std::isnan(stored_[index].x)) {
    fail(Code::E202, fmt::format("polygon {} uses vertex {}, which is not an array of three whole "
                                 "numbers",
                                 polygon, index));
    return -1;
  }
  local_of_[index] = static_cast<int>(used_.size());
  used_.push_back(index);
  return local_of_[index];
}

Polygon& GeometryReader::begin_polygon() {
  Polygon& polygon = polygons_.emplace_back();
  polygon.source = static_cast<int>(polygons_.size()) - 1;
  polygon.body = body_;
  polygon.shell = shell_;
  return polygon;
}

void GeometryReader::append_ring(std::vector<int> ring) {
  auto& rings = polygons_.back().rings;
  rings.push_back(without_repeats(std::move(ring), static_cast<int>(polygons_.size()) - 1,
                                  static_cast<int>(rings.size()), repeats_));
}

std::vector<Vec3> GeometryReader::points() const {
  const Vec3 scale = transform_.scale;
  std::vector<Vec3> points;
  points.reserve(used_.size());
  for (const std::size_t number : used_) {
    const Vec3 v = stored_[number];
    points.push_back(transform_.translate + Vec3{scale.x * v.x, scale.y * v.y, scale.z * v.z});
  }
  return points;
}

bool GeometryReader::place_vertices(Building& building) {
  const std::vector<Vec3> points = this->points();
  fault_ = find_beyond_limits(points);
  if (fault_) return false;
  building.frame = frame_of(points, std::move(building.frame.crs));
  building.vertices.clear();
  append_vertices(building);
  return true;
}

/// Those that `building` does not have yet, in its frame.
void GeometryReader::append_vertices(Building& building) const {
  const Vec3 scale = transform_.scale;
  const Vec3 shift = transform_.translate - building.frame.origin_m;
  building.vertices.reserve(used_.size());
  for (std::size_t i = building.vertices.size(); i < used_.size(); ++i) {
    const Vec3 v = stored_[used_[i]];
    building.vertices.push_back(shift + Vec3{scale.x * v.x, scale.y * v.y, scale.z * v.z});
  }
}

void GeometryReader::read_hints(dom::object semantics, GeometryKind kind) {
  std::vector<std::string_view> types;
  const auto surfaces = as_array(member(semantics, "surfaces"));
  if (surfaces)
    for (const dom::element surface : *surfaces) {
      const auto object = as_object(surface);
      const auto type = object ? as_string(member(*object, "type")) : std::nullopt;
      types.push_back(type.value_or(std::string_view()));
    }
  const std::size_t count = kind.depth > 0 ? ends_[at(kind.depth) - 1].size() : polygons_.size();
  const bool fits = flatten(0, count, member(semantics, "values"), kind.depth, types);
  if (!surfaces || !fits)
    warnings_.push_back({Code::E208,
                         "the semantics do not fit the geometry: 'values' must repeat the shape of "
                         "'boundaries' with numbers of 'surfaces' or null; what fits is read"});
}

/// The values of parts: polygons, above them shells, above them solids.
bool GeometryReader::flatten(std::size_t begin, std::size_t end,
                             const std::optional<dom::element>& values, int depth,
                             const std::vector<std::string_view>& types) {
  const auto entries = as_array(values);
  bool fits = entries || !values || values->is_null();
  std::optional<dom::array::iterator> entry;
  if (entries) entry = entries->begin();
  for (std::size_t part = begin; part < end; ++part) {
    std::optional<dom::element> value;
    if (entry && *entry != entries->end()) {
      value = **entry;
      ++*entry;
    } else if (entry) {
      fits = false;
    }
    if (depth > 0) {
      const std::vector<int>& ends = ends_[at(depth) - 1];
      const std::size_t first = part > 0 ? at(ends[part - 1]) : 0;
      fits = flatten(first, at(ends[part]), value, depth - 1, types) && fits;
      continue;
    }
    const auto number = as_integer(value);
    const bool is_known =
        number && *number >= 0 && static_cast<std::size_t>(*number) < types.size();
    if (is_known) polygons_[part].hint = types[static_cast<std::size_t>(*number)];
    fits = fits && (is_known || !value || value->is_null());
  }
  return fits && !(entry && *entry != entries->end());
}

}  // namespace oriel::detail
