#include "interpret/compile/name_lookup.h"

#include "interpret/language/suggest.h"

#include <fmt/format.h>

namespace oriel::rules {

const std::vector<std::string>& host_kinds() {
  static const std::vector<std::string> kinds = {"wall", "roof", "ground"};
  return kinds;
}

std::optional<int> NameLookup::param(const Syntax& syntax) {
  const int index = index_of(pack_->params, syntax.name);
  if (index >= 0) {
    names_->is_param_used[static_cast<std::size_t>(index)] = true;
    return index;
  }
  if (!contains(names_->broken_params, syntax.name))
    findings_->error(Code::R206, syntax.span,
                     fmt::format("unknown param '{}'{}", syntax.name,
                                 did_you_mean(syntax.name, names_of(pack_->params))));
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
  auto candidates = names_of(pack_->classes);
  if (syntax.is_of_host)
    candidates.insert(candidates.end(), host_kinds().begin(), host_kinds().end());
  findings_->error(Code::R205, syntax.name_span,
                   fmt::format("unknown class '{}'{}", name, did_you_mean(name, candidates)));
  return kNoClass;
}

std::optional<int> NameLookup::relation(const Syntax& syntax) {
  const int relation = relation_number(*pack_, syntax.relation);
  if (relation >= 0) {
    names_->used_relations.insert(relation);
    return relation;
  }
  if (!contains(names_->broken_relations, syntax.relation))
    findings_->error(Code::R207, syntax.relation_span,
                     fmt::format("unknown relation '{}'{}", syntax.relation,
                                 did_you_mean(syntax.relation, relation_names(*pack_))));
  return std::nullopt;
}

void NameLookup::report_unknown(const Syntax& syntax, const std::vector<AttributeInfo>& schema) {
  const auto macros = names_of(names_->macros);
  std::vector<std::string> candidates = names_of(schema);
  candidates.insert(candidates.end(), macros.begin(), macros.end());
  const std::string near = nearest(syntax.name, candidates);
  const bool is_macro = contains(macros, near);
  findings_->error(is_macro ? Code::R208 : Code::R204, syntax.name_span,
                   fmt::format("unknown {} '{}'{}", is_macro ? "macro" : "attribute", syntax.name,
                               did_you_mean(syntax.name, candidates)));
}

}  // namespace oriel::rules
