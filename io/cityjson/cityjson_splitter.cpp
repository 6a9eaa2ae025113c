#include "io/cityjson/cityjson_splitter.h"

#include "io/cityjson/cityjson_objects.h"
#include "io/cityjson/cityjson_source.h"
#include "io/cityjson/write/fresh_cityjson.h"
#include "io/cityjson/write/geometry_text.h"
#include "io/json/raw_json.h"
#include "kernel/base/text/json_text.h"

#include <array>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <simdjson.h>

namespace oriel {

namespace {

/// `text` without the line breaks that stand between JSON values.
std::string on_one_line(std::string text) {
  if (text.find_first_of("\r\n") == std::string::npos) return text;
  std::string line(text.size() + simdjson::SIMDJSON_PADDING, '\0');
  std::size_t size = 0;
  if (simdjson::minify(text.data(), text.size(), line.data(), size) != simdjson::SUCCESS)
    return text;
  line.resize(size);
  return line;
}

/// Elements of one of the file's lists that a feature uses, in the order of their first use.
class Extract {
 public:
  explicit Extract(const std::vector<std::string_view>& all) : all_(all) {}

  /// The feature's number of the file's element `number`. One that the file does not have stays as
  /// it is: it is no good in the feature either, which has fewer elements.
  std::int64_t operator()(std::size_t number) {
    if (number >= all_.size()) return static_cast<std::int64_t>(number);
    const auto [found, is_new] =
        number_of_.try_emplace(number, static_cast<std::int64_t>(used_.size()));
    if (is_new) used_.push_back(number);
    return found->second;
  }
  [[nodiscard]] bool is_empty() const { return used_.empty(); }
  void append_to(std::string& text) const {
    text += '[';
    for (const std::size_t number : used_) {
      if (text.back() != '[') text += ',';
      text += all_[number];
    }
    text += ']';
  }

 private:
  const std::vector<std::string_view>& all_;
  std::vector<std::size_t> used_;
  std::unordered_map<std::size_t, std::int64_t> number_of_;
};

constexpr std::array<std::string_view, 3> kLists{"materials", "textures", "vertices-texture"};

}  // namespace

struct CityJsonSplitter::State {
  explicit State(const Document& document)
      : source(document.source ? document.source
                               : std::make_shared<const CityJsonSource>(
                                     detail::fresh_cityjson(document.buildings))),
        root(root_text()),
        objects(root.value_of("CityObjects")),
        vertices(elements_of(root.value_of("vertices"))) {
    const std::string_view appearance = root.value_of("appearance");
    if (RawNode::is_object(appearance)) {
      const RawNode node(appearance);
      for (std::size_t i = 0; i < kLists.size(); ++i)
        lists[i] = elements_of(node.value_of(kLists[i]));
      has_appearance = true;
    }
    list_features();
  }

  [[nodiscard]] std::string_view root_text() const {
    const std::string_view text = source->text;
    const std::size_t start = text.find('{');
    return text.substr(start, end_of_value(text, start) - start);
  }
  void list_features();
  [[nodiscard]] std::string objects_text(std::size_t i, Extract& corners,
                                         std::array<Extract, 3>& used) const;

  std::shared_ptr<const CityJsonSource> source;
  RawNode root;
  RawNode objects;
  std::vector<std::string_view> vertices;
  bool has_appearance = false;
  std::array<std::vector<std::string_view>, kLists.size()> lists;  ///< as kLists
  struct CityFeature {
    std::size_t root = 0;
    std::vector<std::size_t> members;
  };
  std::vector<CityFeature> features;
};

void CityJsonSplitter::State::list_features() {
  std::vector<std::string> ids;
  std::vector<std::vector<std::string>> relatives(objects.size());
  std::vector<bool> has_parents(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    ids.push_back(objects.key(i));
    if (!RawNode::is_object(objects.value(i))) continue;
    const RawNode object(objects.value(i));
    for (const std::string_view key : {"parents", "children"})
      for (const std::string_view id : elements_of(object.value_of(key))) {
        relatives[i].push_back(decoded(id));
        if (key == "parents") has_parents[i] = true;
      }
  }
  std::vector<detail::Relative> members;
  for (std::size_t i = 0; i < ids.size(); ++i)
    members.push_back({ids[i], {relatives[i].begin(), relatives[i].end()}});
  const auto family_of = detail::families_of(members);
  std::unordered_map<std::size_t, std::size_t> feature_of;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto [found, is_new] = feature_of.try_emplace(family_of[i], features.size());
    if (is_new) features.push_back({i, {}});
    CityFeature& feature = features[found->second];
    // The feature is named by its first object without parents.
    if (has_parents[feature.root] && !has_parents[i]) feature.root = i;
    feature.members.push_back(i);
  }
}

std::string CityJsonSplitter::State::objects_text(std::size_t i, Extract& corners,
                                                  std::array<Extract, 3>& used) const {
  std::string text = "{";
  for (const std::size_t member : features[i].members) {
    append_json_key(text, objects.key(member));
    const std::string_view object = objects.value(member);
    if (!has_appearance) {
      text += detail::with_vertex_numbers(object, std::ref(corners));
      continue;
    }
    const std::string renumbered = detail::with_appearance_numbers(
        object, {std::ref(used[0]), std::ref(used[1]), std::ref(used[2])});
    text += detail::with_vertex_numbers(renumbered, std::ref(corners));
  }
  return text + '}';
}

CityJsonSplitter::CityJsonSplitter(const Document& document)
    : state_(std::make_unique<State>(document)) {}

CityJsonSplitter::~CityJsonSplitter() = default;

std::size_t CityJsonSplitter::size() const { return state_->features.size(); }

std::vector<std::string> CityJsonSplitter::ids(std::size_t i) const {
  const State::CityFeature& feature = state_->features[i];
  std::vector<std::string> ids{state_->objects.key(feature.root)};
  for (const std::size_t member : feature.members)
    if (member != feature.root) ids.push_back(state_->objects.key(member));
  return ids;
}

std::string CityJsonSplitter::type(std::size_t i) const {
  const std::string_view object = state_->objects.value(state_->features[i].root);
  if (!RawNode::is_object(object)) return {};
  const std::string type(RawNode(object).value_of("type"));
  return type.starts_with('"') ? decoded(type) : std::string();
}

std::string CityJsonSplitter::header() const {
  RawNode header(state_->root_text());
  header.set("CityObjects", "{}");
  header.set("vertices", "[]");
  if (state_->has_appearance && !header.find("geometry-templates")) {
    RawNode appearance(header.value_of("appearance"));
    for (const std::string_view list : kLists) appearance.erase(list);
    const std::string left = appearance.text();
    if (left.find('"') == std::string::npos)
      header.erase("appearance");
    else
      header.set("appearance", left);
  }
  return on_one_line(header.text()) + '\n';
}

std::string CityJsonSplitter::feature(std::size_t i) const {
  const State& state = *state_;
  Extract corners(state.vertices);
  std::array<Extract, 3> used{Extract(state.lists[0]), Extract(state.lists[1]),
                              Extract(state.lists[2])};
  const std::string objects = state.objects_text(i, corners, used);
  std::string line = R"({"type":"CityJSONFeature",)";
  line += R"("id":)";
  append_json(line, std::string_view(state.objects.key(state.features[i].root)));
  line += R"(,"CityObjects":)" + objects + R"(,"vertices":)";
  corners.append_to(line);
  if (!used[0].is_empty() || !used[1].is_empty()) {
    line += R"(,"appearance":{)";
    for (std::size_t list = 0; list < kLists.size(); ++list) {
      if (used[list].is_empty()) continue;
      append_json_key(line, kLists[list]);
      used[list].append_to(line);
    }
    line += '}';
  }
  return on_one_line(line + '}') + '\n';
}

}  // namespace oriel
