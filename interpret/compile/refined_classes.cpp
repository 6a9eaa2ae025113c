#include "interpret/compile/refined_classes.h"

#include "interpret/evaluate/arithmetic.h"
#include "interpret/evaluate/comparisons.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace oriel::rules {

namespace {

/// What a key says of every feature: a column of the table as it stands, or evaluated into
/// `evaluated`.
std::span<const double> numbers_of(const Pack& pack, const EvaluationContext& context,
                                   Evaluator& evaluator, ExprId id,
                                   std::vector<double>& evaluated) {
  const Expr& key = pack.code[at(id)];
  if (key.op == Op::attribute) return context.columns[at(key.index)];
  evaluated.resize(context.rows);
  for (std::size_t begin = 0; begin < context.rows; begin += kBlock) {
    const Frame frame = block_of(context, begin);
    evaluator.numbers(id, frame, std::span(evaluated).subspan(begin, frame.size));
  }
  return evaluated;
}

/// By value; rows of one value, which ascend, stay in their order. Leaves the values in `keys`.
/// Most stand where they belong, as features are found row by row.
void sort_members(std::span<int> members, std::span<const double> values, std::span<double> keys) {
  constexpr std::size_t kMany = 64;
  const auto value_of = [&](int row) { return values[at(row)]; };
  if (members.size() > kMany) {
    std::ranges::stable_sort(members, {}, value_of);
    std::ranges::transform(members, keys.begin(), value_of);
    return;
  }
  for (std::size_t next = 0; next < members.size(); ++next) {
    const int member = members[next];
    const double key = value_of(member);
    std::size_t place = next;
    for (; place > 0 && key < keys[place - 1]; --place) {
      members[place] = members[place - 1];
      keys[place] = keys[place - 1];
    }
    members[place] = member;
    keys[place] = key;
  }
}

/// Cuts the classes of `from` where their members differ in `values`; those that do not fit are
/// left out.
FeatureLinks parted(const FeatureLinks& from, const std::vector<Truth>& fits,
                    std::span<const double> values) {
  FeatureLinks parts;
  parts.are_classes = true;
  parts.list_of.assign(fits.size(), -1);
  parts.others.resize(from.others.size());
  parts.starts.reserve(from.others.size() + 1);
  std::vector<double> keys(from.others.size());
  std::size_t size = 0;
  for (std::size_t c = 0; c < from.lists(); ++c) {
    const std::size_t begin = size;
    for (const int row : from.list(c)) {
      parts.others[size] = row;
      size += fits[at(row)] != Truth::no ? 1U : 0U;
    }
    const auto members = std::span(parts.others).subspan(begin, size - begin);
    sort_members(members, values, keys);
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (i > 0 && keys[i] != keys[i - 1]) parts.starts.push_back(static_cast<int>(begin + i));
      parts.list_of[at(members[i])] = static_cast<int>(parts.lists());
    }
    if (!members.empty()) parts.starts.push_back(static_cast<int>(size));
  }
  parts.others.resize(size);
  return parts;
}

/// Whether a row that may fit has no value.
bool is_missing_in(std::span<const double> values, std::span<const int> rows,
                   const std::vector<Truth>& fits) {
  bool is_missing = false;
  for (const int row : rows) {
    const bool may_fit = fits[at(row)] != Truth::no, has_none = std::isnan(values[at(row)]);
    is_missing |= may_fit & has_none;
  }
  return is_missing;
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

std::vector<Truth> answers_of(const EvaluationContext& context, Evaluator& evaluator,
                              const std::vector<ExprId>& conditions, int level) {
  std::vector<Truth> all(context.rows, Truth::yes);
  for (std::size_t begin = 0; begin < context.rows; begin += kBlock) {
    const Frame frame = block_of(context, begin, level);
    narrow(evaluator, conditions, frame, std::span(all).subspan(begin, frame.size));
  }
  return all;
}

std::optional<Narrowed> refined_classes(const Pack& pack, const EvaluationContext& context,
                                        Evaluator& evaluator, const Links& from,
                                        const std::vector<ExprId>& conditions,
                                        const std::vector<ExprId>& keys) {
  std::vector<Truth> fits = answers_of(context, evaluator, conditions, 0);
  if (!from.certain_rows.empty())
    for (std::size_t row = 0; row < context.rows; ++row)
      fits[row] = std::min(fits[row], from.certain_rows[row]);
  std::vector<std::vector<double>> evaluated(keys.size());
  std::vector<std::span<const double>> columns;
  for (std::size_t i = 0; i < keys.size(); ++i)
    columns.push_back(numbers_of(pack, context, evaluator, keys[i], evaluated[i]));
  for (const std::span<const double>& values : columns)
    if (is_missing_in(values, from.lists->others, fits)) return std::nullopt;
  Narrowed result;
  if (columns.empty()) result.lists = parted(*from.lists, fits, std::vector<double>(context.rows));
  for (const std::span<const double>& values : columns)
    result.lists = parted(&values == columns.data() ? *from.lists : result.lists, fits, values);
  if (has_unknown(fits)) result.links.certain_rows = std::move(fits);
  return result;
}

}  // namespace oriel::rules
