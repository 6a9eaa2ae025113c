#include "interpret/score/paired.h"

#include "kernel/base/assert.h"
#include "kernel/base/text/json_text.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <span>

#include <boost/math/distributions/binomial.hpp>
#include <fmt/format.h>

namespace oriel {

namespace {

/// The draws of so many buildings and samples are kept (64 MB); those of more are made again for
/// each comparison.
constexpr std::size_t kMostKeptDraws = 16'000'000;

std::vector<std::string> labels_in(const RunOutcomes& run) {
  std::set<std::string> labels;
  for (const auto& [building, outcome] : run)
    for (const auto& [label, counts] : outcome.classes) labels.insert(label);
  return {labels.begin(), labels.end()};
}

/// Both sorted, and so is the result.
std::vector<std::string> united(const std::vector<std::string>& some,
                                const std::vector<std::string>& others) {
  std::vector<std::string> all;
  std::ranges::set_union(some, others, std::back_inserter(all));
  return all;
}

std::size_t place_in(const std::vector<std::string>& labels, const std::string& label) {
  return static_cast<std::size_t>(std::ranges::lower_bound(labels, label) - labels.begin());
}

ClassScore counts_of(const OutcomeOfBuilding& outcome, const std::string& label) {
  const auto found = outcome.classes.find(label);
  return found == outcome.classes.end() ? ClassScore{} : found->second;
}

ClassScore difference(const ClassScore& from, const ClassScore& to) {
  return {to.true_positives - from.true_positives, to.false_positives - from.false_positives,
          to.false_negatives - from.false_negatives};
}

bool is_zero(const ClassScore& counts) {
  return counts.true_positives == 0 && counts.false_positives == 0 && counts.false_negatives == 0;
}

/// Unsigned numbers go round, so negative differences are added rightly, too.
void add_times(ClassScore& sum, const ClassScore& counts, std::size_t times) {
  sum.true_positives += times * counts.true_positives;
  sum.false_positives += times * counts.false_positives;
  sum.false_negatives += times * counts.false_negatives;
}

/// As Score::macro_f1, of counts in the order of their labels.
double macro_f1_of(std::span<const ClassScore> classes) {
  double sum = 0;
  std::size_t count = 0;
  for (const ClassScore& counts : classes) {
    if (counts.true_positives + counts.false_negatives == 0) continue;
    sum += counts.f1();
    ++count;
  }
  return count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(count);
}

/// The buildings of a run in their order, and how often each is in the next sample.
class SampleCounter {
 public:
  /// Without buildings there is nothing to draw.
  explicit SampleCounter(std::size_t buildings)
      : draws_(std::max<std::size_t>(buildings, 1)), times_(buildings) {}

  std::span<const std::uint32_t> next() {
    std::ranges::fill(times_, 0);
    for (std::size_t i = 0; i < times_.size(); ++i) ++times_[draws_.next()];
    return times_;
  }

 private:
  BuildingDraws draws_;
  std::vector<std::uint32_t> times_;
};

/// Where two runs differ: a building and the differences of its classes, by label.
struct ChangedBuilding {
  /// Its place among the buildings.
  std::size_t row = 0;
  std::vector<std::pair<std::size_t, ClassScore>> differences;
};

std::vector<ChangedBuilding> changed_buildings(const RunOutcomes& first, const RunOutcomes& second,
                                               const std::vector<std::string>& labels) {
  const OutcomeOfBuilding nothing;
  std::vector<ChangedBuilding> all;
  std::size_t row = 0;
  for (const auto& [building, before] : first) {
    const auto found = second.find(building);
    const OutcomeOfBuilding& after = found == second.end() ? nothing : found->second;
    ChangedBuilding changed{row++, {}};
    for (std::size_t i = 0; i < labels.size(); ++i)
      if (const ClassScore change =
              difference(counts_of(before, labels[i]), counts_of(after, labels[i]));
          !is_zero(change))
        changed.differences.emplace_back(i, change);
    if (!changed.differences.empty()) all.push_back(std::move(changed));
  }
  return all;
}

/// Values of F1, of both runs in the same samples.
struct PairedValues {
  std::vector<double> first;
  std::vector<double> second;

  void add(double of_first, double of_second) {
    first.push_back(of_first);
    second.push_back(of_second);
  }

  void put_intervals(ClassDifference& into) const {
    std::vector<double> differences;
    differences.reserve(first.size());
    for (std::size_t i = 0; i < first.size(); ++i) differences.push_back(second[i] - first[i]);
    into.interval = middle_of(std::move(differences));
    into.first_interval = middle_of(first);
    into.second_interval = middle_of(second);
  }
};

std::vector<ClassScore> sums_of(const RunOutcomes& run, const std::vector<std::string>& labels) {
  std::vector<ClassScore> sums(labels.size());
  for (const auto& [building, outcome] : run)
    for (std::size_t i = 0; i < labels.size(); ++i) sums[i] += counts_of(outcome, labels[i]);
  return sums;
}

/// F1 of both runs, and what the second has more.
void put_values(const RunOutcomes& first, const RunOutcomes& second,
                const std::vector<std::string>& labels, PairedComparison& comparison) {
  const auto put = [](double of_first, double of_second, ClassDifference& into) {
    into.first_f1 = of_first;
    into.second_f1 = of_second;
    into.f1 = of_second - of_first;
  };
  const std::vector<ClassScore> of_first = sums_of(first, labels);
  const std::vector<ClassScore> of_second = sums_of(second, labels);
  for (std::size_t i = 0; i < labels.size(); ++i)
    put(of_first[i].f1(), of_second[i].f1(), comparison.classes[labels[i]]);
  put(macro_f1_of(of_first), macro_f1_of(of_second), comparison.all);
}

/// Counts the true objects that only one run found.
void count_found_once(const RunOutcomes& first, const RunOutcomes& second,
                      PairedComparison& comparison) {
  using Missed = std::vector<std::pair<std::string, std::string>>;
  const auto only_in = [](const Missed& some, const Missed& others) {
    Missed rest;
    std::ranges::set_difference(some, others, std::back_inserter(rest));
    return rest;
  };
  const OutcomeOfBuilding nothing;
  for (const auto& [building, before] : first) {
    const auto found = second.find(building);
    const OutcomeOfBuilding& after = found == second.end() ? nothing : found->second;
    for (const auto& [label, id] : only_in(after.missed, before.missed))
      ++comparison.classes[label].only_first;
    for (const auto& [label, id] : only_in(before.missed, after.missed))
      ++comparison.classes[label].only_second;
  }
  for (auto& [label, difference] : comparison.classes) {
    comparison.all.only_first += difference.only_first;
    comparison.all.only_second += difference.only_second;
    difference.p = mcnemar_p(difference.only_first, difference.only_second);
  }
  comparison.all.p = mcnemar_p(comparison.all.only_first, comparison.all.only_second);
}

/// How F1 of both runs is in the samples: by label, then of all classes.
class SampledValues {
 public:
  explicit SampledValues(std::size_t labels) : values_(labels + 1) {}

  void add(std::span<const ClassScore> first, std::span<const ClassScore> second) {
    for (std::size_t i = 0; i < first.size(); ++i) values_[i].add(first[i].f1(), second[i].f1());
    values_.back().add(macro_f1_of(first), macro_f1_of(second));
  }

  [[nodiscard]] const PairedValues& of_label(std::size_t label) const { return values_[label]; }
  [[nodiscard]] const PairedValues& of_all() const { return values_.back(); }

 private:
  std::vector<PairedValues> values_;
};

std::string difference_line(const std::string& label, const ClassDifference& d) {
  const auto number = [](double value) {
    return std::isnan(value) ? std::string("-") : fmt::format("{:.3f}", value);
  };
  const auto signed_number = [](double value) {
    return std::isnan(value) ? std::string("-") : fmt::format("{:+.3f}", value);
  };
  const std::string interval = std::isnan(d.interval.low) ? "-"
                                                          : signed_number(d.interval.low) + " to " +
                                                                signed_number(d.interval.high);
  return fmt::format("{:<12} {:>7} {:>7} {:>10} {:>18} {:>7} {:>7} {:>8}\n", printable(label),
                     number(d.first_f1), number(d.second_f1), signed_number(d.f1), interval,
                     d.only_first, d.only_second, fmt::format("{:.2g}", d.p));
}

std::string difference_json(const ClassDifference& d) {
  return fmt::format(
      R"({{"first_f1":{},"second_f1":{},"difference":{},"interval":{},"only_first":{},"only_second":{},"p":{}}})",
      json_number(d.first_f1), json_number(d.second_f1), json_number(d.f1),
      interval_json(d.interval), d.only_first, d.only_second, json_number(d.p));
}

}  // namespace

OutcomeOfBuilding outcome_of(const Score& score, const ScoreOptions& options) {
  OutcomeOfBuilding outcome;
  outcome.classes = score.classes;
  for (const Miss& miss : score.misses)
    if (!miss.truth_id.empty() && is_scored(miss.truth_label, options))
      outcome.missed.emplace_back(miss.truth_label, miss.truth_id);
  std::ranges::sort(outcome.missed);
  return outcome;
}

std::pair<RunOutcomes, RunOutcomes> paired_outcomes(const std::map<std::string, Score>& first,
                                                    const std::map<std::string, Score>& second,
                                                    const ScoreOptions& options) {
  std::pair<RunOutcomes, RunOutcomes> both;
  for (const auto& [building, score] : first) {
    both.first[building] = outcome_of(score, options);
    both.second[building];
  }
  for (const auto& [building, score] : second) {
    both.first[building];
    both.second[building] = outcome_of(score, options);
  }
  return both;
}

PairedComparer::PairedComparer(RunOutcomes first, std::size_t samples)
    : first_(std::move(first)), samples_(first_.empty() ? 0 : samples), labels_(labels_in(first_)) {
  std::vector<std::vector<ClassScore>> rows;
  for (const auto& [building, outcome] : first_) {
    std::vector<ClassScore>& row = rows.emplace_back();
    for (const std::string& label : labels_) row.push_back(counts_of(outcome, label));
  }
  sums_.assign(samples_ * labels_.size(), {});
  const bool is_kept = samples_ > 0 && rows.size() <= kMostKeptDraws / samples_;
  SampleCounter counter(rows.size());
  for (std::size_t sample = 0; sample < samples_; ++sample) {
    const auto times = counter.next();
    if (is_kept) times_drawn_.insert(times_drawn_.end(), times.begin(), times.end());
    ClassScore* sum = sums_.data() + sample * labels_.size();
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (times[row] == 0) continue;
      for (std::size_t i = 0; i < labels_.size(); ++i) add_times(sum[i], rows[row][i], times[row]);
    }
  }
}

PairedComparison PairedComparer::compare(const RunOutcomes& second) const {
  ORIEL_ASSERT(std::ranges::all_of(second, [&](const auto& b) { return first_.contains(b.first); }),
               "paired runs are of the same buildings");
  const std::vector<std::string> labels = united(labels_, labels_in(second));
  const std::vector<ChangedBuilding> changed = changed_buildings(first_, second, labels);
  PairedComparison comparison;
  comparison.samples = samples_;
  put_values(first_, second, labels, comparison);
  count_found_once(first_, second, comparison);
  SampledValues values(labels.size());
  for_each_sample([&](std::size_t sample, std::span<const std::uint32_t> times) {
    std::vector<ClassScore> of_first(labels.size());
    for (std::size_t i = 0; i < labels_.size(); ++i)
      of_first[place_in(labels, labels_[i])] = sums_[sample * labels_.size() + i];
    std::vector<ClassScore> of_second = of_first;
    for (const ChangedBuilding& building : changed)
      for (const auto& [label, change] : building.differences)
        add_times(of_second[label], change, times[building.row]);
    values.add(of_first, of_second);
  });
  for (std::size_t i = 0; i < labels.size(); ++i)
    values.of_label(i).put_intervals(comparison.classes[labels[i]]);
  values.of_all().put_intervals(comparison.all);
  return comparison;
}

void PairedComparer::for_each_sample(
    const std::function<void(std::size_t, std::span<const std::uint32_t>)>& visit) const {
  const std::size_t buildings = first_.size();
  SampleCounter counter(buildings);
  for (std::size_t sample = 0; sample < samples_; ++sample)
    visit(sample, times_drawn_.empty()
                      ? counter.next()
                      : std::span(times_drawn_).subspan(sample * buildings, buildings));
}

double mcnemar_p(std::size_t only_first, std::size_t only_second) {
  if (only_first == only_second) return 1;
  const boost::math::binomial coins(static_cast<double>(only_first + only_second), 0.5);
  return std::min(1.0, 2 * cdf(coins, static_cast<double>(std::min(only_first, only_second))));
}

std::string to_text(const PairedComparison& comparison) {
  std::string text =
      fmt::format("{:<12} {:>7} {:>7} {:>10} {:>18} {:>7} {:>7} {:>8}\n", "F1", "first", "second",
                  "difference", "95 %", "only 1st", "only 2nd", "p");
  for (const auto& [label, difference] : comparison.classes)
    text += difference_line(label, difference);
  return text + difference_line("macro-F1", comparison.all);
}

std::string to_json(const PairedComparison& comparison) {
  std::string classes;
  for (const auto& [label, difference] : comparison.classes)
    classes += fmt::format("{}{}:{}", classes.empty() ? "" : ",", json_string(label),
                           difference_json(difference));
  return fmt::format(R"({{"samples":{},"classes":{{{}}},"macro_f1":{}}})", comparison.samples,
                     classes, difference_json(comparison.all));
}

}  // namespace oriel
