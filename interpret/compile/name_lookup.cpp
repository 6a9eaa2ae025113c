#include "interpret/compile/name_lookup.h"

#include "interpret/language/synonyms.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>

namespace oriel::rules {

const std::vector<std::string>& host_kinds() {
  static const std::vector<std::string> kinds = {"wall", "roof", "ground"};
  return kinds;
}

namespace {

/// No more names than this are listed where one is unknown.
constexpr std::size_t kMostNamesListed = 12;

/// "; the params are a, b, c", or what is to be done if there are none.
std::string list_of(std::string_view what, const std::vector<std::string>& names,
                    const std::string& if_none) {
  if (names.empty()) return "; " + if_none;
  const std::size_t count = std::min(names.size(), kMostNamesListed);
  const std::vector<std::string> first(names.begin(),
                                       names.begin() + static_cast<std::ptrdiff_t>(count));
  return fmt::format("; the {} {}: {}{}", what, names.size() > count ? "include" : "are",
                     join(first), names.size() > count ? ", ..." : "");
}

/// The attribute whose values have this word ("hole"), or null.
const AttributeInfo* attribute_with_word(std::string_view word) {
  for (const AttributeInfo& attribute : feature_schema())
    if (contains(attribute.words, word)) return &attribute;
  return nullptr;
}

}  // namespace

std::optional<int> NameLookup::param(const Syntax& syntax) {
  const int index = index_of(pack_->params, syntax.name);
  if (index >= 0) {
    names_->is_param_used[static_cast<std::size_t>(index)] = true;
    return index;
  }
  if (contains(names_->broken_params, syntax.name) || names_->unread.contains("params"))
    return std::nullopt;
  const bool is_other = find_attribute(syntax.name) || index_of(names_->macros, syntax.name) >= 0;
  if (is_other) {
    findings_->error(Code::R206, syntax.span,
                     fmt::format("'{}' is {} and not a param; write it without '$'", syntax.name,
                                 find_attribute(syntax.name) ? "an attribute" : "a macro"));
    return std::nullopt;
  }
  const auto params = names_of(pack_->params);
  std::string advice = did_you_mean(syntax.name, params);
  if (advice.empty())
    advice = list_of(
        "params", params,
        fmt::format("the pack has none: write 'params: {{{}: {{value: ...}}}}'", syntax.name));
  findings_->error(Code::R206, syntax.span,
                   fmt::format("unknown param '{}'{}", syntax.name, advice));
  return std::nullopt;
}

ClassId NameLookup::class_of(const Syntax& syntax) {
  const std::string& name = syntax.name;
  if (const int id = index_of(pack_->classes, name); id >= 0) return id;
  if (!syntax.is_of_host && contains(host_kinds(), name)) {
    findings_->error(Code::R205, syntax.name_span,
                     fmt::format("'{}' is a kind of host facet: write 'host is {}'", name, name));
    return kNoClass;
  }
  const AttributeInfo* attribute = syntax.is_of_host ? nullptr : attribute_with_word(name);
  if (attribute != nullptr) {
    findings_->error(Code::R205, syntax.name_span,
                     fmt::format("'{}' is not a class but a word of '{}': write '{} = {}'", name,
                                 attribute->name, attribute->name, name));
    return kNoClass;
  }
  auto candidates = names_of(pack_->classes);
  if (syntax.is_of_host)
    candidates.insert(candidates.end(), host_kinds().begin(), host_kinds().end());
  report_class(name, syntax.name_span, candidates);
  return kNoClass;
}

ClassId NameLookup::class_of(const std::string& name, SourceSpan where) {
  if (const int id = index_of(pack_->classes, name); id >= 0) return id;
  report_class(name, where, names_of(pack_->classes));
  return kNoClass;
}

void NameLookup::report_class(const std::string& name, SourceSpan where,
                              const std::vector<std::string>& candidates) {
  if (names_->unread.contains("classes")) return;
  std::string advice = did_you_mean(name, candidates);
  if (const std::string normal = normal_name(name); normal != name && contains(candidates, normal))
    advice = fmt::format("; did you mean '{}'?", normal);
  if (advice.empty()) {
    if (!names_->missing_classes.insert(name).second) return;
    advice = candidates.empty()
                 ? fmt::format("; the pack has no classes: write 'classes: {{{}: {{}}}}'", name)
                 : list_of("classes", candidates, "") +
                       fmt::format("; a new one is a line '{}: {{}}' under 'classes'", name);
  }
  findings_->error(Code::R205, where, fmt::format("unknown class '{}'{}", name, advice));
}

std::optional<int> NameLookup::relation(const Syntax& syntax) {
  const int relation = relation_number(*pack_, syntax.relation);
  if (relation >= 0) {
    names_->used_relations.insert(relation);
    return relation;
  }
  report_relation(syntax.relation, syntax.relation_span);
  return std::nullopt;
}

void NameLookup::report_relation(const std::string& name, SourceSpan where) {
  if (contains(names_->broken_relations, name) || names_->unread.contains("relations")) return;
  if (index_of(pack_->classes, name) >= 0)
    return findings_->error(Code::R207, where,
                            fmt::format("'{}' is a class and not a relation; write 'contains where "
                                        "is {}', or another relation in place of contains",
                                        name, name));
  const auto relations = relation_names(*pack_);
  findings_->error(Code::R207, where,
                   unknown_name(NameKind::relation, "relation", name, relations,
                                list_of("relations", relations, "")));
}

/// What else the pack calls by this name: a param without its $, a class; else nothing.
std::string NameLookup::other_meaning(const std::string& name) const {
  const auto params = names_of(pack_->params);
  if (contains(params, name)) return fmt::format("'{}' is a param; write '${}'", name, name);
  if (index_of(pack_->classes, name) >= 0)
    return fmt::format("'{}' is a class; write 'self is {}'", name, name);
  if (relation_number(*pack_, name) >= 0)
    return fmt::format("'{}' is a relation; write 'exists({})'", name, name);
  if (const AttributeInfo* attribute = attribute_with_word(name))
    return fmt::format("'{}' is a word of '{}'; write '{} = {}'", name, attribute->name,
                       attribute->name, name);
  if (contains(host_kinds(), name))
    return fmt::format("'{}' is a kind of host facet; write 'host is {}'", name, name);
  return "";
}

void NameLookup::report_unknown(const Syntax& syntax, const std::vector<AttributeInfo>& schema) {
  if (names_->unread.contains("macros")) return;
  const std::string& name = syntax.name;
  if (const std::string other = other_meaning(name); !other.empty())
    return findings_->error(Code::R204, syntax.name_span, other);
  const auto macros = names_of(names_->macros);
  std::vector<std::string> candidates = names_of(schema);
  candidates.insert(candidates.end(), macros.begin(), macros.end());
  const auto params = names_of(pack_->params);
  const std::string near = nearest(name, candidates);
  const std::string near_param = near.empty() ? nearest(name, params) : "";
  const bool is_macro = contains(macros, near);
  const bool is_of_features = &schema == &feature_schema();
  const std::string otherwise = near_param.empty()
                                    ? fmt::format("; 'oriel rules attributes' lists those of {}",
                                                  is_of_features ? "features" : "surfaces")
                                    : fmt::format("; did you mean the param '${}'?", near_param);
  findings_->error(is_macro ? Code::R208 : Code::R204, syntax.name_span,
                   unknown_name(is_of_features ? NameKind::attribute : NameKind::surface_attribute,
                                is_macro ? "macro" : "attribute", name, candidates, otherwise));
}

}  // namespace oriel::rules
