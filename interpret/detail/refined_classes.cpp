#include "interpret/detail/refined_classes.h"

#include "kernel/model/detail/index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace oriel::rules {

namespace {

using Column = std::span<const double>;

/// What a key says of every feature: a column of the table as it stands, or evaluated into
/// `evaluated`.
Column numbers_of(const Pack& pack, const Facts& facts, Evaluator& evaluator, ExprId id,
                  std::vector<double>& evaluated) {
  const Expr& key = pack.code[at(id)];
  if (key.op == Op::attribute) return facts.columns[at(key.index)];
  evaluated.resize(facts.rows);
  for (std::size_t begin = 0; begin < facts.rows; begin += kBlock) {
    const Frame frame = block_of(facts, begin);
    evaluator.numbers(id, frame, std::span(evaluated).subspan(begin, frame.size));
  }
  return evaluated;
}

using Member = std::pair<double, int>;

/// Most stand where they belong, as features are found row by row.
void sort_members(std::vector<Member>& members) {
  constexpr std::size_t kMany = 64;
  if (members.size() > kMany) {
    std::ranges::sort(members);
    return;
  }
  for (auto next = members.begin() + 1; next != members.end(); ++next) {
    const Member member = *next;
    auto place = next;
    for (; place != members.begin() && member < place[-1]; --place) *place = place[-1];
    *place = member;
  }
}

/// Cuts the classes of `from` where their members differ in `values`; those that do not fit are
/// left out.
FeatureLinks parted(const FeatureLinks& from, const std::vector<Truth>& fits, Column values) {
  FeatureLinks parts;
  parts.are_classes = true;
  parts.list_of.assign(fits.size(), -1);
  parts.others.reserve(from.others.size());
  parts.starts.reserve(from.others.size() + 1);
  std::vector<Member> members;
  members.reserve(from.others.size());
  for (std::size_t c = 0; c < from.lists(); ++c) {
    members.clear();
    bool is_sorted = true;
    double last = -std::numeric_limits<double>::infinity();
    for (const int row : from.list(c)) {
      if (fits[at(row)] == Truth::no) continue;
      is_sorted &= last <= values[at(row)];
      last = values[at(row)];
      members.emplace_back(last, row);
    }
    if (members.empty()) continue;
    if (!is_sorted) sort_members(members);
    last = members.front().first;
    for (const auto& [value, row] : members) {
      if (value != last) parts.starts.push_back(static_cast<int>(parts.others.size()));
      last = value;
      parts.list_of[at(row)] = static_cast<int>(parts.lists());
      parts.others.push_back(row);
    }
    parts.starts.push_back(static_cast<int>(parts.others.size()));
  }
  return parts;
}

}  // namespace

void narrow(Evaluator& evaluator, const std::vector<ExprId>& conditions, const Frame& frame,
            std::span<Truth> all) {
  std::array<Truth, kBlock> block;
  const auto answers = std::span(block).first(all.size());
  for (const ExprId id : conditions) {
    evaluator.truths(id, frame, answers);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = std::min(all[i], answers[i]);
  }
}

std::vector<Truth> answers_of(const Facts& facts, Evaluator& evaluator,
                              const std::vector<ExprId>& conditions, int level) {
  std::vector<Truth> all(facts.rows, Truth::yes);
  for (std::size_t begin = 0; begin < facts.rows; begin += kBlock) {
    const Frame frame = block_of(facts, begin, level);
    narrow(evaluator, conditions, frame, std::span(all).subspan(begin, frame.size));
  }
  return all;
}

std::optional<Narrowed> refined_classes(const Pack& pack, const Facts& facts, Evaluator& evaluator,
                                        const Links& from, const std::vector<ExprId>& conditions,
                                        const std::vector<ExprId>& keys) {
  std::vector<Truth> fits = answers_of(facts, evaluator, conditions, 0);
  if (!from.certain_rows.empty())
    for (std::size_t row = 0; row < facts.rows; ++row)
      fits[row] = std::min(fits[row], from.certain_rows[row]);
  std::vector<std::vector<double>> evaluated(keys.size());
  std::vector<Column> columns;
  for (std::size_t i = 0; i < keys.size(); ++i)
    columns.push_back(numbers_of(pack, facts, evaluator, keys[i], evaluated[i]));
  bool has_unknown = false, is_missing = false;
  for (const int row : from.lists->others) {
    if (fits[at(row)] == Truth::no) continue;
    has_unknown |= fits[at(row)] == Truth::unknown;
    for (const Column& values : columns) is_missing |= std::isnan(values[at(row)]);
  }
  if (is_missing) return std::nullopt;
  Narrowed result;
  if (columns.empty()) result.lists = parted(*from.lists, fits, std::vector<double>(facts.rows));
  for (const Column& values : columns)
    result.lists = parted(&values == columns.data() ? *from.lists : result.lists, fits, values);
  if (has_unknown) result.links.certain_rows = std::move(fits);
  return result;
}

}  // namespace oriel::rules
