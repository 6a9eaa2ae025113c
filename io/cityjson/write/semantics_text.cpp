#include "io/cityjson/write/semantics_text.h"

#include "io/json/raw_json.h"
#include "io/objects/label_members.h"
#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <variant>

namespace oriel::detail {

namespace {

/// The number that stands in "values", or -1 for null and whatever names no surface.
int surface_number(std::string_view text, int surfaces) {
  int number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number && number >= 0 && number < surfaces ? number : -1;
}

/// "values" as one number a polygon; null stands for all it contains.
std::vector<int> flat_values(std::string_view values, const GeometryShape& shape, int surfaces) {
  std::vector<int> flat;
  const auto part = [](const std::vector<std::string_view>& parts, std::size_t i) {
    return i < parts.size() ? parts[i] : std::string_view("null");
  };
  const std::vector<std::string_view> top = elements_of(values);
  for (std::size_t body = 0; body < shape.counts.size(); ++body) {
    const auto shells = shape.depth == 2 ? elements_of(part(top, body)) : top;
    for (std::size_t shell = 0; shell < shape.counts[body].size(); ++shell) {
      const auto polygons = shape.depth == 0 ? top : elements_of(part(shells, shell));
      for (int i = 0; i < shape.counts[body][shell]; ++i)
        flat.push_back(surface_number(part(polygons, static_cast<std::size_t>(i)), surfaces));
    }
  }
  return flat;
}

std::string nested_values(const std::vector<int>& flat, const GeometryShape& shape) {
  constexpr std::size_t kDigits = 4;
  std::string text;
  text.reserve(kDigits * flat.size());
  std::size_t next = 0;
  const char* body_separator = shape.depth == 2 ? "[" : "";
  for (const std::vector<int>& body : shape.counts) {
    text += body_separator;
    const char* shell_separator = shape.depth > 0 ? "[" : "";
    for (const int count : body) {
      text += shell_separator;
      text += '[';
      for (int i = 0; i < count; ++i, ++next) {
        if (i > 0) text += ',';
        if (flat[next] < 0)
          text += "null";
        else
          append_json(text, flat[next]);
      }
      text += ']';
      shell_separator = ",";
    }
    if (shape.depth > 0) text += body.empty() ? "[]" : "]";
    body_separator = ",";
  }
  if (shape.depth == 2) text += shape.counts.empty() ? "[]" : "]";
  return text;
}

/// The semantic surfaces of one geometry while ours are added.
class Filling {
 public:
  Filling(std::string_view existing, const GeometryShape& shape,
          const std::vector<SemanticSurface>& surfaces, bool is_kept)
      : shape_(shape),
        surfaces_(surfaces),
        is_kept_(is_kept),
        number_of_(surfaces.size(), -1),
        parent_of_(surfaces.size(), -1) {
    if (!RawNode::is_object(existing)) return;
    const RawNode semantics(existing);
    existing_ = elements_of(semantics.value_of("surfaces"));
    flat_ = flat_values(semantics.value_of("values"), shape, static_cast<int>(existing_.size()));
  }

  /// Gives ours to the polygons that have none, and the others the reasons of ours; false if no
  /// polygon takes one.
  bool fill(std::span<const int> wanted) {
    flat_.resize(polygon_count(), -1);
    const std::size_t count = std::min(wanted.size(), flat_.size());
    explain_kept(wanted.first(count));
    for (std::size_t i = 0; i < count; ++i) {
      if (flat_[i] >= 0 || !is_surface(wanted[i]) || number_of_[index(wanted[i])] == 0) continue;
      number_of_[index(wanted[i])] = 0;
      added_.push_back(index(wanted[i]));
    }
    if (!std::ranges::is_sorted(added_)) std::ranges::sort(added_);
    int next = static_cast<int>(existing_.size());
    for (const std::size_t s : added_) number_of_[s] = next++;
    link_parents(wanted.first(count));
    bool is_filled = !reasons_of_.empty();
    for (std::size_t i = 0; i < count; ++i)
      if (flat_[i] < 0 && is_surface(wanted[i])) {
        flat_[i] = number_of_[index(wanted[i])];
        is_filled = true;
      }
    return is_filled;
  }

  [[nodiscard]] std::string surfaces_text() const {
    constexpr std::size_t kUsual = 64;  // bytes of a surface
    std::string text;
    text.reserve(kUsual * (existing_.size() + added_.size()));
    text += '[';
    for (std::size_t i = 0; i < existing_.size(); ++i) {
      if (i > 0) text += ',';
      text += with_additions(i);
    }
    for (const std::size_t s : added_) {
      if (text.size() > 1) text += ',';
      append_surface(text, s);
    }
    text += ']';
    return text;
  }

  [[nodiscard]] std::string values_text() const { return nested_values(flat_, shape_); }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  [[nodiscard]] bool is_surface(int surface) const {
    return surface >= 0 && index(surface) < surfaces_.size();
  }

  [[nodiscard]] std::size_t polygon_count() const {
    std::size_t count = 0;
    for (const auto& body : shape_.counts)
      for (const int polygons : body) count += index(polygons);
    return count;
  }

  [[nodiscard]] bool is_opening(int number) const {
    const std::string_view text = existing_[index(number)];
    return RawNode::is_object(text) && is_opening_type(decoded(RawNode(text).value_of("type")));
  }

  /// What is there stays, and says what the rules would have said of its polygons.
  void explain_kept(std::span<const int> wanted) {
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (flat_[i] < 0 || !is_surface(wanted[i])) continue;
      const std::string_view there = existing_[index(flat_[i])];
      if (!RawNode::is_object(there) || RawNode(there).find(kWhyMember)) continue;
      const std::string& text = surfaces_[index(wanted[i])].label->why;
      if (text.empty()) continue;
      auto& reasons = reasons_of_[flat_[i]];
      if (std::ranges::find(reasons, text) == reasons.end()) reasons.push_back(text);
    }
  }

  /// "kept as WallSurface from the input; by the rules RoofSurface by roof.any: looks_up".
  [[nodiscard]] std::string reason_of_kept(std::string_view surface,
                                           const std::vector<std::string>& reasons) const {
    std::string text = "kept as ";
    text += decoded(RawNode(surface).value_of("type"));
    text += " from the input; by the rules ";
    for (const std::string& reason : reasons) {
      if (&reason != &reasons.front()) text += ", and of others of its polygons ";
      text += reason;
    }
    return text;
  }

  /// Finds for each surface that is added the number of its parent, which may be one that is there.
  void link_parents(std::span<const int> wanted) {
    std::vector<int> instead(surfaces_.size(), -1);
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (!is_kept_ && is_surface(wanted[i]) && flat_[i] >= 0 && instead[index(wanted[i])] < 0 &&
          !is_opening(flat_[i]))
        instead[index(wanted[i])] = flat_[i];
    for (const std::size_t s : added_) {
      const int parent = surfaces_[s].parent;
      if (!is_surface(parent)) continue;
      const int added = number_of_[index(parent)];
      const int number = added >= 0 ? added : instead[index(parent)];
      if (number < 0) continue;
      parent_of_[s] = number;
      children_of_[number].push_back(number_of_[s]);
    }
  }

  /// The text of a surface that is there, with the children and the reason it gains.
  [[nodiscard]] std::string with_additions(std::size_t number) const {
    const auto added = children_of_.find(static_cast<int>(number));
    const auto reasons = reasons_of_.find(static_cast<int>(number));
    const bool is_same = added == children_of_.end() && reasons == reasons_of_.end();
    if (is_same || !RawNode::is_object(existing_[number])) return std::string(existing_[number]);
    RawNode surface(existing_[number]);
    if (added != children_of_.end()) {
      const std::string_view listed = surface.value_of("children");
      RawNode children(RawNode::is_array(listed) ? listed : "[]");
      for (const int child : added->second) children.push_back(std::to_string(child));
      surface.set("children", children.text());
    }
    if (reasons != reasons_of_.end()) {
      std::string text;
      append_json(text, reason_of_kept(existing_[number], reasons->second));
      surface.append(kWhyMember, std::move(text));
    }
    return surface.text();
  }

  void append_surface(std::string& text, std::size_t s) const {
    text += R"({"type":)";
    append_json(text, surfaces_[s].type);
    if (parent_of_[s] >= 0) {
      text += R"(,"parent":)";
      append_json(text, parent_of_[s]);
    }
    if (const auto children = children_of_.find(number_of_[s]); children != children_of_.end()) {
      text += R"(,"children":)";
      append_json_array(text, children->second);
    }
    append_label(text, surfaces_[s].label);
    text += '}';
  }

  const GeometryShape& shape_;
  const std::vector<SemanticSurface>& surfaces_;
  bool is_kept_;
  std::vector<std::string_view> existing_;
  /// The surface of each polygon in the output's numbers, -1 for none.
  std::vector<int> flat_;
  /// Those of our surfaces that are added, ascending: an installation has few of a building's.
  std::vector<std::size_t> added_;
  /// The output's number of each of our surfaces, -1 if it is not added.
  std::vector<int> number_of_;
  /// The output's number of the parent of each of our surfaces, -1 for none.
  std::vector<int> parent_of_;
  std::map<int, std::vector<int>> children_of_;
  /// What the rules say of the polygons of a surface that stays, each once.
  std::map<int, std::vector<std::string>> reasons_of_;
};

}  // namespace

void append_label(std::string& out, const SharedLabel& label) {
  for_each_member(*label, [&](std::string_view name, const auto& value) {
    append_json_key(out, name);
    append_json(out, value);
  });
}

std::vector<int> surface_numbers(std::string_view semantics, const GeometryShape& shape) {
  const RawNode node(semantics);
  const auto count = static_cast<int>(elements_of(node.value_of("surfaces")).size());
  return flat_values(node.value_of("values"), shape, count);
}

std::string filled_semantics(std::string_view existing, const GeometryShape& shape,
                             std::span<const int> surface_of_polygon,
                             const std::vector<SemanticSurface>& surfaces, bool is_kept) {
  Filling filling(existing, shape, surfaces, is_kept);
  if (!filling.fill(surface_of_polygon)) return std::string(existing);
  RawNode semantics(RawNode::is_object(existing) ? existing : "{}");
  semantics.set("surfaces", filling.surfaces_text());
  semantics.set("values", filling.values_text());
  return semantics.text();
}

std::string carried_semantics(std::string_view existing, const GeometryShape& old_shape,
                              const GeometryShape& shape,
                              const std::vector<std::vector<int>>& sources) {
  if (!RawNode::is_object(existing)) return {};
  RawNode semantics(existing);
  const auto surfaces = elements_of(semantics.value_of("surfaces"));
  const std::vector<int> old =
      flat_values(semantics.value_of("values"), old_shape, static_cast<int>(surfaces.size()));
  std::vector<int> flat;
  for (const std::vector<int>& polygons : sources) {
    const auto value = [&](int p) { return old.at(static_cast<std::size_t>(p)); };
    const bool is_one = !polygons.empty() && std::ranges::all_of(polygons, [&](int p) {
      return value(p) == value(polygons.front());
    });
    flat.push_back(is_one ? value(polygons.front()) : -1);
  }
  semantics.set("values", nested_values(flat, shape));
  return semantics.text();
}

}  // namespace oriel::detail
