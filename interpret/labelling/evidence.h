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
  /// How many others the relations that are company lead to, and how many hold the label.
  int company = 0;
  int held_by = 0;
  std::vector<CountEvidence> counts;

  /// 0…1; 0 without company.
  [[nodiscard]] double company_share() const {
    if (company == 0) return 0;
    return static_cast<double>(held_by) / company;
  }
};

/// A feature that was weighed: its decision was close.
struct Weighed {
  int row = -1;
  /// What the rules alone would have decided, and what was.
  Choice without, with;
  std::vector<Evidence> evidence;
  /// The number of the decision among those in which something was weighed.
  std::size_t decision = 0;
};

/// The company of a feature, each once.
std::vector<int> company_of(const Pack& pack, const EvaluationContext& context, int row);

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

  /// By row: the label that came of it, or -1; empty where nothing was close.
  [[nodiscard]] const std::vector<ClassId>& labels() const { return labels_; }
  /// The rows whose labels the last sweep still changed.
  [[nodiscard]] const std::vector<int>& unsettled() const { return unsettled_; }

 private:
  struct Close {
    int row = -1;
    /// The least evidence that could turn it.
    double distance = 0;
    /// How many labels had changed when it was looked at.
    int looked_at = -1;
  };

  /// Others of a feature by what they are labelled.
  struct Tallied {
    /// The relation that leads to them; -1: no single one.
    int relation = -1;
    int all = 0;
    /// By class: how many have that very label.
    std::vector<int> of;
  };

  void find_close(int row);
  void sort_close();
  void prepare();
  void settle();
  bool reconsider(int row);
  void tally(int row);
  void tally_company(int row);
  void add(int other, Tallied& tallied) const;
  static void clear(Tallied& tallied);
  [[nodiscard]] int count(const Tallied& tallied, ClassId of) const;
  [[nodiscard]] Evidence weigh(const Candidate& candidate) const;
  void ask_counts(ClassId label, Evidence& evidence) const;
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
  /// The others of the feature at hand: its company, all others of the building, and those of each
  /// relation along which something is counted.
  Tallied company_, building_;
  std::vector<Tallied> counted_;
  /// The feature at hand.
  int row_ = -1;
  /// By class: itself and those beneath it.
  std::vector<std::vector<ClassId>> beneath_;
  std::vector<Close> close_;
  /// What the rules alone decide of the close ones, by row; for others not looked at.
  std::vector<Choice> without_;
  /// By row: the number of the last question that it was counted for.
  std::vector<int> seen_;
  int question_ = 0;
  std::vector<int> unsettled_;
};

}  // namespace oriel::rules
