#include "interpret/detail/reads.h"

#include "kernel/model/detail/index.h"
#include "kernel/model/feature_table.h"

#include <algorithm>

namespace oriel::rules {

Reads find_reads(const Pack& pack) {
  Reads reads;
  const std::size_t built_in = relation_schema().size();
  reads.relations.resize(built_in + pack.relations.size(), false);
  for (const Expr& expr : pack.code) {
    if (is_quantifier(expr.op)) reads.relations[at(expr.index)] = true;
    if (expr.op == Op::facet_is) reads.host_kinds.at(at(expr.index)) = true;
    if (expr.op == Op::attribute && expr.type == Type::text) reads.texts.push_back(at(expr.index));
  }
  std::ranges::sort(reads.texts);
  reads.texts.erase(std::unique(reads.texts.begin(), reads.texts.end()), reads.texts.end());
  for (const GroupKind& kind : pack.groups) reads.relations[at(kind.by)] = true;
  // A relation stands behind the one that it narrows.
  for (std::size_t i = pack.relations.size(); i-- > 0;)
    if (reads.relations[built_in + i]) reads.relations[at(pack.relations[i].within)] = true;
  for (std::size_t i = 0; i < pack.words.size(); ++i) reads.words.emplace(pack.words[i], i);
  return reads;
}

}  // namespace oriel::rules
