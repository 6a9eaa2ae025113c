#include "interpret/explain/feature_relations.h"

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/pack/names.h"
#include "interpret/pack/vocabulary.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// The pack as if its rules asked for all relations that it declares.
rules::Pack with_all_relations(rules::Pack pack) {
  for (const rules::Expr& expr : pack.code) {
    const bool is_read = expr.op == rules::Op::attribute || expr.op == rules::Op::flag;
    if (!is_read || at(expr.index) >= kAttributes.size()) continue;
    auto& columns = expr.type == rules::Type::text ? pack.reads.texts : pack.reads.numbers;
    if (std::ranges::find(columns, at(expr.index)) == columns.end())
      columns.push_back(at(expr.index));
  }
  pack.reads.relations.assign(pack.reads.relations.size(), true);
  return pack;
}

std::vector<FeatureId> certain_others(const rules::Links& links, FeatureId feature) {
  std::vector<FeatureId> others;
  if (links.lists == nullptr) return others;
  const auto [begin, end] = links.range_of(feature.value);
  for (std::size_t link = begin; link < end; ++link)
    if (links.other(link) != feature.value &&
        links.is_other(feature.value, link) == rules::Truth::yes)
      others.push_back(FeatureId{links.other(link)});
  return others;
}

}  // namespace

struct FeatureRelations::State {
  State(const RuleBase& base, const FeatureTable& features, const FeatureGraph& features_graph)
      : pack(base.pack()),
        names(rules::relation_names(pack)),
        table(&features),
        graph(&features_graph) {
    if (!pack.relations.empty())
      context.emplace(with_all_relations(pack), base.values(), features, features_graph);
  }

  [[nodiscard]] bool is_hidden(std::string_view built_in) const {
    return std::ranges::find(pack.relations, built_in, &rules::RelationDefinition::name) !=
           pack.relations.end();
  }

  [[nodiscard]] std::string meaning(const rules::RelationDefinition& relation) const {
    std::string within = names[at(relation.within)];
    std::ranges::replace(within, '_', ' ');
    return fmt::format("{} where {}", within,
                       pack.source.text_of(pack.code[at(relation.where)].span));
  }

  const rules::Pack& pack;
  std::vector<std::string> names;
  const FeatureTable* table;
  const FeatureGraph* graph;
  /// Nothing where the pack declares none.
  std::optional<rules::EvaluationContext> context;
};

FeatureRelations::FeatureRelations(const RuleBase& base, const FeatureTable& table,
                                   const FeatureGraph& graph)
    : state_(std::make_unique<State>(base, table, graph)) {}
FeatureRelations::~FeatureRelations() = default;
FeatureRelations::FeatureRelations(FeatureRelations&&) noexcept = default;
FeatureRelations& FeatureRelations::operator=(FeatureRelations&&) noexcept = default;

std::vector<RelatedFeatures> FeatureRelations::of(FeatureId feature) const {
  std::vector<RelatedFeatures> all;
  for (const VocabularyWord& word : relation_words()) {
    if (state_->is_hidden(word.name)) continue;
    auto others = state_->graph->others(word.name, feature);
    if (!others.empty())
      all.push_back({std::string(word.name), std::string(word.meaning), {}, std::move(others), {}});
  }
  const rules::Pack& pack = state_->pack;
  for (std::size_t i = 0; i < pack.relations.size(); ++i) {
    const rules::RelationDefinition& relation = pack.relations[i];
    auto others = certain_others(state_->context->relations[relation_schema().size() + i], feature);
    if (others.empty()) continue;
    all.push_back({relation.name,
                   state_->meaning(relation),
                   pack.source.place(relation.span.begin),
                   std::move(others),
                   {}});
  }
  for (RelatedFeatures& related : all)
    for (const FeatureId other : related.others) related.ids.push_back(state_->table->id(other));
  return all;
}

}  // namespace oriel
