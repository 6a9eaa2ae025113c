#include "io/cityjson/write/geometry_text.h"

#include "io/json/raw_json.h"
#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <charconv>
#include <set>

namespace oriel::detail {

namespace {

/// The loop in the file's vertices; empty if fewer than three of them are left.
std::vector<int> ring_of(const Loop& loop, std::span<const int> number_of) {
  std::vector<int> ring;
  for (const int vertex : loop) {
    const int number = number_of[static_cast<std::size_t>(vertex)];
    if (ring.empty() || ring.back() != number) ring.push_back(number);
  }
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  if (std::set<int>(ring.begin(), ring.end()).size() < 3) ring.clear();
  return ring;
}

std::string facet_text(const Facet& facet, std::span<const int> number_of) {
  std::string text = "[";
  for (const Loop& loop : facet.loops) {
    const std::vector<int> ring = ring_of(loop, number_of);
    if (ring.empty() && text.size() == 1) return "";
    if (ring.empty()) continue;
    if (text.size() > 1) text += ',';
    append_json_array(text, ring);
  }
  return text.size() > 1 ? text + "]" : "";
}

/// The shells of each lump, the outer one first.
std::vector<std::vector<const Shell*>> lumps_of(const Solid& solid) {
  std::vector<std::vector<const Shell*>> lumps;
  for (const Shell& shell : solid.shells) {
    const auto lump = static_cast<std::size_t>(shell.lump);
    if (lumps.size() <= lump) lumps.resize(lump + 1);
    lumps[lump].push_back(&shell);
  }
  for (auto& shells : lumps)
    std::ranges::stable_sort(shells, {}, [](const Shell* shell) { return shell->is_cavity; });
  return lumps;
}

/// True if the array holds nothing but whole numbers and arrays.
bool holds_numbers(std::string_view array) {
  return array.find_first_not_of("[]-0123456789, \t\r\n") == std::string_view::npos;
}

/// Appends the polygons of a shell. They are short, and without a string brackets need no more than
/// to be counted.
void append_polygons(std::string_view shell, std::vector<std::string_view>& polygons) {
  if (RawNode::is_array(shell) && shell.find('"') == std::string_view::npos &&
      shell.find('{') == std::string_view::npos)
    append_arrays_in(shell, polygons);
  else
    for_each_element(shell, [&](std::string_view polygon) { polygons.push_back(polygon); });
}

}  // namespace

GeometryText geometry_of(std::string_view boundaries, int depth, bool with_polygons) {
  GeometryText geometry;
  geometry.shape.depth = depth;
  const auto read_shell = [&](std::string_view shell) {
    const std::size_t before = geometry.polygons.size();
    append_polygons(shell, geometry.polygons);
    geometry.shape.counts.back().push_back(static_cast<int>(geometry.polygons.size() - before));
    if (!with_polygons) geometry.polygons.clear();
  };
  const auto read_body = [&](std::string_view body) {
    geometry.shape.counts.emplace_back();
    if (depth == 0)
      read_shell(body);
    else
      for_each_element(body, read_shell);
  };
  if (depth == 2)
    for_each_element(boundaries, read_body);
  else
    read_body(boundaries);
  return geometry;
}

SolidText solid_text(const Solid& solid, std::span<const int> number_of) {
  SolidText text;
  for (const Facet& facet : solid.facets) text.facets.push_back(facet_text(facet, number_of));
  const auto lumps = lumps_of(solid);
  text.shape.depth = lumps.size() > 1 ? 2 : 1;
  text.type = lumps.size() > 1 ? "MultiSolid" : "Solid";
  std::string bodies;
  for (const auto& shells : lumps) {
    text.shape.counts.emplace_back();
    bodies += bodies.empty() ? "[" : ",[";
    for (const Shell* shell : shells) {
      bodies += shell == shells.front() ? "[" : ",[";
      int count = 0;
      for (const FacetId id : shell->facets) {
        if (text.facets[id.index()].empty()) continue;
        if (count++ > 0) bodies += ',';
        bodies += text.facets[id.index()];
        text.order.push_back(id.value);
      }
      bodies += ']';
      text.shape.counts.back().push_back(count);
    }
    bodies += ']';
  }
  text.boundaries = lumps.size() > 1 ? "[" + bodies + "]" : bodies;
  return text;
}

void for_each_boundaries(std::string_view object,
                         const std::function<void(std::string_view)>& visit) {
  constexpr std::string_view kKey = "\"boundaries\"";
  if (!RawNode::is_object(object)) return;
  const RawNode node(object);
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string_view value = node.value(i);
    if (node.key(i) == "attributes") continue;
    for (std::size_t at = value.find(kKey); at < value.size(); at = value.find(kKey, at)) {
      at = value.find_first_not_of(" \t\r\n", at + kKey.size());
      if (at >= value.size() || value[at] != ':') continue;
      at = std::min(value.find_first_not_of(" \t\r\n", at + 1), value.size());
      const std::size_t end = end_of_value(value, at);
      const std::string_view array = value.substr(at, end - at);
      if (RawNode::is_array(array) && holds_numbers(array)) visit(array);
    }
  }
}

void for_each_number(std::string_view array,
                     const std::function<void(std::size_t, std::size_t, std::size_t)>& visit) {
  constexpr std::string_view kDigits = "-0123456789";
  for (std::size_t from = array.find_first_of(kDigits); from < array.size();) {
    const std::size_t to = std::min(array.find_first_not_of(kDigits, from), array.size());
    std::size_t number = 0;
    const auto error = std::from_chars(array.data() + from, array.data() + to, number).ec;
    if (error == std::errc()) visit(from, to, number);
    from = array.find_first_of(kDigits, to);
  }
}

std::string with_vertex_numbers(std::string_view object,
                                const std::function<std::int64_t(std::size_t)>& number_of) {
  std::string text;
  std::size_t copied = 0;
  for_each_boundaries(object, [&](std::string_view array) {
    const auto start = static_cast<std::size_t>(array.data() - object.data());
    for_each_number(array, [&](std::size_t from, std::size_t to, std::size_t number) {
      text += object.substr(copied, start + from - copied);
      append_json(text, number_of(number));
      copied = start + to;
    });
  });
  return text.append(object.substr(copied));
}

namespace {

/// `values` with each number exchanged; `number_of(number, is_first)` knows whether it is the first
/// of its array.
template <class NumberOf>
std::string exchanged(std::string_view values, const NumberOf& number_of) {
  std::string text;
  std::size_t copied = 0;
  for_each_number(values, [&](std::size_t from, std::size_t to, std::size_t number) {
    const std::size_t before =
        from == 0 ? std::string_view::npos : values.find_last_not_of(" \t\r\n", from - 1);
    const bool is_first = before != std::string_view::npos && values[before] == '[';
    text += values.substr(copied, from - copied);
    append_json(text, number_of(number, is_first));
    copied = to;
  });
  return text.append(values.substr(copied));
}

/// Exchanges the numbers of all themes of the member `key` of a geometry.
template <class NumberOf>
void exchange_themes(RawNode& geometry, std::string_view key, const NumberOf& number_of) {
  const std::string_view there = geometry.value_of(key);
  if (!RawNode::is_object(there)) return;
  RawNode themes(there);
  for (std::size_t i = 0; i < themes.size(); ++i) {
    if (!RawNode::is_object(themes.value(i))) continue;
    RawNode theme(themes.value(i));
    for (const std::string_view name : {"value", "values"})
      if (const auto member = theme.find(name))
        theme.set(*member, exchanged(theme.value(*member), number_of));
    themes.set(i, theme.text());
  }
  geometry.set(key, themes.text());
}

}  // namespace

std::string with_appearance_numbers(std::string_view object, const AppearanceNumbers& numbers) {
  if (!RawNode::is_object(object)) return std::string(object);
  RawNode node(object);
  const std::string_view there = node.value_of("geometry");
  if (!RawNode::is_array(there)) return std::string(object);
  RawNode geometries(there);
  for (std::size_t i = 0; i < geometries.size(); ++i) {
    if (!RawNode::is_object(geometries.value(i))) continue;
    RawNode geometry(geometries.value(i));
    exchange_themes(geometry, "material",
                    [&](std::size_t number, bool) { return numbers.material(number); });
    exchange_themes(geometry, "texture", [&](std::size_t number, bool is_first) {
      return is_first ? numbers.texture(number) : numbers.place(number);
    });
    geometries.set(i, geometry.text());
  }
  node.set("geometry", geometries.text());
  return node.text();
}

}  // namespace oriel::detail
