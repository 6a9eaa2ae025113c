#include "interpret/pack/names.h"

#include <algorithm>

namespace oriel::rules {

namespace {

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_name_character(char c) { return is_lower(c) || (c >= '0' && c <= '9') || c == '_'; }

}  // namespace

int relation_number(const Pack& pack, std::string_view name) {
  const int declared = index_of(pack.relations, name);
  if (declared >= 0) return declared + static_cast<int>(relation_schema().size());
  return index_of(relation_schema(), name);
}

std::vector<std::string> relation_names(const Pack& pack) {
  std::vector<std::string> names = rules::names_of(relation_schema());
  for (const RelationDefinition& relation : pack.relations) names.push_back(relation.name);
  return names;
}

bool is_identifier(std::string_view text) {
  return !text.empty() && is_lower(text.front()) && std::ranges::all_of(text, is_name_character);
}

bool is_rule_id(std::string_view text) {
  while (true) {
    const std::size_t dot = text.find('.');
    if (!is_identifier(text.substr(0, dot))) return false;
    if (dot == std::string_view::npos) return true;
    text.remove_prefix(dot + 1);
  }
}

Role role_of(const Pack& pack, std::string_view label) {
  if (label.empty()) return {};
  for (ClassId id = index_of(pack.classes, label); id != kNoClass;
       id = pack.classes[static_cast<std::size_t>(id)].parent) {
    const Class& c = pack.classes[static_cast<std::size_t>(id)];
    if (c.emission)
      return {&*c.emission, c.name, c.name == label ? std::string() : std::string(label)};
  }
  return {};
}

}  // namespace oriel::rules
