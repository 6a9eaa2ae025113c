#include "interpret/compile/emitted.h"

#include "interpret/pack/names.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// A rule for the class stands in this pack, or the class and a rule for it beneath.
bool is_given_here(const Pack& pack, ClassId id) {
  const auto is_here = [&](SourceSpan span) { return pack.source.is_in_first(span.begin); };
  const bool is_own_class = is_here(pack.classes[static_cast<std::size_t>(id)].span);
  return std::ranges::any_of(pack.rules, [&](const Rule& rule) {
    return rule.label == id && (is_own_class || is_here(rule.span));
  });
}

}  // namespace

bool is_label_emitted(const Pack& pack, std::string_view label) {
  return role_of(pack, label).emission != nullptr;
}

std::string advice_to_emit(std::string_view label) {
  return fmt::format("the class has no 'emit'; add emit: {{{}: {{type: BuildingInstallation}}}}",
                     label);
}

void check_emitted(const Pack& pack, Findings& findings) {
  for (ClassId id = 0; id < static_cast<ClassId>(pack.classes.size()); ++id) {
    const Class& c = pack.classes[static_cast<std::size_t>(id)];
    if (c.is_abstract || !is_given_here(pack, id) || is_label_emitted(pack, c.name)) continue;
    findings.note(Code::R258, c.span,
                  fmt::format("a feature with the label '{}' is written to files of buildings "
                              "without a type, {}: {}",
                              c.name, kGenericForms, advice_to_emit(c.name)));
  }
}

}  // namespace oriel::rules
