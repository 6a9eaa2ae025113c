#include "interpret/detail/facts.h"

#include "interpret/detail/arithmetic.h"
#include "interpret/detail/evaluator.h"
#include "interpret/detail/relations.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

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

/// Throws std::invalid_argument where the graph is of other features than the table.
void check_rows(const FeatureLinks& links, const std::string& relation, std::size_t rows) {
  const int last = links.others.empty() ? -1 : *std::ranges::max_element(links.others);
  if (links.list_of.size() > rows || last >= static_cast<int>(rows))
    throw std::invalid_argument("the relation " + relation +
                                " leads to features that the table does not have");
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
  find_hosts(pack);
  link(pack, graph);
}

void Facts::find_hosts(const Pack& pack) {
  std::array<bool, 4> is_asked{};
  for (const Expr& expr : pack.code)
    if (expr.op == Op::facet_is) is_asked[static_cast<std::size_t>(expr.index)] = true;
  const auto inclinations = columns[host_inclination];
  for (std::size_t kind = 0; kind < hosts.size(); ++kind)
    if (is_asked[kind]) hosts[kind].resize(rows, Truth::no);
  for (std::size_t row = 0; row < rows; ++row) {
    const bool is_unknown = std::isnan(inclinations[row]);
    const auto of_row = static_cast<std::size_t>(kind_of_facet(pack.hosts, inclinations[row]));
    for (std::size_t kind = 0; kind < hosts.size(); ++kind)
      if (is_asked[kind]) hosts[kind][row] = is_unknown ? Truth::unknown : truth_of(kind == of_row);
  }
}

/// Relations of the pack read the columns, and the relation they narrow, which stands before them.
void Facts::link(const Pack& pack, const FeatureGraph& graph) {
  const std::size_t built_in = relation_schema().size();
  const std::vector<bool> is_needed = find_needed(pack, relations.size());
  narrowed_.reserve(pack.relations.size());
  for (std::size_t i = 0; i < relations.size(); ++i) {
    if (!is_needed[i]) continue;
    if (i < built_in) {
      const std::string& name = relation_schema()[i].name;
      relations[i].lists = &graph.links(name);
      check_rows(*relations[i].lists, name, rows);
      continue;
    }
    Narrowed narrowed = rules::narrowed(pack, *this, pack.relations[i - built_in]);
    narrowed_.push_back(std::move(narrowed.lists));
    relations[i] = std::move(narrowed.links);
    relations[i].lists = &narrowed_.back();
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
