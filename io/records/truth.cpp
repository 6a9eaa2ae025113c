#include "io/records/truth.h"

#include "io/files/input.h"
#include "io/json/json_check.h"
#include "io/records/member_reader.h"

#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using nlohmann::json;

std::optional<Box> read_box(detail::MemberReader& reader, const char* key, bool is_needed) {
  const auto m = reader.numbers<6>(key, is_needed, "six numbers");
  if (!m) return std::nullopt;
  return Box{{(*m)[0], (*m)[1], (*m)[2]}, {(*m)[3], (*m)[4], (*m)[5]}};
}

std::optional<std::string> read_object(const json& value, std::size_t number, TruthObject& object) {
  if (!value.is_object()) return fmt::format("object {} is {}", number, value.type_name());
  detail::MemberReader reader(value, fmt::format("object {}", number));
  object.id = reader.text("id", true);
  object.label = reader.text("class", true);
  object.subclass = reader.text("subclass", false);
  object.aabb = read_box(reader, "aabb", true).value_or(Box{});
  object.feature_aabb = read_box(reader, "feature_aabb", false);
  object.faces = reader.whole_numbers("faces");
  object.is_detectable = reader.yes_no("detectable");
  return reader.fault();
}

std::optional<std::string> read_root(const json& root, GroundTruth& truth) {
  if (!root.is_object() || !root.contains("objects") || !root["objects"].is_array())
    return "expected an object with the array 'objects'";
  detail::MemberReader reader(root, "the file");
  truth.building = reader.text("building", true);
  truth.dataset = reader.text("dataset", false);
  truth.capped_faces = reader.whole_numbers("capped_faces");
  if (reader.fault()) return reader.fault();
  const json& objects = root["objects"];
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (auto fault = read_object(objects[i], i, truth.objects.emplace_back())) return fault;
  return std::nullopt;
}

Checked<GroundTruth> truth_of(const TextName& name, std::string_view text) {
  Checked<GroundTruth> result;
  const auto root = parse_slowly(name, text, result.issues);
  if (!root) return result;
  GroundTruth truth;
  if (const auto fault = read_root(*root, truth))
    result.issues.push_back(error_in(name, {Code::E112, *fault}));
  else
    result.value = std::move(truth);
  return result;
}

}  // namespace

Checked<GroundTruth> read_truth(const std::string& path) {
  const std::string text = Input(path).read_all();
  return truth_of({path, 0}, without_bom(text));
}

Checked<std::vector<GroundTruth>> read_truths(const std::string& path) {
  Checked<std::vector<GroundTruth>> result;
  const auto add = [&](Checked<GroundTruth> truth) {
    result.issues.insert(result.issues.end(), truth.issues.begin(), truth.issues.end());
    if (!truth.value) return;
    if (!result.value) result.value.emplace();
    result.value->push_back(std::move(*truth.value));
  };
  if (!path.ends_with(".jsonl")) {
    add(read_truth(path));
    return result;
  }
  const std::string text = Input(path).read_all();
  for_each_line(without_bom(text), [&](std::string_view line, int number) {
    add(truth_of({path, number}, line));
  });
  if (!result.value && result.issues.empty())
    result.issues.push_back(error_in({path, 0}, {Code::E102, "the file is empty"}));
  return result;
}

}  // namespace oriel
