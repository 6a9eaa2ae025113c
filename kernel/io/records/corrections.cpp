#include "kernel/io/records/corrections.h"

#include "kernel/io/files/input.h"
#include "kernel/io/json/json_check.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace oriel {

namespace {

/// A text; empty where the member is absent. `fault` says what is wrong with it.
std::string text_member(const nlohmann::json& object, const char* key, bool is_needed,
                        std::optional<std::string>& fault) {
  const auto found = object.find(key);
  const bool is_there = found != object.end() && !found->is_null();
  if (is_there && found->is_string() && (!is_needed || !found->get<std::string>().empty()))
    return found->get<std::string>();
  if (!fault && is_there) fault = fmt::format("'{}' must be a text", key);
  if (!fault && is_needed) fault = fmt::format("a correction needs '{}'", key);
  return {};
}

std::optional<Vec3> point_member(const nlohmann::json& object, std::optional<std::string>& fault) {
  const auto found = object.find("point");
  if (found == object.end() || found->is_null()) return std::nullopt;
  const bool is_point =
      found->is_array() && found->size() == 3 &&
      std::ranges::all_of(*found, [](const nlohmann::json& value) { return value.is_number(); });
  if (is_point)
    return Vec3{(*found)[0].get<double>(), (*found)[1].get<double>(), (*found)[2].get<double>()};
  if (!fault) fault = "'point' must be three numbers: x, y, z in the input's coordinates";
  return std::nullopt;
}

std::optional<std::string> read_correction(const nlohmann::json& object, Correction& correction) {
  if (!object.is_object())
    return fmt::format("a correction is {}, not an object", object.type_name());
  std::optional<std::string> fault;
  correction.building = text_member(object, "building", true, fault);
  correction.label = text_member(object, "class", true, fault);
  if (correction.label == "unknown") correction.label.clear();
  correction.feature = text_member(object, "feature", false, fault);
  correction.point = point_member(object, fault);
  correction.by = text_member(object, "by", false, fault);
  correction.why = text_member(object, "why", false, fault);
  if (!fault && correction.feature.empty() && !correction.point)
    fault = "a correction needs 'feature', an id, or 'point', a place on the feature";
  return fault;
}

}  // namespace

Checked<std::vector<Correction>> read_corrections(const std::string& path) {
  Checked<std::vector<Correction>> result;
  std::vector<Correction>& corrections = result.value.emplace();
  const std::string text = detail::Input(path).read_all();
  std::string_view rest = detail::without_bom(text);
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const detail::TextName name{path, number};
    const auto object = detail::parse_slowly(name, line, result.issues);
    if (!object) continue;
    Correction correction;
    if (const auto fault = read_correction(*object, correction)) {
      result.issues.push_back(detail::error_in(name, {Code::E152, *fault}));
      continue;
    }
    correction.place.file = path;
    correction.place.line = number;
    corrections.push_back(std::move(correction));
  }
  return result;
}

}  // namespace oriel
