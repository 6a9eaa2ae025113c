#include "studio/session/labels/pack_answer.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

/// So many changes are listed; `changed_count` counts all.
constexpr std::size_t kMostChanges = 2000;

/// Lines of packs that this one extends are none of its text.
StudioJson own_line(const Place& place, const std::string& file) {
  if (place.file != file) return 0;
  return place.line;
}

StudioJson classes_json(const RuleBase& rules) {
  StudioJson list = StudioJson::array();
  const auto classes = classes_of(rules);
  for (const ClassOfPack& c : classes)
    list.push_back(
        {{"name", c.name},
         {"parent", c.parent < 0 ? StudioJson()
                                 : StudioJson(classes[static_cast<std::size_t>(c.parent)].name)},
         {"is_abstract", c.is_abstract},
         {"line", own_line(c.place, rules.file())}});
  return list;
}

StudioJson params_json(const RuleBase& rules) {
  StudioJson list = StudioJson::array();
  const auto params = params_of(rules);
  const auto places = places_of_params(rules);
  for (std::size_t i = 0; i < params.size(); ++i) {
    const PackParam& param = params[i];
    list.push_back({{"name", param.name},
                    {"value", param.value},
                    {"unit", param.unit},
                    {"text", value_text(rules, param.name, param.value)},
                    {"from", param.range ? StudioJson(param.range->first) : StudioJson()},
                    {"to", param.range ? StudioJson(param.range->second) : StudioJson()},
                    {"reason", param.why},
                    {"line", own_line(places[i], rules.file())}});
  }
  return list;
}

/// Classes of the pack before by name, as they were when it said something.
class ChangeList {
 public:
  ChangeList(const LabelledBuildings& now, const LabelledBuildings* before) : now_(now) {
    if (before == nullptr) return;
    before_ = before;
    std::map<std::string, int> numbers;
    const auto classes = classes_of(now.rules);
    for (std::size_t i = 0; i < classes.size(); ++i)
      numbers.emplace(classes[i].name, static_cast<int>(i));
    for (const ClassOfPack& c : classes_of(before->rules)) {
      const auto found = numbers.find(c.name);
      // A class that is gone: what was of it is of no class that the page knows.
      numbers_.push_back(found == numbers.end() ? -1 : found->second);
      is_gone_.push_back(found == numbers.end());
    }
  }

  void add(std::size_t number) {
    if (before_ == nullptr || number >= before_->buildings.size()) return;
    const auto &then = before_->buildings[number], &now = now_.buildings[number];
    if (!then || !now || then == now || then->classes.size() != now->classes.size()) return;
    for (std::size_t f = 0; f < now->classes.size(); ++f) {
      const int old = then->classes[f];
      const bool is_gone = old >= 0 && is_gone_[static_cast<std::size_t>(old)];
      const int before = old < 0 ? -1 : numbers_[static_cast<std::size_t>(old)];
      if (before == now->classes[f] && !is_gone) continue;
      if (++count_ > kMostChanges) continue;
      list_.push_back(
          {{"building", number}, {"feature", f}, {"before", before}, {"after", now->classes[f]}});
    }
  }

  void put(StudioJson& answer) {
    answer["changed"] = std::move(list_);
    answer["changed_count"] = count_;
  }

 private:
  const LabelledBuildings& now_;
  const LabelledBuildings* before_ = nullptr;
  std::vector<int> numbers_;
  std::vector<bool> is_gone_;
  StudioJson list_ = StudioJson::array();
  std::size_t count_ = 0;
};

/// Adds up scores of buildings.
class ScoreSum {
 public:
  void add(std::size_t number, const BuildingScore& of_building) {
    has_any_ = true;
    for (const auto& [label, counts] : of_building.score.classes) sum_.classes[label] += counts;
    for (const auto& [rule, counts] : of_building.rules) {
      rules_[rule].first += counts.first;
      rules_[rule].second += counts.second;
    }
    for (const ComparedFeature& compared : of_building.compared) {
      ConfusionCell& cell = cells_[{compared.truth, compared.label}];
      ++cell.count;
      if (compared.feature >= 0) cell.parts.push_back({number, compared.feature});
      if (!compared.object.empty()) cell.missed.push_back({number, compared.object});
    }
  }

  [[nodiscard]] StudioJson json(const RuleBase& rules) {
    if (!has_any_) return nullptr;
    return {{"macro_f1", number_or_null(sum_.macro_f1())},
            {"classes", classes()},
            {"confusion", confusion()},
            {"rules", of_rules(rules)}};
  }

 private:
  struct ConfusionCell {
    std::size_t count = 0;
    StudioJson parts = StudioJson::array(), missed = StudioJson::array();
  };

  [[nodiscard]] StudioJson classes() const {
    StudioJson list = StudioJson::array();
    for (const auto& [label, counts] : sum_.classes)
      list.push_back({{"name", label},
                      {"precision", number_or_null(counts.precision())},
                      {"recall", number_or_null(counts.recall())},
                      {"f1", number_or_null(counts.f1())},
                      {"found", counts.true_positives},
                      {"missed", counts.false_negatives},
                      {"wrong", counts.false_positives}});
    return list;
  }

  StudioJson confusion() {
    StudioJson list = StudioJson::array();
    for (auto& [key, cell] : cells_)
      list.push_back({{"truth", key.first},
                      {"label", key.second},
                      {"count", cell.count},
                      {"parts", std::move(cell.parts)},
                      {"missed", std::move(cell.missed)}});
    return list;
  }

  [[nodiscard]] StudioJson of_rules(const RuleBase& rules) const {
    StudioJson list = StudioJson::array();
    for (const RuleOfPack& rule : rules_of(rules)) {
      const auto found = rules_.find(rule.id);
      if (found == rules_.end()) continue;
      list.push_back({{"rule", rule.id},
                      {"right", found->second.first},
                      {"wrong", found->second.second},
                      {"line", own_line(rule.place, rules.file())}});
    }
    return list;
  }

  bool has_any_ = false;
  Score sum_;
  std::map<std::string, std::pair<std::size_t, std::size_t>> rules_;
  std::map<std::pair<std::string, std::string>, ConfusionCell> cells_;
};

}  // namespace

StudioJson issue_json(const Issue& issue) {
  return {{"code", to_string(issue.code)},
          {"severity", to_string(issue.severity)},
          {"sentence", issue.sentence}};
}

StudioJson issues_json(const std::vector<Issue>& issues) {
  StudioJson list = StudioJson::array();
  for (const Issue& issue : issues) list.push_back(issue_json(issue));
  return list;
}

StudioJson finding_json(const Issue& issue) {
  const int column = std::max(1, issue.place.column);
  return {{"code", to_string(issue.code)},
          {"severity", to_string(issue.severity)},
          {"sentence", issue.sentence},
          {"advice", ""},
          {"line", 1},
          {"column", column},
          {"end_line", 1},
          {"end_column", column + 1},
          {"fixes", StudioJson::array()}};
}

std::string value_text(const RuleBase& rules, const std::string& param, double value) {
  const std::string text = to_string(ParamValue{param, value}, rules);
  return text.substr(text.find('=') + 2);
}

void add_labels(const LabelledBuildings& now, const AskedLabels& asked, StudioJson& answer) {
  answer["classes"] = classes_json(now.rules);
  answer["params"] = params_json(now.rules);
  std::vector<std::size_t> counts(classes_of(now.rules).size());
  std::size_t unknown = 0;
  StudioJson labels = StudioJson::object(), doubtful = StudioJson::array();
  ChangeList changes(now, asked.before);
  ScoreSum score;
  for (std::size_t number = 0; number < now.buildings.size(); ++number) {
    if (!now.buildings[number]) continue;
    const LabelledFeatures& labelled = *now.buildings[number];
    if (labelled.since > asked.since) labels[std::to_string(number)] = labelled.classes;
    for (const int c : labelled.classes) ++(c < 0 ? unknown : counts[static_cast<std::size_t>(c)]);
    for (const int feature : labelled.doubtful) doubtful.push_back({number, feature});
    if (labelled.score) score.add(number, *labelled.score);
    changes.add(number);
  }
  answer["labels"] = std::move(labels);
  changes.put(answer);
  StudioJson by_class = StudioJson::array();
  const auto classes = classes_of(now.rules);
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) by_class.push_back({{"class", classes[i].name}, {"count", counts[i]}});
  answer["counts"] = std::move(by_class);
  answer["unknown"] = unknown;
  answer["doubtful"] = std::move(doubtful);
  answer["score"] = score.json(now.rules);
}

}  // namespace oriel::studio
