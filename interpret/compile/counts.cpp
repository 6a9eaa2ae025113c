#include "interpret/compile/counts.h"

#include "interpret/pack/names.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// True if there can be no more of `part` than of `whole`.
bool is_part(const Typical& part, const Typical& whole) {
  return part.per == whole.per || whole.per == "building";
}

/// The counts of classes that together make up the least or the most of a class.
struct CountSum {
  double count = 0;
  /// Each with its class.
  std::vector<std::pair<ClassId, const Typical*>> parts;

  void add(const CountSum& more) {
    count += more.count;
    parts.insert(parts.end(), more.parts.begin(), more.parts.end());
  }
};

constexpr double kAnyNumber = std::numeric_limits<double>::infinity();

class CountChecker {
 public:
  CountChecker(const Pack& pack, const PackValues& values, Findings& findings)
      : pack_(&pack), values_(&values), findings_(&findings), beneath_(pack.classes.size()) {
    for (ClassId id = 0; id < static_cast<ClassId>(pack.classes.size()); ++id)
      if (at(id).parent != kNoClass)
        beneath_[static_cast<std::size_t>(at(id).parent)].push_back(id);
  }

  void run() {
    for (ClassId id = 0; id < static_cast<ClassId>(pack_->classes.size()); ++id)
      for (const Typical& typical : at(id).typical)
        if (!report_impossible(id, typical) && pack_->source.is_in_first(typical.span.begin))
          report_unused(id, typical);
    if (findings_->has_errors()) return;  // sums would say the same again
    for (ClassId id = 0; id < static_cast<ClassId>(pack_->classes.size()); ++id)
      for (const Typical& whole : at(id).typical) report_sums(id, whole);
  }

 private:
  [[nodiscard]] const Class& at(ClassId id) const {
    return pack_->classes[static_cast<std::size_t>(id)];
  }
  [[nodiscard]] const std::vector<ClassId>& beneath(ClassId id) const {
    return beneath_[static_cast<std::size_t>(id)];
  }
  [[nodiscard]] CountRange range_of(const Typical& typical) const {
    return values_->count_of(*pack_, typical);
  }
  [[nodiscard]] std::string text_of(const Class& c, const Typical& typical) const {
    const auto [low, high] = range_of(typical);
    const std::string most = high == CountRange::kNoEnd ? "" : fmt::format(" {}", high);
    return fmt::format("{} ..{} '{}' per {}", low, most, c.name, typical.per);
  }
  [[nodiscard]] std::string place_of(const Typical& typical) const {
    const Place place = pack_->source.place(typical.span.begin);
    return fmt::format("{}:{}:{}", place.file, place.line, place.column);
  }

  bool report_impossible(ClassId id, const Typical& typical) {
    for (ClassId above = id; above != kNoClass; above = at(above).parent)
      for (const Typical& whole : at(above).typical) {
        if (!is_part(typical, whole) || range_of(typical).low <= range_of(whole).high) continue;
        findings_->error(Code::R212, typical.span,
                         fmt::format("{} and {} ({}) exclude each other", text_of(at(id), typical),
                                     text_of(at(above), whole), place_of(whole)));
        return true;
      }
    return false;
  }

  /// The fewest of a class that there are where `whole` counts.
  [[nodiscard]] CountSum least_of(ClassId id, const Typical& whole) const {
    CountSum own;
    for (const Typical& typical : at(id).typical)
      if (const int low = range_of(typical).low; is_part(typical, whole) && low > own.count)
        own = {static_cast<double>(low), {{id, &typical}}};
    const CountSum sum = least_beneath(id, whole);
    return sum.count > own.count ? sum : own;
  }
  [[nodiscard]] CountSum least_beneath(ClassId id, const Typical& whole) const {
    CountSum sum;
    for (const ClassId part : beneath(id)) sum.add(least_of(part, whole));
    return sum;
  }

  /// The most of a class that there are where `whole` counts.
  [[nodiscard]] CountSum most_of(ClassId id, const Typical& whole) const {
    CountSum own{kAnyNumber, {}};
    for (const Typical& typical : at(id).typical)
      if (const int high = range_of(typical).high;
          is_part(whole, typical) && high != CountRange::kNoEnd && high < own.count)
        own = {static_cast<double>(high), {{id, &typical}}};
    const CountSum sum = most_beneath(id, whole);
    return sum.count < own.count ? sum : own;
  }
  /// Any number of a label, and of what has nothing beneath it.
  [[nodiscard]] CountSum most_beneath(ClassId id, const Typical& whole) const {
    CountSum sum;
    if (!at(id).is_abstract || beneath(id).empty()) return {kAnyNumber, {}};
    for (const ClassId part : beneath(id)) sum.add(most_of(part, whole));
    return sum;
  }

  void report_sums(ClassId id, const Typical& whole) {
    if (const CountSum least = least_beneath(id, whole); least.count > range_of(whole).high)
      report_sum(id, whole, "at least", least);
    if (const CountSum most = most_beneath(id, whole); most.count < range_of(whole).low)
      report_sum(id, whole, "at most", most);
  }

  void report_sum(ClassId id, const Typical& whole, const char* bound, const CountSum& sum) {
    constexpr std::size_t kShown = 5;
    std::string parts;
    for (const auto& [part, typical] : sum.parts | std::views::take(kShown))
      parts += fmt::format("{}{} ({})", parts.empty() ? "" : ", ", text_of(at(part), *typical),
                           place_of(*typical));
    if (sum.parts.size() > kShown) parts += fmt::format(" and {} more", sum.parts.size() - kShown);
    findings_->error(Code::R212, whole.span,
                     fmt::format("{} cannot be: the classes beneath it are {} {} together, {}",
                                 text_of(at(id), whole), bound, sum.count, parts));
  }

  void report_unused(ClassId id, const Typical& typical) {
    if (!pack_->decide.evidence.is_written()) {
      findings_->warning(Code::R257, typical.span,
                         fmt::format("'typical' of '{}' says nothing: 'evidence' under 'decide' "
                                     "says how much it may add",
                                     at(id).name));
      return;
    }
    const bool is_labelled = std::ranges::any_of(pack_->rules, [&](const Rule& rule) {
      return !at(rule.label).is_abstract && is_within(pack_->classes, rule.label, id);
    });
    if (is_labelled) return;
    findings_->warning(Code::R257, typical.span,
                       fmt::format("'typical' of '{}' says nothing: no rule has this label{}",
                                   at(id).name, at(id).is_abstract ? " or one beneath it" : ""));
  }

  const Pack* pack_;
  const PackValues* values_;
  Findings* findings_;
  /// By class, those whose parent it is.
  std::vector<std::vector<ClassId>> beneath_;
};

/// More are never counted.
constexpr double kMostCounted = 1e6;

}  // namespace

bool is_count(double value) {
  return value >= 0 && value <= kMostCounted && value == std::floor(value);
}

void relate_counts(Pack& pack) {
  const int storey = relation_number(pack, "same_storey");
  const int facade = relation_number(pack, "same_facade");
  for (Class& c : pack.classes)
    for (Typical& typical : c.typical)
      if (typical.per != "building") typical.relation = typical.per == "storey" ? storey : facade;
}

std::vector<int> evidence_relations(const Pack& pack) {
  if (!pack.decide.evidence.is_written()) return {};
  std::vector<int> relations = pack.decide.evidence.company;
  for (const Class& c : pack.classes)
    for (const Typical& typical : c.typical)
      if (typical.relation >= 0) relations.push_back(typical.relation);
  return relations;
}

void check_counts(const Pack& pack, const PackValues& values, Findings& findings) {
  CountChecker(pack, values, findings).run();
}

}  // namespace oriel::rules
