#include "interpret/detail/facts.h"

#include "interpret/detail/arithmetic.h"
#include "interpret/detail/relations.h"

#include <numeric>
#include <string>
#include <string_view>
#include <unordered_map>

namespace oriel::rules {

namespace {

/// The texts of a column as numbers: those of `words` by their position, others after them.
std::vector<double> code_texts(const std::vector<std::string>& texts,
                               std::unordered_map<std::string_view, double>& codes) {
  std::vector<double> coded;
  coded.reserve(texts.size());
  for (const std::string& text : texts) {
    if (text.empty()) {
      coded.push_back(kUnknown);
    } else if (!coded.empty() && text == texts[coded.size() - 1]) {
      coded.push_back(coded.back());
    } else {
      const auto next = static_cast<double>(codes.size());
      coded.push_back(codes.try_emplace(text, next).first->second);
    }
  }
  return coded;
}

Links pack_links(std::span<const FeatureGraph::Pair> pairs, std::size_t rows) {
  Links links;
  links.starts.assign(rows + 1, 0);
  links.others.reserve(pairs.size());
  for (const auto& [self, other] : pairs) {
    const bool is_inside =
        self.is_valid() && self.index() < rows && other.is_valid() && other.index() < rows;
    if (!is_inside) continue;
    ++links.starts[self.index() + 1];
    links.others.push_back(other.value);
  }
  std::partial_sum(links.starts.begin(), links.starts.end(), links.starts.begin());
  return links;
}

/// The relations that expressions and groups lead over, and those that these narrow.
std::vector<bool> find_needed(const Pack& pack, std::size_t count) {
  std::vector<bool> is_needed(count, false);
  for (const Expr& expr : pack.code)
    if (is_quantifier(expr.op)) is_needed[static_cast<std::size_t>(expr.index)] = true;
  for (const GroupKind& kind : pack.groups) is_needed[static_cast<std::size_t>(kind.by)] = true;
  for (std::size_t i = pack.relations.size(); i-- > 0;)
    if (is_needed[relation_schema().size() + i])
      is_needed[static_cast<std::size_t>(pack.relations[i].within)] = true;
  return is_needed;
}

}  // namespace

Facts::Facts(const Pack& pack, const FeatureTable& table, const FeatureGraph& graph)
    : rows(table.rows()),
      row_numbers(rows),
      columns(feature_schema().size()),
      relations(relation_schema().size() + pack.relations.size()),
      membership(pack.classes.size(), std::vector<Truth>(rows, Truth::no)),
      host_inclination(column_of("host_inclination").value()),
      coded_texts_(columns.size()) {
  std::iota(row_numbers.begin(), row_numbers.end(), 0);
  if (rows == 0) return;
  std::unordered_map<std::string_view, double> codes;
  for (std::size_t i = 0; i < pack.words.size(); ++i)
    codes.emplace(pack.words[i], static_cast<double>(i));
  for (const Expr& expr : pack.code) {
    const auto i = static_cast<std::size_t>(expr.index);
    if (expr.type == Type::text && expr.op == Op::attribute && coded_texts_[i].empty())
      columns[i] = coded_texts_[i] = code_texts(table.texts(i), codes);
  }
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (feature_schema()[i].unit != Unit::text) columns[i] = table.numbers(i);
  link(pack, graph);
}

/// Relations of the pack read the columns, and the relation they narrow, which stands before them.
void Facts::link(const Pack& pack, const FeatureGraph& graph) {
  const std::size_t built_in = relation_schema().size();
  const std::vector<bool> is_needed = find_needed(pack, relations.size());
  for (std::size_t i = 0; i < relations.size(); ++i) {
    if (!is_needed[i]) continue;
    if (i < built_in)
      relations[i] = pack_links(graph.pairs(relation_schema()[i].name), rows);
    else
      relations[i] = narrowed(pack, *this, pack.relations[i - built_in]);
  }
}

Facts::Facts(const Pack& pack, const SurfaceTable& table)
    : rows(table.rows()),
      row_numbers(rows),
      columns(surface_schema().size()),
      coded_texts_(columns.size()) {
  std::iota(row_numbers.begin(), row_numbers.end(), 0);
  if (rows == 0) return;
  std::unordered_map<std::string_view, double> codes;
  for (std::size_t i = 0; i < pack.words.size(); ++i)
    codes.emplace(pack.words[i], static_cast<double>(i));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (surface_schema()[i].unit == Unit::text)
      columns[i] = coded_texts_[i] = code_texts(table.texts(i), codes);
    else
      columns[i] = table.numbers(i);
  }
}

}  // namespace oriel::rules
