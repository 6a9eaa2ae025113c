#include "io/cityjson/lod_name.h"

#include "io/json/raw_json.h"
#include "io/json/words.h"
#include "kernel/base/text/json_text.h"

#include <cmath>

namespace oriel::detail {

std::string lod_name(std::string_view lod) {
  if (lod.starts_with('"')) return decoded(lod);
  if (const auto whole = as_whole(lod)) return std::to_string(*whole);
  const auto number = as_double(lod);
  if (!number) return {};
  return shortest(*number) + (*number == std::floor(*number) ? ".0" : "");
}

std::string lod_text(std::string_view name, std::string_view like) {
  const bool is_number = !like.empty() && !like.starts_with('"') && as_double(name).has_value();
  if (is_number) return std::string(name);
  std::string text;
  append_json(text, name);
  return text;
}

}  // namespace oriel::detail
