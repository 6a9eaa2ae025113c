#include "kernel/io/cityjson/write/appearance_text.h"

#include "kernel/io/cityjson/write/geometry_text.h"
#include "kernel/io/json/json_text.h"
#include "kernel/io/json/raw_json.h"

namespace oriel::detail {

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
