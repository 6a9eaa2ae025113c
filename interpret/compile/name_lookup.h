#pragma once

#include "interpret/language/findings.h"
#include "interpret/language/parser.h"
#include "interpret/pack/names.h"
#include "interpret/pack/pack.h"
#include "model/description/feature_table.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::rules {

/// wall, roof, ground: by HostKind.
const std::vector<std::string>& host_kinds();

/// Finds what expressions name in a pack; what is not there is an error with a suggestion. Names
/// whose declaration is wrong are not reported again.
class NameLookup {
 public:
  NameLookup(const Pack& pack, Names& names, Findings& findings)
      : pack_(&pack), names_(&names), findings_(&findings) {}

  /// The index of the param, which counts as used; or nothing and R206.
  std::optional<int> param(const Syntax& syntax);
  /// The class, or kNoClass and R205.
  ClassId class_of(const Syntax& syntax);
  /// The same for a name that stands alone at `where`, as after `label:`.
  ClassId class_of(const std::string& name, SourceSpan where);
  /// The number of the relation, which counts as used; or nothing and R207.
  std::optional<int> relation(const Syntax& syntax);
  /// R204, or R208 if it is like the name of a macro.
  void report_unknown(const Syntax& syntax, const std::vector<AttributeInfo>& schema);
  /// R207 for a relation that there is not.
  void report_relation(const std::string& name, SourceSpan where);

 private:
  void report_class(const std::string& name, SourceSpan where,
                    const std::vector<std::string>& candidates);
  [[nodiscard]] std::string other_meaning(const std::string& name) const;

  const Pack* pack_;
  Names* names_;
  Findings* findings_;
};

}  // namespace oriel::rules
