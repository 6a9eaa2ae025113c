#include "interpret/detail/facts.h"

#include "interpret/detail/arithmetic.h"
#include "interpret/detail/comparisons.h"
#include "interpret/detail/evaluator.h"
#include "interpret/detail/relations.h"

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

/// The texts of a column as numbers.
std::vector<double> code_texts(const WordColumn& texts, TextCodes& codes) {
  std::vector<double> code_of;
  for (const std::string& word : texts.words())
    code_of.push_back(word.empty() ? kUnknown : codes.of(word));
  std::vector<double> coded(texts.numbers().size());
  for (std::size_t row = 0; row < coded.size(); ++row) coded[row] = code_of[texts.numbers()[row]];
  return coded;
}

/// Throws std::invalid_argument where the graph is of other features than the table.
void check_rows(const FeatureLinks& links, const std::string& relation, std::size_t rows) {
  int last = -1;
  for (const int other : links.others) last = std::max(last, other);
  if (links.list_of.size() > rows || last >= static_cast<int>(rows))
    throw std::invalid_argument("the relation " + relation +
                                " leads to features that the table does not have");
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
  TextCodes codes(pack);
  for (const std::size_t i : pack.reads.texts)
    columns[i] = coded_texts_[i] = code_texts(table.texts(i), codes);
  for (const std::size_t i : pack.reads.numbers) columns[i] = table.numbers(i);
  columns[host_inclination] = table.numbers(host_inclination);
  find_hosts(pack);
  link(pack, graph);
}

/// Kind by kind: of one are those in its range that were of none before, unknown those whose
/// inclination is missing. The last kind is what is left.
void Facts::find_hosts(const Pack& pack) {
  const auto& asked = pack.reads.host_kinds;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const auto last = std::find(asked.rbegin(), asked.rend(), true);
  const std::array<HostRange, 4> ranges = {pack.hosts.wall, pack.hosts.roof, pack.hosts.ground,
                                           HostRange{-kAny, kAny}};
  for (std::size_t kind = 0; kind < static_cast<std::size_t>(asked.rend() - last); ++kind) {
    std::vector<Truth>& answers = hosts[kind];
    answers.resize(rows);
    compare_range(columns[host_inclination], ranges[kind].low_deg, ranges[kind].high_deg, answers);
    for (std::size_t before = 0; before < kind; ++before)
      for (std::size_t row = 0; row < rows; ++row)
        answers[row] = hosts[before][row] == Truth::yes ? Truth::no : answers[row];
  }
}

/// Relations of the pack read the columns, and the relation they narrow, which stands before them.
void Facts::link(const Pack& pack, const FeatureGraph& graph) {
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
  TextCodes codes(pack);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (surface_schema()[i].unit == Unit::text)
      columns[i] = coded_texts_[i] = code_texts(table.texts(i), codes);
    else
      columns[i] = table.numbers(i);
  }
}

}  // namespace oriel::rules
