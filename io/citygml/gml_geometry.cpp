#include "io/citygml/gml_geometry.h"

#include "io/json/rings.h"
#include "io/json/words.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

constexpr double kPerMetre = 1e6;

template <std::size_t n>
bool is_one_of(std::string_view name, const std::array<std::string_view, n>& names) {
  return std::ranges::find(names, name) != names.end();
}

bool is_solid(const XmlNode& node) {
  return is_one_of<3>(node.name, {"Solid", "MultiSolid", "CompositeSolid"});
}

bool is_polygon(const XmlNode& node) {
  return is_one_of<4>(node.name, {"Polygon", "PolygonPatch", "Triangle", "Rectangle"});
}

/// True for elements that are made of surfaces by way of their properties.
bool holds_surfaces(const XmlNode& node) {
  return is_one_of<13>(
      node.name, {"MultiSurface", "CompositeSurface", "OrientableSurface", "Surface",
                  "PolyhedralSurface", "TriangulatedSurface", "Tin", "Shell", "Solid", "MultiSolid",
                  "CompositeSolid", "MultiGeometry", "GeometricComplex"});
}

/// True for elements without area, which a MultiGeometry may hold beside surfaces.
bool has_no_area(const XmlNode& node) {
  return is_one_of<7>(node.name, {"Point", "MultiPoint", "LineString", "Curve", "MultiCurve",
                                  "CompositeCurve", "OrientableCurve"});
}

/// True for properties that hold polygons: surfaceMember(s), patches, exterior, solidMember….
bool is_part(const XmlNode& property) {
  return is_one_of<15>(
      property.name,
      {"surfaceMember", "surfaceMembers", "patches", "polygonPatches", "trianglePatches",
       "baseSurface", "exterior", "interior", "solidMember", "solidMembers", "geometryMember",
       "geometryMembers", "element", "surfaceProperty", "solidProperty"});
}

/// True for what has a value to visit: a part, or a geometry that stands there without it.
bool has_part(const XmlNode& child) {
  return is_part(child) || is_polygon(child) || holds_surfaces(child);
}

/// The words of coordinates, separated by white space or, in gml:coordinates, by commas.
template <class Visit>
bool for_each_word(std::string_view text, std::string_view separators, const Visit& visit) {
  std::size_t at = text.find_first_not_of(separators);
  while (at < text.size()) {
    const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
    if (!visit(text.substr(at, end - at))) return false;
    at = text.find_first_not_of(separators, end);
  }
  return true;
}

}  // namespace

Vec3 first_position(const XmlNode& node) {
  if (node.name == "posList" || node.name == "pos" || node.name == "coordinates") {
    std::vector<double> numbers;
    for_each_word(node.text, ", \t\r\n", [&](std::string_view word) {
      const auto number = as_double(word);
      if (number && std::abs(*number) <= kMaxCoordinate_m) numbers.push_back(std::floor(*number));
      return number && numbers.size() < 3;
    });
    if (numbers.size() == 3) return {numbers[0], numbers[1], numbers[2]};
  }
  for (const XmlNode& child : node.children)
    if (const Vec3 found = first_position(child); found != Vec3{}) return found;
  return {};
}

std::size_t GmlVertices::Hash::operator()(const Position& position) const noexcept {
  std::uint64_t hash = 0;
  for (const std::int64_t value : position)
    hash = (hash ^ static_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15ULL;
  return hash ^ (hash >> 32U);
}

int GmlVertices::add(Vec3 point) {
  const Vec3 from = point - origin_;
  const Position position{std::llround(from.x * kPerMetre), std::llround(from.y * kPerMetre),
                          std::llround(from.z * kPerMetre)};
  const auto [found, is_new] =
      number_of_.try_emplace(position, static_cast<int>(positions_.size()));
  if (is_new) positions_.push_back(position);
  return found->second;
}

bool GmlReader::fail(const XmlNode& node, Code code, std::string sentence) {
  if (!fault_) fault_ = {{code, std::move(sentence)}, &node};
  return false;
}

bool GmlReader::may_visit(const XmlNode& property, const XmlNode& value) {
  if (++visited_ > XmlLinks::kVisits * links_.node_count())
    fault_ = XmlLinks::too_many(property);
  else if (depth_ > XmlLinks::kMaxDepth)
    fault_ = XmlLinks::too_deep(property);
  else if (followed_.contains(&value))
    fail(property, Code::E212,
         fmt::format("the link {} is part of a cycle", in_quotes(property.attribute("href"))));
  return !fault_;
}

template <class Visit>
bool GmlReader::for_each_value(const XmlNode& property, const Visit& visit) {
  const bool is_value = is_polygon(property) || holds_surfaces(property);
  const std::vector<const XmlNode*> values =
      is_value ? std::vector<const XmlNode*>{&property} : links_.values_of(property);
  fault_ = links_.fault();
  const bool is_link = !is_value && property.children.empty();
  ++depth_;
  for (std::size_t i = 0; i < values.size() && !fault_; ++i) {
    if (holds_boundary(*values[i])) continue;
    if (!may_visit(property, *values[i])) break;
    if (is_link) followed_.insert(values[i]);
    if (is_part(*values[i]))
      for_each_value(*values[i], visit);
    else
      visit(*values[i]);
    if (is_link) followed_.erase(values[i]);
  }
  --depth_;
  return !fault_;
}

std::vector<GmlGeometry> GmlReader::read(const XmlNode& property) {
  GmlGeometry solids;
  GmlGeometry surfaces;
  const bool is_good = for_each_value(property, [&](const XmlNode& value) {
    if (value.name.ends_with("Solid")) {
      const bool is_first = solids.type.empty();
      solids.type = is_first && value.name == "CompositeSolid" ? "CompositeSolid"
                    : is_first && value.name == "Solid"        ? "Solid"
                                                               : "MultiSolid";
      return read_solids(value, {}, solids.bodies);
    }
    surfaces.type = "MultiSurface";
    surfaces.bodies.resize(1, Body(1));
    return read_surfaces(value, {}, surfaces.bodies[0][0]);
  });
  std::vector<GmlGeometry> geometries;
  for (GmlGeometry* geometry : {&solids, &surfaces})
    if (is_good && !geometry->bodies.empty()) geometries.push_back(std::move(*geometry));
  return geometries;
}

std::vector<GmlPolygon> GmlReader::read_polygons(const XmlNode& property) {
  GmlShell shell;
  for_each_value(property, [&](const XmlNode& value) { return read_surfaces(value, {}, shell); });
  return shell;
}

bool GmlReader::read_solids(const XmlNode& node, Context context, Bodies& bodies) {
  if (const auto own = as_whole(node.attribute("srsDimension")))
    context.dimension = static_cast<int>(*own);
  if (!is_solid(node))
    return fail(node, Code::E204,
                fmt::format("a solid is {}; expected Solid, MultiSolid or "
                            "CompositeSolid",
                            in_quotes(node.name)));
  std::vector<GmlShell> shells;
  for (const XmlNode& property : node.children) {
    if (!has_part(property)) continue;
    const bool is_good = for_each_value(property, [&](const XmlNode& value) {
      if (node.name != "Solid") return read_solids(value, context, bodies);
      shells.emplace_back();
      return read_surfaces(value, context, shells.back());
    });
    if (!is_good) return false;
  }
  if (node.name == "Solid") bodies.push_back(std::move(shells));
  return true;
}

bool GmlReader::read_surfaces(const XmlNode& node, Context context, GmlShell& shell) {
  if (const auto own = as_whole(node.attribute("srsDimension")))
    context.dimension = static_cast<int>(*own);
  if (is_polygon(node)) return read_polygon(node, context, shell);
  if (has_no_area(node)) return true;
  if (!holds_surfaces(node))
    return fail(node, Code::E204,
                fmt::format("a surface is {}; expected a Polygon or a geometry of "
                            "polygons",
                            in_quotes(node.name)));
  if (node.attribute("orientation") == "-") context.is_turned = !context.is_turned;
  for (const XmlNode& property : node.children)
    if (has_part(property) && !for_each_value(property, [&](const XmlNode& value) {
          return read_surfaces(value, context, shell);
        }))
      return false;
  return true;
}

bool GmlReader::read_polygon(const XmlNode& node, Context context, GmlShell& shell) {
  const auto [found, is_new] = rings_of_.try_emplace(&node);
  if (is_new && !read_rings(node, context, found->second)) return false;
  GmlPolygon polygon{&node, found->second};
  if (context.is_turned)
    for (auto& ring : polygon.rings) std::ranges::reverse(ring);
  shell.push_back(std::move(polygon));
  return true;
}

bool GmlReader::read_rings(const XmlNode& node, Context context,
                           std::vector<std::vector<int>>& rings) {
  std::vector<std::vector<int>> holes;
  for (const XmlNode& property : node.children) {
    const bool is_outer = property.name == "exterior" || property.name == "outerBoundaryIs";
    if (!is_outer && property.name != "interior" && property.name != "innerBoundaryIs") continue;
    for (const XmlNode& ring : property.children)
      if (!read_ring(ring, context, (is_outer ? rings : holes).emplace_back())) return false;
  }
  if (rings.size() != 1)
    return fail(node, Code::E201,
                fmt::format("a {} has {}; expected one", node.name,
                            counted(rings.size(), "exterior ring")));
  std::ranges::move(holes, std::back_inserter(rings));
  return true;
}

bool GmlReader::read_ring(const XmlNode& ring, Context context, std::vector<int>& vertices) {
  if (ring.name != "LinearRing")
    return fail(ring, Code::E204,
                fmt::format("a ring is {}; expected a LinearRing", in_quotes(ring.name)));
  if (const auto own = as_whole(ring.attribute("srsDimension")))
    context.dimension = static_cast<int>(*own);
  for (const XmlNode& child : ring.children)
    if (!read_positions(child, context, vertices)) return false;
  if (vertices.empty()) return fail(ring, Code::E210, "a ring has no coordinates");
  if (vertices.size() > 1 && vertices.front() == vertices.back())
    vertices.pop_back();
  else if (open_ring_ == nullptr)
    open_ring_ = &ring;
  return true;
}

bool GmlReader::read_positions(const XmlNode& node, Context context, std::vector<int>& vertices) {
  if (node.name == "pointProperty" || node.name == "pointRep")
    return for_each_value(node, [&](const XmlNode& point) {
      return std::ranges::all_of(point.children, [&](const XmlNode& child) {
        return read_positions(child, context, vertices);
      });
    });
  const bool is_list = node.name == "posList";
  const bool has_commas = node.name == "coordinates";
  if (!is_list && !has_commas && node.name != "pos") return true;
  if (const auto own = as_whole(node.attribute("srsDimension")))
    context.dimension = static_cast<int>(*own);
  if (context.dimension != 3)
    return fail(node, Code::E210,
                fmt::format("coordinates of {} (srsDimension); expected 3",
                            counted(context.dimension, "dimension")));
  std::vector<double> numbers;
  const bool are_numbers =
      for_each_word(node.text, has_commas ? ", \t\r\n" : " \t\r\n", [&](std::string_view word) {
        const auto number = as_double(word);
        if (!number)
          return fail(node, Code::E210,
                      fmt::format("the coordinate {} is not a number", in_quotes(word)));
        if (!(std::abs(*number) <= kMaxCoordinate_m))
          return fail(node, Code::E506,
                      fmt::format("a coordinate is {}; expected a finite number of "
                                  "at most 1e9",
                                  in_quotes(word)));
        numbers.push_back(*number);
        return true;
      });
  if (!are_numbers) return false;
  if (numbers.empty() || numbers.size() % 3 != 0 || (node.name == "pos" && numbers.size() != 3))
    return fail(node, Code::E210,
                fmt::format("a {} of {}; expected {}", node.name, counted(numbers.size(), "number"),
                            node.name == "pos" ? "three" : "three per point"));
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    vertices.push_back(vertices_.add({numbers[i], numbers[i + 1], numbers[i + 2]}));
  return true;
}

}  // namespace oriel::detail
