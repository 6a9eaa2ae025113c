#include "interpret/detail/refined_classes.h"

#include "kernel/model/detail/index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace oriel::rules {

namespace {

std::vector<double> numbers_of(const Facts& facts, Evaluator& evaluator, ExprId id) {
  std::vector<double> numbers(facts.rows);
  for (std::size_t begin = 0; begin < facts.rows; begin += kBlock) {
    const Frame frame = block_of(facts, begin);
    evaluator.numbers(id, frame, std::span(numbers).subspan(begin, frame.size));
  }
  return numbers;
}

/// Gives features of one class that differ in their values classes of their own.
void part_classes(std::vector<int>& class_of, const std::vector<double>& values) {
  const FeatureLinks classes = links_of_classes(class_of);
  int count = 0;
  std::vector<int> members;
  for (std::size_t c = 0; c < classes.lists(); ++c) {
    const auto list = classes.list(c);
    if (list.empty()) continue;
    members.assign(list.begin(), list.end());
    std::ranges::sort(members, {}, [&](int row) { return std::pair(values[at(row)], row); });
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (i > 0 && values[at(members[i])] != values[at(members[i - 1])]) ++count;
      class_of[at(members[i])] = count;
    }
    ++count;
  }
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

std::optional<Narrowed> refined_classes(const Facts& facts, Evaluator& evaluator, const Links& from,
                                        const std::vector<ExprId>& conditions,
                                        const std::vector<ExprId>& keys) {
  std::vector<Truth> fits = answers_of(facts, evaluator, conditions, 0);
  std::vector<int> class_of = from.lists->list_of;
  class_of.resize(facts.rows, -1);
  bool has_unknown = false;
  for (std::size_t row = 0; row < facts.rows; ++row) {
    if (!from.certain_rows.empty()) fits[row] = std::min(fits[row], from.certain_rows[row]);
    if (fits[row] == Truth::no) class_of[row] = -1;
    has_unknown |= class_of[row] >= 0 && fits[row] == Truth::unknown;
  }
  for (const ExprId key : keys) {
    const std::vector<double> values = numbers_of(facts, evaluator, key);
    for (std::size_t row = 0; row < facts.rows; ++row)
      if (class_of[row] >= 0 && std::isnan(values[row])) return std::nullopt;
    part_classes(class_of, values);
  }
  Narrowed result;
  result.lists = links_of_classes(class_of);
  if (has_unknown) result.links.certain_rows = std::move(fits);
  return result;
}

}  // namespace oriel::rules
