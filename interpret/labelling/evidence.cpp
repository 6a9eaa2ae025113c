#include "interpret/labelling/evidence.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>

namespace oriel::rules {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The least evidence that could turn what the rules alone decide; it may reach `most`.
double distance_to_turn(const Pack& pack, double min_score,
                        const std::vector<Candidate>& candidates, const Choice& choice) {
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

/// Those that are surely others.
template <class Visit>
void for_each_other(const Links& links, int row, Visit visit) {
  const bool are_certain = links.are_all_certain();
  const auto [begin, end] = links.range_of(row);
  for (std::size_t link = begin; link < end; ++link) {
    const int other = links.other(link);
    if (other != row && (are_certain || links.is_other(row, link) == Truth::yes)) visit(other);
  }
}

int judge_count(const CountRange& typical, int others) {
  if (others < typical.low) return 1;
  return others >= typical.high ? -1 : 0;
}

}  // namespace

std::vector<int> company_of(const Pack& pack, const EvaluationContext& context, int row) {
  std::vector<int> company;
  for (const int relation : pack.decide.evidence.company)
    for_each_other(context.relations[oriel::at(relation)], row,
                   [&](int other) { company.push_back(other); });
  std::ranges::sort(company);
  company.erase(std::unique(company.begin(), company.end()), company.end());
  return company;
}

JointPass::JointPass(const Pack& pack, const EvaluationContext& context,
                     std::vector<std::vector<Candidate>>& candidates,
                     const std::vector<ClassId>& decided)
    : pack_(&pack), context_(&context), candidates_(&candidates), decided_(&decided) {}

std::vector<Weighed> JointPass::run() {
  without_.resize(context_->rows);
  for (const int row : context_->row_numbers) find_close(row);
  std::vector<Weighed> weighed;
  if (close_.empty()) return weighed;
  sort_close();
  prepare();
  settle();
  for (const Close& close : close_) {
    tally(close.row);
    const auto& candidates = (*candidates_)[oriel::at(close.row)];
    Weighed& one = weighed.emplace_back();
    one.row = close.row;
    one.without = without_[oriel::at(close.row)];
    one.with = choose(*pack_, context_->values, candidates);
    for (const Candidate& candidate : candidates)
      if (is_contender(close.row, candidate)) one.evidence.push_back(weigh(candidate));
  }
  return weighed;
}

/// Where no label has changed since, a second look says the same.
void JointPass::settle() {
  int changes = 0;
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    unsettled_.clear();
    for (Close& close : close_) {
      if (close.looked_at == changes) continue;
      if (reconsider(close.row)) {
        unsettled_.push_back(close.row);
        ++changes;
      }
      close.looked_at = changes;
    }
    if (unsettled_.empty()) break;
  }
}

void JointPass::find_close(int row) {
  const auto& candidates = (*candidates_)[oriel::at(row)];
  if (candidates.empty()) return;
  Choice& choice = without_[oriel::at(row)];
  choice = choose(*pack_, context_->values, candidates);
  const double distance = distance_to_turn(*pack_, context_->values.min_score, candidates, choice);
  if (distance < context_->values.evidence) close_.push_back({row, distance});
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
      !candidates.empty() && candidates.front().total() >= context_->values.min_score;
  return is_enough ? rule(candidates.front()).label : (*decided_)[oriel::at(row)];
}

void JointPass::set_label(int row, ClassId label) {
  ClassId& said = labels_[oriel::at(row)];
  if (said != kNoClass) --building_.of[oriel::at(said)];
  if (label != kNoClass) ++building_.of[oriel::at(label)];
  said = label;
}

/// The labels as the rules alone say, and room for what is counted.
void JointPass::prepare() {
  const std::size_t classes = pack_->classes.size();
  labels_.assign(context_->rows, kNoClass);
  building_.of.assign(classes, 0);
  for (const int row : context_->row_numbers) set_label(row, label_of(row));
  seen_.assign(context_->rows, 0);
  company_.of.assign(classes, 0);
  beneath_.resize(classes);
  for (ClassId id = 0; id < static_cast<ClassId>(classes); ++id)
    for (ClassId of = id; of != kNoClass; of = pack_->classes[oriel::at(of)].parent)
      beneath_[oriel::at(of)].push_back(id);
  for (const Class& c : pack_->classes)
    for (const Typical& typical : c.typical) {
      const bool is_there =
          std::ranges::find(counted_, typical.relation, &Tallied::relation) != counted_.end();
      if (typical.relation >= 0 && !is_there)
        counted_.push_back({typical.relation, 0, std::vector<int>(classes, 0)});
    }
}

/// True if the label is another one than before.
bool JointPass::reconsider(int row) {
  tally(row);
  auto& candidates = (*candidates_)[oriel::at(row)];
  for (Candidate& candidate : candidates)
    if (is_contender(row, candidate)) candidate.evidence = weigh(candidate).shift;
  sort_candidates(*pack_, context_->values, candidates);
  const ClassId label = label_of(row);
  const ClassId before = labels_[oriel::at(row)];
  set_label(row, label);
  return label != before;
}

void JointPass::add(int other, Tallied& tallied) const {
  ++tallied.all;
  const ClassId label = labels_[oriel::at(other)];
  if (label != kNoClass) ++tallied.of[oriel::at(label)];
}

/// Counts the others of a feature, once for all its candidates.
void JointPass::tally(int row) {
  row_ = row;
  tally_company(row);
  for (Tallied& tallied : counted_) {
    clear(tallied);
    for_each_other(context_->relations[oriel::at(tallied.relation)], row,
                   [&](int other) { add(other, tallied); });
  }
}

/// An other to which several relations lead is counted once.
void JointPass::tally_company(int row) {
  ++question_;
  clear(company_);
  for (const int relation : pack_->decide.evidence.company)
    for_each_other(context_->relations[oriel::at(relation)], row, [&](int other) {
      int& seen = seen_[oriel::at(other)];
      if (seen != question_) add(other, company_);
      seen = question_;
    });
}

void JointPass::clear(Tallied& tallied) {
  tallied.all = 0;
  std::ranges::fill(tallied.of, 0);
}

int JointPass::count(const Tallied& tallied, ClassId of) const {
  int sum = 0;
  for (const ClassId id : beneath_[oriel::at(of)]) sum += tallied.of[oriel::at(id)];
  return sum;
}

/// Of the feature that was tallied.
Evidence JointPass::weigh(const Candidate& candidate) const {
  Evidence evidence;
  evidence.rule = candidate.rule;
  evidence.company = company_.all;
  evidence.held_by = count(company_, rule(candidate).label);
  ask_counts(rule(candidate).label, evidence);
  double sum = evidence.company_share();
  for (const CountEvidence& counted : evidence.counts) sum += counted.judged;
  evidence.shift = context_->values.evidence * std::clamp(sum, -1.0, 1.0);
  return evidence;
}

/// Of the label and of all that it is a kind of; nothing where there are no others.
void JointPass::ask_counts(ClassId label, Evidence& evidence) const {
  for (ClassId of = label; of != kNoClass; of = pack_->classes[oriel::at(of)].parent) {
    const auto& all = pack_->classes[oriel::at(of)].typical;
    for (std::size_t i = 0; i < all.size(); ++i) {
      int others = 0;
      if (all[i].relation < 0) {
        const bool is_itself = is_within(pack_->classes, labels_[oriel::at(row_)], of);
        others = count(building_, of) - (is_itself ? 1 : 0);
      } else {
        const Tallied& tallied = *std::ranges::find(counted_, all[i].relation, &Tallied::relation);
        if (tallied.all == 0) continue;
        others = count(tallied, of);
      }
      evidence.counts.push_back(
          {of, i, others, judge_count(context_->values.count_of(*pack_, all[i]), others)});
    }
  }
}

}  // namespace oriel::rules
