#include "interpret/evaluate/evaluation_context.h"

#include "interpret/evaluate/arithmetic.h"
#include "interpret/evaluate/relations.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace oriel::rules {

namespace {

/// Numbers of texts: of the pack's words their position, of others those that follow.
class TextCodes {
 public:
  explicit TextCodes(const Pack& pack) : pack_(pack) {}

  /// The texts of a column as numbers.
  std::vector<double> of(const WordColumn& texts) {
    std::vector<double> code_of;
    for (const std::string& word : texts.words())
      code_of.push_back(word.empty() ? kUnknown : of(word));
    std::vector<double> coded;
    coded.reserve(texts.numbers().size());
    for (const auto number : texts.numbers()) coded.push_back(code_of[number]);
    return coded;
  }

 private:
  double of(const std::string& text) {
    if (const auto word = pack_.reads.words.find(text); word != pack_.reads.words.end())
      return static_cast<double>(word->second);
    const auto next = static_cast<double>(pack_.words.size() + others_.size());
    return others_.try_emplace(text, next).first->second;
  }

  const Pack& pack_;
  std::unordered_map<std::string_view, double> others_;
};

/// Throws std::invalid_argument where the graph is of other features than the table.
void check_rows(const FeatureLinks& links, const std::string& relation, std::size_t rows) {
  int last = -1;
  for (const int other : links.others) last = std::max(last, other);
  if (links.list_of.size() > rows || last >= static_cast<int>(rows))
    throw std::invalid_argument("the relation " + relation +
                                " leads to features that the table does not have");
}

}  // namespace

EvaluationContext::EvaluationContext(const Pack& pack, PackValues set, const FeatureTable& table,
                                     const FeatureGraph& graph)
    : values(std::move(set)),
      rows(table.rows()),
      row_numbers(rows),
      columns(feature_schema().size()),
      relations(relation_schema().size() + pack.relations.size()),
      membership(pack.classes.size(), std::vector<Truth>(rows, Truth::no)),
      table_(&table),
      coded_texts_(columns.size()) {
  std::iota(row_numbers.begin(), row_numbers.end(), 0);
  if (rows == 0) return;
  TextCodes codes(pack);
  for (const std::size_t i : pack.reads.texts) {
    coded_texts_[i] = codes.of(table.texts(kAttributes[i]));
    columns[i] = coded_texts_[i];
  }
  for (const std::size_t i : pack.reads.numbers) columns[i] = table.numbers(kAttributes[i]);
  columns[column_of(Attribute::host_inclination)] = table.numbers(Attribute::host_inclination);
  link(pack, graph);
}

/// Relations of the pack read the columns, and the relation they narrow, which stands before them.
void EvaluationContext::link(const Pack& pack, const FeatureGraph& graph) {
  const std::size_t built_in = relation_schema().size();
  narrowed_.reserve(pack.relations.size());
  for (std::size_t i = 0; i < relations.size(); ++i) {
    if (!pack.reads.relations[i]) continue;
    if (i < built_in) {
      const std::string& name = relation_schema()[i].name;
      relations[i].lists = &graph.links(name);
      check_rows(*relations[i].lists, name, rows);
      continue;
    }
    NarrowedRelation narrowed = rules::narrowed(pack, *this, pack.relations[i - built_in]);
    narrowed_.push_back(std::move(narrowed.lists));
    relations[i] = std::move(narrowed.links);
    relations[i].lists = &narrowed_.back();
  }
}

EvaluationContext::EvaluationContext(const Pack& pack, PackValues set, const SurfaceTable& table)
    : values(std::move(set)),
      rows(table.rows()),
      row_numbers(rows),
      columns(surface_schema().size()),
      coded_texts_(columns.size()) {
  std::iota(row_numbers.begin(), row_numbers.end(), 0);
  if (rows == 0) return;
  TextCodes codes(pack);
  for (const SurfaceAttribute attribute : kSurfaceAttributes) {
    const std::size_t i = column_of(attribute);
    if (info_of(attribute).unit == Unit::text) {
      coded_texts_[i] = codes.of(table.texts(attribute));
      columns[i] = coded_texts_[i];
    } else {
      columns[i] = table.numbers(attribute);
    }
  }
}

}  // namespace oriel::rules
