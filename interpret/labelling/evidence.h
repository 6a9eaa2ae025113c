#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/labelling/candidates.h"
#include "interpret/pack/pack.h"

#include <cstddef>
#include <vector>

namespace oriel::rules {

/// How many others of a feature are of a class in its storey, on its facade or in its building, and
/// what the pack says is typical.
struct CountEvidence {
  ClassId of = kNoClass;
  /// An index into Class::typical.
  std::size_t typical = 0;
  int others = 0;
  /// 1 where fewer than typical are there, -1 where there would be more with the feature, else 0.
  int judged = 0;
};

/// What the others of a feature say of one candidate for its label.
struct Evidence {
  /// An index into Pack::rules.
  int rule = -1;
  /// What it adds to the score or takes from it.
  double shift = 0;
  /// The others by the relations that are company, and those of them that hold the label.
  std::size_t company = 0;
  std::vector<int> holders;
  std::vector<CountEvidence> counts;

  /// 0…1; 0 without company.
  [[nodiscard]] double company_share() const {
    if (company == 0) return 0;
    return static_cast<double>(holders.size()) / static_cast<double>(company);
  }
};

/// A feature that was weighed: its decision was close.
struct Weighed {
  int row = -1;
  /// What the rules alone would have decided, and what was.
  Choice without, with;
  std::vector<Evidence> evidence;
};

/// Joint evidence in one decision of a building. Every decision that is close is made again with
/// what the labels of the others say: how many of its company hold a label, and whether as many are
/// typical. Those others may be close ones, too, so that this goes on until nothing changes, the
/// closest first, ties by id; after kMostSweeps it stops. A score is moved by `decide: evidence`
/// at most: what no evidence could turn is not looked at and stays as it is.
class JointPass {
 public:
  static constexpr int kMostSweeps = 8;

  /// `candidates` by row, sorted; `decided` are the labels of earlier decisions.
  JointPass(const Pack& pack, const EvaluationContext& context,
            std::vector<std::vector<Candidate>>& candidates, const std::vector<ClassId>& decided);

  /// Sets the evidence of candidates and sorts them anew. Returns what was weighed.
  std::vector<Weighed> run();

  /// The rows whose labels the last sweep still changed.
  [[nodiscard]] const std::vector<int>& unsettled() const { return unsettled_; }

 private:
  struct Close {
    int row = -1;
    /// The least evidence that could turn it.
    double distance = 0;
  };

  void find_close(int row);
  void sort_close();
  bool reconsider(int row);
  [[nodiscard]] Evidence weigh(int row, const Candidate& candidate);
  void ask_company(int row, ClassId label, Evidence& evidence);
  void ask_counts(int row, ClassId label, Evidence& evidence) const;
  [[nodiscard]] bool is_contender(int row, const Candidate& candidate) const;
  [[nodiscard]] ClassId label_of(int row) const;
  void set_label(int row, ClassId label);

  [[nodiscard]] const Rule& rule(const Candidate& candidate) const {
    return pack_->rules[static_cast<std::size_t>(candidate.rule)];
  }

  const Pack* pack_;
  const EvaluationContext* context_;
  std::vector<std::vector<Candidate>>* candidates_;
  const std::vector<ClassId>* decided_;
  /// By row: the label as it stands.
  std::vector<ClassId> labels_;
  /// By class: how many features of the building have that very label.
  std::vector<int> in_building_;
  std::vector<Close> close_;
  /// What the rules alone decide of the close ones, by row; for others not looked at.
  std::vector<Choice> without_;
  /// By row: the number of the last question that it was counted for.
  std::vector<int> seen_;
  int question_ = 0;
  std::vector<int> unsettled_;
};

}  // namespace oriel::rules
