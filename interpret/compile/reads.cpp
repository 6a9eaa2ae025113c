#include "interpret/compile/reads.h"

#include "interpret/compile/counts.h"
#include "kernel/base/index.h"
#include "model/description/feature_table.h"

#include <algorithm>

namespace oriel::rules {

namespace {

void keep_each_once(std::vector<std::size_t>& columns) {
  std::ranges::sort(columns);
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
}

}  // namespace

Reads find_reads(const Pack& pack) {
  Reads reads;
  const std::size_t built_in = relation_schema().size();
  reads.relations.resize(built_in + pack.relations.size(), false);
  for (const Expr& expr : pack.code) {
    if (is_quantifier(expr.op)) reads.relations[at(expr.index)] = true;
    if (expr.op == Op::attribute || expr.op == Op::flag)
      (expr.type == Type::text ? reads.texts : reads.numbers).push_back(at(expr.index));
  }
  // Columns after the schema are of groups, which are known after labelling.
  std::erase_if(reads.numbers, [](std::size_t c) { return c >= kAttributes.size(); });
  keep_each_once(reads.texts);
  keep_each_once(reads.numbers);
  for (const GroupKind& kind : pack.groups) reads.relations[at(kind.by)] = true;
  for (const GeneraliseEntry& entry : pack.entries)
    if (entry.with >= 0) reads.relations[at(entry.with)] = true;
  for (const int relation : evidence_relations(pack)) reads.relations[at(relation)] = true;
  // A relation follows the one that it narrows.
  for (std::size_t i = pack.relations.size(); i-- > 0;)
    if (reads.relations[built_in + i]) reads.relations[at(pack.relations[i].within)] = true;
  for (std::size_t i = 0; i < pack.words.size(); ++i) reads.words.emplace(pack.words[i], i);
  return reads;
}

}  // namespace oriel::rules
