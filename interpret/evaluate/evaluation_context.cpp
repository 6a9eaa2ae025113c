#include "interpret/evaluate/evaluation_context.h"

#include "interpret/evaluate/arithmetic.h"
#include "interpret/evaluate/comparisons.h"
#include "interpret/evaluate/evaluator.h"
#include "interpret/evaluate/relations.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace oriel::rules {

namespace {

constexpr std::size_t kHostInclination = column_of(Attribute::host_inclination);

/// Numbers of texts: of the pack's words their position, of others those that follow.
class TextCodes {
 public:
  explicit TextCodes(const Pack& pack) : pack_(pack) {}

  double of(const std::string& text) {
    if (const auto word = pack_.reads.words.find(text); word != pack_.reads.words.end())
      return static_cast<double>(word->second);
    const auto next = static_cast<double>(pack_.words.size() + others_.size());
    return others_.try_emplace(text, next).first->second;
  }

 private:
  const Pack& pack_;
  std::unordered_map<std::string_view, double> others_;
};

/// Adds the texts of a column as numbers.
void code_texts(const WordColumn& texts, TextCodes& codes, std::vector<double>& coded) {
  std::vector<double> code_of;
  for (const std::string& word : texts.words())
    code_of.push_back(word.empty() ? kUnknown : codes.of(word));
  const std::size_t first = coded.size();
  const auto& numbers = texts.numbers();
  coded.resize(first + numbers.size());
  for (std::size_t row = 0; row < numbers.size(); ++row) coded[first + row] = code_of[numbers[row]];
}

/// Throws std::invalid_argument where the graph is of other features than the table.
void check_rows(const FeatureLinks& links, const std::string& relation, std::size_t rows) {
  int last = -1;
  for (const int other : links.others) last = std::max(last, other);
  if (links.list_of.size() > rows || last >= static_cast<int>(rows))
    throw std::invalid_argument("the relation " + relation +
                                " leads to features that the table does not have");
}

std::size_t rows_of_all(std::span<const FeaturesOfBuilding> buildings) {
  std::size_t rows = 0;
  for (const FeaturesOfBuilding& building : buildings) rows += building.table->rows();
  return rows;
}

std::vector<double> joined_numbers(std::span<const FeaturesOfBuilding> buildings,
                                   Attribute attribute, std::size_t rows) {
  std::vector<double> joined;
  joined.reserve(rows);
  for (const FeaturesOfBuilding& building : buildings) {
    const auto numbers = building.table->numbers(attribute);
    joined.insert(joined.end(), numbers.begin(), numbers.end());
  }
  return joined;
}

void add_all(std::span<const int> numbers, int sum, std::vector<int>& to) {
  const std::size_t first = to.size();
  to.resize(first + numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) to[first + i] = numbers[i] + sum;
}

/// The lists of a relation of several buildings. Without a list it does not matter whether they are
/// classes.
FeatureLinks joined_links(std::span<const FeaturesOfBuilding> buildings,
                          const std::string& relation, std::size_t rows) {
  FeatureLinks joined;
  joined.are_classes = true;
  joined.list_of.reserve(rows);
  int first = 0;
  for (const FeaturesOfBuilding& building : buildings) {
    const FeatureLinks& links = building.graph->links(relation);
    check_rows(links, relation, building.table->rows());
    const auto lists = static_cast<int>(joined.lists());
    for (const int list : links.list_of) joined.list_of.push_back(list < 0 ? -1 : list + lists);
    first += static_cast<int>(building.table->rows());
    joined.list_of.resize(static_cast<std::size_t>(first), -1);
    add_all(std::span(links.starts).subspan(1), static_cast<int>(joined.others.size()),
            joined.starts);
    add_all(links.others, first - static_cast<int>(building.table->rows()), joined.others);
    joined.are_classes = joined.are_classes && (links.are_classes || links.lists() == 0);
  }
  return joined;
}

}  // namespace

EvaluationContext::EvaluationContext(const Pack& pack, std::size_t features)
    : rows(features),
      row_numbers(rows),
      columns(feature_schema().size()),
      relations(relation_schema().size() + pack.relations.size()),
      membership(pack.classes.size(), std::vector<Truth>(rows, Truth::no)),
      coded_texts_(columns.size()) {
  std::iota(row_numbers.begin(), row_numbers.end(), 0);
}

EvaluationContext::EvaluationContext(const Pack& pack, const FeatureTable& table,
                                     const FeatureGraph& graph)
    : EvaluationContext(pack, table.rows()) {
  if (rows == 0) return;
  TextCodes codes(pack);
  for (const std::size_t i : pack.reads.texts) {
    code_texts(table.texts(kAttributes[i]), codes, coded_texts_[i]);
    columns[i] = coded_texts_[i];
  }
  for (const std::size_t i : pack.reads.numbers) columns[i] = table.numbers(kAttributes[i]);
  columns[kHostInclination] = table.numbers(Attribute::host_inclination);
  find_hosts(pack);
  link(pack, [&](const std::string& relation) {
    const FeatureLinks& links = graph.links(relation);
    check_rows(links, relation, rows);
    return &links;
  });
}

EvaluationContext::EvaluationContext(const Pack& pack,
                                     std::span<const FeaturesOfBuilding> buildings)
    : EvaluationContext(pack, rows_of_all(buildings)) {
  if (rows == 0) return;
  TextCodes codes(pack);
  for (const std::size_t i : pack.reads.texts) {
    for (const FeaturesOfBuilding& building : buildings)
      code_texts(building.table->texts(kAttributes[i]), codes, coded_texts_[i]);
    columns[i] = coded_texts_[i];
  }
  joined_numbers_.resize(columns.size());
  const auto join = [&](std::size_t column) {
    joined_numbers_[column] = joined_numbers(buildings, kAttributes[column], rows);
    columns[column] = joined_numbers_[column];
  };
  for (const std::size_t i : pack.reads.numbers) join(i);
  if (joined_numbers_[kHostInclination].empty()) join(kHostInclination);
  find_hosts(pack);
  joined_lists_.reserve(relation_schema().size());
  link(pack, [&](const std::string& relation) {
    return &joined_lists_.emplace_back(joined_links(buildings, relation, rows));
  });
}

/// Kind by kind: of one are those in its range that were of none before, unknown those whose
/// inclination is missing. The last kind is what is left.
void EvaluationContext::find_hosts(const Pack& pack) {
  const auto& asked = pack.reads.host_kinds;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const auto last = std::find(asked.rbegin(), asked.rend(), true);
  const std::array<HostRange, 4> ranges = {pack.hosts.wall, pack.hosts.roof, pack.hosts.ground,
                                           HostRange{-kAny, kAny}};
  for (std::size_t kind = 0; kind < static_cast<std::size_t>(asked.rend() - last); ++kind) {
    std::vector<Truth>& answers = hosts[kind];
    answers.resize(rows);
    compare_range(columns[kHostInclination], ranges[kind].low_deg, ranges[kind].high_deg, answers);
    for (std::size_t before = 0; before < kind; ++before)
      for (std::size_t row = 0; row < rows; ++row)
        answers[row] = hosts[before][row] == Truth::yes ? Truth::no : answers[row];
  }
}

/// Relations of the pack read the columns, and the relation they narrow, which stands before them.
void EvaluationContext::link(const Pack& pack, auto lists_of_relation) {
  const std::size_t built_in = relation_schema().size();
  narrowed_.reserve(pack.relations.size());
  for (std::size_t i = 0; i < relations.size(); ++i) {
    if (!pack.reads.relations[i]) continue;
    if (i < built_in) {
      relations[i].lists = lists_of_relation(relation_schema()[i].name);
      continue;
    }
    Narrowed narrowed = rules::narrowed(pack, *this, pack.relations[i - built_in]);
    narrowed_.push_back(std::move(narrowed.lists));
    relations[i] = std::move(narrowed.links);
    relations[i].lists = &narrowed_.back();
  }
}

EvaluationContext::EvaluationContext(const Pack& pack, const SurfaceTable& table)
    : rows(table.rows()),
      row_numbers(rows),
      columns(surface_schema().size()),
      coded_texts_(columns.size()) {
  std::iota(row_numbers.begin(), row_numbers.end(), 0);
  if (rows == 0) return;
  TextCodes codes(pack);
  for (const SurfaceAttribute attribute : kSurfaceAttributes) {
    const std::size_t i = column_of(attribute);
    if (info_of(attribute).unit == Unit::text) {
      code_texts(table.texts(attribute), codes, coded_texts_[i]);
      columns[i] = coded_texts_[i];
    } else {
      columns[i] = table.numbers(attribute);
    }
  }
}

}  // namespace oriel::rules
