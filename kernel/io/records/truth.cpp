#include "kernel/io/records/truth.h"

#include "kernel/io/files/input.h"
#include "kernel/io/json/json_check.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using nlohmann::json;

/// Reads the members of one object; the first that does not fit is kept as the finding.
class MemberReader {
 public:
  MemberReader(const json& object, std::string where) : object_(object), where_(std::move(where)) {}

  [[nodiscard]] const std::optional<std::string>& fault() const { return fault_; }

  /// A text; "" where it may be absent and is.
  std::string text(const char* key, bool is_needed) {
    const json* value = find(key, is_needed);
    if (value == nullptr) return "";
    if (value->is_string()) return value->get<std::string>();
    fail(key, "a text");
    return "";
  }

  std::vector<int> numbers(const char* key) {
    const json* value = find(key, false);
    std::vector<int> result;
    if (value == nullptr) return result;
    bool is_good = value->is_array();
    for (std::size_t i = 0; is_good && i < value->size(); ++i) {
      is_good = (*value)[i].is_number_integer();
      if (is_good) result.push_back((*value)[i].get<int>());
    }
    if (!is_good) fail(key, "an array of whole numbers");
    return result;
  }

  std::optional<Box> box(const char* key, bool is_needed) {
    const json* value = find(key, is_needed);
    if (value == nullptr) return std::nullopt;
    std::array<double, 6> m{};
    bool is_good = value->is_array() && value->size() == m.size();
    for (std::size_t i = 0; is_good && i < m.size(); ++i) {
      is_good = (*value)[i].is_number();
      if (is_good) m[i] = (*value)[i].get<double>();
    }
    if (!is_good) fail(key, "six numbers");
    return Box{{m[0], m[1], m[2]}, {m[3], m[4], m[5]}};
  }

  std::optional<bool> yes_no(const char* key) {
    const json* value = find(key, false);
    if (value == nullptr) return std::nullopt;
    if (value->is_boolean()) return value->get<bool>();
    fail(key, "true or false");
    return std::nullopt;
  }

 private:
  /// The member's value; null where it is absent or null.
  const json* find(const char* key, bool is_needed) {
    const auto found = object_.find(key);
    if (found != object_.end() && !found->is_null()) return &*found;
    if (is_needed && !fault_) fault_ = fmt::format("{} has no '{}'", where_, key);
    return nullptr;
  }

  void fail(const char* key, const char* expected) {
    if (!fault_) fault_ = fmt::format("'{}' of {} must be {}", key, where_, expected);
  }

  const json& object_;
  std::string where_;
  std::optional<std::string> fault_;
};

std::optional<std::string> read_object(const json& value, std::size_t number, TruthObject& object) {
  if (!value.is_object()) return fmt::format("object {} is {}", number, value.type_name());
  MemberReader reader(value, fmt::format("object {}", number));
  object.id = reader.text("id", true);
  object.label = reader.text("class", true);
  object.subclass = reader.text("subclass", false);
  object.aabb = reader.box("aabb", true).value_or(Box{});
  object.feature_aabb = reader.box("feature_aabb", false);
  object.faces = reader.numbers("faces");
  object.is_detectable = reader.yes_no("detectable");
  return reader.fault();
}

std::optional<std::string> read_root(const json& root, GroundTruth& truth) {
  if (!root.is_object() || !root.contains("objects") || !root["objects"].is_array())
    return "expected an object with the array 'objects'";
  MemberReader reader(root, "the file");
  truth.building = reader.text("building", true);
  truth.dataset = reader.text("dataset", false);
  truth.capped_faces = reader.numbers("capped_faces");
  if (reader.fault()) return reader.fault();
  const json& objects = root["objects"];
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (auto fault = read_object(objects[i], i, truth.objects.emplace_back())) return fault;
  return std::nullopt;
}

Checked<GroundTruth> truth_of(const detail::TextName& name, std::string_view text) {
  Checked<GroundTruth> result;
  const auto root = detail::parse_slowly(name, text, result.issues);
  if (!root) return result;
  GroundTruth truth;
  if (const auto fault = read_root(*root, truth))
    result.issues.push_back(detail::error_in(name, {Code::E112, *fault}));
  else
    result.value = std::move(truth);
  return result;
}

}  // namespace

Checked<GroundTruth> read_truth(const std::string& path) {
  const std::string text = detail::Input(path).read_all();
  return truth_of({path, 0}, detail::without_bom(text));
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
  const std::string text = detail::Input(path).read_all();
  std::string_view rest = detail::without_bom(text);
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view here = rest.substr(0, end);
    if (here.find_first_not_of(" \t\r") != std::string_view::npos)
      add(truth_of({path, line}, here));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (!result.value && result.issues.empty())
    result.issues.push_back(detail::error_in({path, 0}, {Code::E102, "the file is empty"}));
  return result;
}

}  // namespace oriel
