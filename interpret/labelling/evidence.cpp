#include "interpret/labelling/evidence.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace oriel::rules {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The least evidence that could turn what the rules alone decide; it may reach `most`.
double distance_to_turn(const Pack& pack, const std::vector<Candidate>& candidates,
                        const Choice& choice) {
  const double min_score = pack.decide.min_score;
  double distance = kNever;
  if (choice.rule < 0) {
    for (const Candidate& candidate : candidates)
      distance = std::min(distance, min_score - candidate.score);
    return distance;
  }
  const Rule& winner = pack.rules[oriel::at(choice.rule)];
  const double score = candidates.front().score;
  distance = score - min_score;
  for (const Candidate& candidate : candidates) {
    const Rule& rival = pack.rules[oriel::at(candidate.rule)];
    // Both are moved, towards each other.
    if (rival.label != winner.label && rival.priority == winner.priority)
      distance = std::min(distance, (score - candidate.score) / 2);
  }
  return distance;
}

/// How many others are of the class; nothing where there are no others. What is not sure to be an
/// other is none.
std::optional<int> count_others(const Pack& pack, const Links& links, int row,
                                const std::vector<ClassId>& labels, ClassId of) {
  const auto [begin, end] = links.range_of(row);
  std::optional<int> count;
  for (std::size_t link = begin; link < end; ++link) {
    const int other = links.other(link);
    if (other == row || links.is_other(row, link) != Truth::yes) continue;
    count = count.value_or(0) + (is_within(pack.classes, labels[oriel::at(other)], of) ? 1 : 0);
  }
  return count;
}

int judge_count(const Typical& typical, int others) {
  if (others < typical.low) return 1;
  return others >= typical.high ? -1 : 0;
}

}  // namespace

JointPass::JointPass(const Pack& pack, const EvaluationContext& context,
                     std::vector<std::vector<Candidate>>& candidates,
                     const std::vector<ClassId>& decided)
    : pack_(&pack), context_(&context), candidates_(&candidates), decided_(&decided) {}

std::vector<Weighed> JointPass::run() {
  without_.resize(context_->rows);
  for (const int row : context_->row_numbers) find_close(row);
  std::vector<Weighed> weighed;
  if (close_.empty()) return weighed;
  labels_ = *decided_;
  for (const int row : context_->row_numbers) labels_[oriel::at(row)] = label_of(row);
  in_building_.assign(pack_->classes.size(), 0);
  for (const ClassId label : labels_)
    if (label != kNoClass) ++in_building_[oriel::at(label)];
  seen_.assign(context_->rows, 0);
  sort_close();
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    unsettled_.clear();
    for (const Close& close : close_)
      if (reconsider(close.row)) unsettled_.push_back(close.row);
    if (unsettled_.empty()) break;
  }
  for (const Close& close : close_) {
    const auto& candidates = (*candidates_)[oriel::at(close.row)];
    Weighed& one = weighed.emplace_back();
    one.row = close.row;
    one.without = without_[oriel::at(close.row)];
    one.with = choose(*pack_, candidates);
    for (const Candidate& candidate : candidates)
      if (is_contender(close.row, candidate)) one.evidence.push_back(weigh(close.row, candidate));
  }
  return weighed;
}

void JointPass::find_close(int row) {
  const auto& candidates = (*candidates_)[oriel::at(row)];
  if (candidates.empty()) return;
  Choice& choice = without_[oriel::at(row)];
  choice = choose(*pack_, candidates);
  const double distance = distance_to_turn(*pack_, candidates, choice);
  if (distance < pack_->decide.evidence.most) close_.push_back({row, distance});
}

void JointPass::sort_close() {
  std::ranges::sort(close_, [&](const Close& p, const Close& q) {
    const auto key = [&](const Close& close) {
      return std::tuple(close.distance, std::string_view(context_->id_of(close.row)), close.row);
    };
    return key(p) < key(q);
  });
}

/// Candidates of the priority that decides; all of them where none has enough score.
bool JointPass::is_contender(int row, const Candidate& candidate) const {
  const Choice& choice = without_[oriel::at(row)];
  return choice.rule < 0 ||
         rule(candidate).priority == pack_->rules[oriel::at(choice.rule)].priority;
}

/// The class that the first candidate says, else that of an earlier decision.
ClassId JointPass::label_of(int row) const {
  const auto& candidates = (*candidates_)[oriel::at(row)];
  const bool is_enough =
      !candidates.empty() && candidates.front().total() >= pack_->decide.min_score;
  return is_enough ? rule(candidates.front()).label : (*decided_)[oriel::at(row)];
}

void JointPass::set_label(int row, ClassId label) {
  ClassId& said = labels_[oriel::at(row)];
  if (said != kNoClass) --in_building_[oriel::at(said)];
  if (label != kNoClass) ++in_building_[oriel::at(label)];
  said = label;
}

/// True if the label is another one than before.
bool JointPass::reconsider(int row) {
  auto& candidates = (*candidates_)[oriel::at(row)];
  for (Candidate& candidate : candidates)
    if (is_contender(row, candidate)) candidate.evidence = weigh(row, candidate).shift;
  sort_candidates(*pack_, candidates);
  const ClassId label = label_of(row);
  if (label == labels_[oriel::at(row)]) return false;
  set_label(row, label);
  return true;
}

Evidence JointPass::weigh(int row, const Candidate& candidate) {
  Evidence evidence;
  evidence.rule = candidate.rule;
  ask_company(row, rule(candidate).label, evidence);
  ask_counts(row, rule(candidate).label, evidence);
  double sum = evidence.company_share();
  for (const CountEvidence& count : evidence.counts) sum += count.judged;
  evidence.shift = pack_->decide.evidence.most * std::clamp(sum, -1.0, 1.0);
  return evidence;
}

/// An other to which several relations lead is asked once.
void JointPass::ask_company(int row, ClassId label, Evidence& evidence) {
  ++question_;
  for (const int relation : pack_->decide.evidence.company) {
    const Links& links = context_->relations[oriel::at(relation)];
    const auto [begin, end] = links.range_of(row);
    for (std::size_t link = begin; link < end; ++link) {
      const int other = links.other(link);
      if (other == row || seen_[oriel::at(other)] == question_) continue;
      if (links.is_other(row, link) != Truth::yes) continue;
      seen_[oriel::at(other)] = question_;
      ++evidence.company;
      if (is_within(pack_->classes, labels_[oriel::at(other)], label))
        evidence.holders.push_back(other);
    }
  }
}

/// Of the label and of all that it is a kind of.
void JointPass::ask_counts(int row, ClassId label, Evidence& evidence) const {
  for (ClassId of = label; of != kNoClass; of = pack_->classes[oriel::at(of)].parent) {
    const auto& all = pack_->classes[oriel::at(of)].typical;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Typical& typical = all[i];
      std::optional<int> others;
      if (typical.relation >= 0) {
        others = count_others(*pack_, context_->relations[oriel::at(typical.relation)], row,
                              labels_, of);
      } else {
        const bool is_itself = is_within(pack_->classes, labels_[oriel::at(row)], of);
        others = is_itself ? -1 : 0;
        for (ClassId id = 0; id < static_cast<ClassId>(in_building_.size()); ++id)
          if (is_within(pack_->classes, id, of)) *others += in_building_[oriel::at(id)];
      }
      if (others) evidence.counts.push_back({of, i, *others, judge_count(typical, *others)});
    }
  }
}

}  // namespace oriel::rules
