#include "io/records/corrections.h"

#include "io/files/input.h"
#include "io/json/json_check.h"
#include "io/records/member_reader.h"

#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

std::optional<std::string> read_correction(const nlohmann::json& object, Correction& correction) {
  if (!object.is_object())
    return fmt::format("a correction is {}, not an object", object.type_name());
  detail::MemberReader reader(object, "the correction");
  correction.building = reader.text("building", true);
  correction.label = reader.text("class", true);
  correction.feature = reader.text("feature", false);
  if (const auto point =
          reader.numbers<3>("point", false, "three numbers: x, y, z in the input's coordinates"))
    correction.point = Vec3{(*point)[0], (*point)[1], (*point)[2]};
  correction.by = reader.text("by", false);
  correction.why = reader.text("why", false);
  if (reader.fault()) return reader.fault();
  if (correction.building.empty()) return "'building' of the correction is empty";
  if (correction.label.empty()) return "'class' of the correction is empty";
  if (correction.label == "unknown") correction.label.clear();
  if (correction.feature.empty() && !correction.point)
    return "a correction needs 'feature', an id, or 'point', a place on the feature";
  return std::nullopt;
}

}  // namespace

Checked<std::vector<Correction>> read_corrections(const std::string& path) {
  return corrections_in(Input(path).read_all(), path);
}

Checked<std::vector<Correction>> corrections_in(std::string_view text, const std::string& path) {
  Checked<std::vector<Correction>> result;
  std::vector<Correction>& corrections = result.value.emplace();
  for_each_line(without_bom(text), [&](std::string_view line, int number) {
    const TextName name{path, number};
    const auto object = parse_slowly(name, line, result.issues);
    if (!object) return;
    Correction correction;
    if (const auto fault = read_correction(*object, correction)) {
      result.issues.push_back(error_in(name, {Code::E152, *fault}));
      return;
    }
    correction.place.file = path;
    correction.place.line = number;
    corrections.push_back(std::move(correction));
  });
  return result;
}

std::string corrections_text(std::span<const Correction> corrections) {
  std::string text;
  for (const Correction& correction : corrections) {
    nlohmann::ordered_json object{{"building", correction.building}};
    if (!correction.feature.empty()) object["feature"] = correction.feature;
    if (correction.point)
      object["point"] = {correction.point->x, correction.point->y, correction.point->z};
    object["class"] = correction.label.empty() ? "unknown" : correction.label;
    if (!correction.by.empty()) object["by"] = correction.by;
    if (!correction.why.empty()) object["why"] = correction.why;
    text += object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    text += '\n';
  }
  return text;
}

}  // namespace oriel
