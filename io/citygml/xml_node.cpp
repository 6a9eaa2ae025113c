#include "io/citygml/xml_node.h"

#include "io/citygml/write/xml_text.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

bool says_object_id(const XmlNode& node) {
  if (node.name == "genericAttribute") return std::ranges::any_of(node.children, says_object_id);
  if (node.vocabulary != Vocabulary::generics) return false;
  return node.attribute("name") == kObjectId ||
         std::ranges::any_of(node.children, [](const XmlNode& child) {
           return child.name == "name" && trimmed(child.text) == kObjectId;
         });
}

}  // namespace

std::string object_id(const XmlNode& node) {
  const bool is_escaped = std::ranges::any_of(node.children, says_object_id);
  return is_escaped ? xml_id_source(node.id()) : std::string(node.id());
}

NodeFault XmlLinks::too_deep(const XmlNode& property) {
  return {{Code::E503,
           fmt::format("{} is nested deeper than {} properties, counting those behind links",
                       property.name, kMaxDepth)},
          &property};
}

NodeFault XmlLinks::too_many(const XmlNode& property) {
  return {{Code::E212, "links to links repeat the building's elements too often"}, &property};
}

XmlLinks::XmlLinks(const XmlNode& member) { add(member); }

void XmlLinks::add(const XmlNode& node) {
  ++count_;
  if (const std::string_view id = node.id(); !id.empty()) {
    const auto [found, is_new] = target_of_.try_emplace(id, Target{&node, false});
    if (!is_new) found->second.is_twice = true;
    if (!is_new && duplicate_ == nullptr) duplicate_ = &node;
  }
  for (const XmlNode& child : node.children) add(child);
}

std::vector<const XmlNode*> XmlLinks::values_of(const XmlNode& property) {
  std::vector<const XmlNode*> values;
  for (const XmlNode& child : property.children) values.push_back(&child);
  const std::string_view href = property.attribute("href");
  if (!values.empty() || href.empty()) return values;
  const auto found = href.starts_with('#') ? target_of_.find(href.substr(1)) : target_of_.end();
  if (found == target_of_.end())
    fault_ = {
        {Code::E211, fmt::format("the link {} of {} leads out of the building; expected '#' and "
                                 "a gml:id in it",
                                 in_quotes(href), property.name)},
        &property};
  else if (found->second.is_twice)
    fault_ = {{Code::E207, fmt::format("the link {} of {} names a gml:id that occurs twice",
                                       in_quotes(href), property.name)},
              &property};
  else
    values.push_back(found->second.node);
  return values;
}

}  // namespace oriel::detail
