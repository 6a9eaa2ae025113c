#include "kernel/io/cityjson/lod_name.h"

#include "kernel/io/json/json_text.h"
#include "kernel/io/json/raw_json.h"
#include "kernel/io/json/words.h"

#include <cmath>

namespace oriel::detail {

namespace {

std::string name_of_number(double lod) {
  const bool is_whole = lod == std::floor(lod);
  return shortest(lod) + (is_whole ? ".0" : "");
}

}  // namespace

std::string lod_name(dom::element lod) {
  if (const auto text = as_string(lod)) return std::string(*text);
  if (const auto whole = as_integer(lod)) return std::to_string(*whole);
  const auto number = as_number(lod);
  return number ? name_of_number(*number) : std::string();
}

std::string lod_name(std::string_view lod) {
  if (lod.starts_with('"')) return decoded(lod);
  if (const auto whole = as_whole(lod)) return std::to_string(*whole);
  const auto number = as_double(lod);
  return number ? name_of_number(*number) : std::string();
}

std::string lod_text(std::string_view name, std::string_view like) {
  const bool is_number = !like.empty() && !like.starts_with('"') && as_double(name).has_value();
  if (is_number) return std::string(name);
  std::string text;
  append_json(text, name);
  return text;
}

}  // namespace oriel::detail
