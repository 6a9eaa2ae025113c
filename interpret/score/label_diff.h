#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// What one run said of a feature; both empty where it is unknown.
struct Naming {
  std::string label;
  std::string rule;
  friend auto operator<=>(const Naming&, const Naming&) = default;
};

/// A feature and what a run said of it.
struct NamedFeature {
  std::string building;
  std::string id;
  Naming naming;
};

/// What two runs say of the same features.
class LabelDiff {
 public:
  /// Features that changed in the same way.
  struct LabelChange {
    std::size_t count = 0;
    /// The first of them: building and id.
    std::vector<std::pair<std::string, std::string>> examples;
  };
  /// How many features have a label.
  struct Count {
    std::size_t before = 0;
    std::size_t after = 0;
  };

  /// `most_examples`: so many of each change are kept.
  explicit LabelDiff(std::size_t most_examples = 3) : most_examples_(most_examples) {}

  void add(std::string_view building, std::string_view id, const Naming& before,
           const Naming& after);
  /// A feature that only one run has.
  void add_only_before(const NamedFeature& feature);
  void add_only_after(const NamedFeature& feature);

  /// Features that both runs have.
  [[nodiscard]] std::size_t compared() const { return compared_; }
  /// Those of them that have another label.
  [[nodiscard]] std::size_t changed() const { return changed_; }
  /// Those that have the same label by another rule.
  [[nodiscard]] std::size_t renamed_rules() const { return other_rule_; }
  [[nodiscard]] const LabelChange& only_before() const { return only_before_; }
  [[nodiscard]] const LabelChange& only_after() const { return only_after_; }
  /// What is not the same in both runs: other labels, and features that only one of them has.
  [[nodiscard]] std::size_t differences() const {
    return changed_ + only_before_.count + only_after_.count;
  }

  /// (before, after), where label or rule differ.
  using Changes = std::map<std::pair<Naming, Naming>, LabelChange>;
  [[nodiscard]] const Changes& changes() const { return changes_; }
  /// By label; "" is unknown.
  [[nodiscard]] const std::map<std::string, Count>& counts() const { return counts_; }

 private:
  void note(LabelChange& change, std::string_view building, std::string_view id) const;

  std::size_t most_examples_;
  std::size_t compared_ = 0;
  std::size_t changed_ = 0;
  std::size_t other_rule_ = 0;
  LabelChange only_before_;
  LabelChange only_after_;
  Changes changes_;
  std::map<std::string, Count> counts_;
};

/// Compares two runs. Features are the same if building and id are; of several such in a run the
/// first is compared with the first, and so on. The order of features does not matter.
LabelDiff diff_labels(std::vector<NamedFeature> before, std::vector<NamedFeature> after,
                      std::size_t most_examples = 3);

/// For a terminal: how many labels changed; the classes that gained or lost; each change with its
/// rules, count and examples, the most frequent first.
std::string to_text(const LabelDiff& diff);

/// The same as one JSON object on one line (docs/formats.md).
std::string to_json(const LabelDiff& diff);

}  // namespace oriel
