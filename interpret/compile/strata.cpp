#include "interpret/compile/strata.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// A rule for the class `reader` asks whether something is a `read`.
struct Question {
  ClassId reader = kNoClass;
  ClassId read = kNoClass;
  bool is_strict = false;
  SourceSpan span;
};

bool makes_strict(Op op) {
  return op == Op::negation || op == Op::none || op == Op::count || is_aggregate(op);
}

/// Collects the questions of one rule.
class QuestionFinder {
 public:
  QuestionFinder(const Pack& pack, int rule, std::vector<Question>& questions)
      : pack_(&pack), rule_(rule), questions_(&questions) {}

  void run() {
    const Rule& rule = pack_->rules[oriel::at(rule_)];
    for (const ExprId id : rule.require) visit(id, false);
    for (const ExprId id : rule.unless) visit(id, true);
    for (const ScoreTerm& term : rule.score) visit(term.value, true);
  }

 private:
  void visit(ExprId id, bool is_strict) {
    if (id == kNoExpr) return;
    const Expr& expr = pack_->code[oriel::at(id)];
    if (expr.op == Op::is_class) {
      if (expr.is_previous) return;  // known from the round before
      ask(expr, is_strict);
      return;
    }
    is_strict = is_strict || makes_strict(expr.op);
    for (const ExprId arg : expr.args) visit(arg, is_strict);
    visit(expr.filter, is_strict);
    visit(expr.join, is_strict);
    visit(expr.value, is_strict);
  }

  void ask(const Expr& expr, bool is_strict) {
    const ClassId reader = pack_->rules[oriel::at(rule_)].label;
    for (const ClassId read : members_of(pack_->classes, expr.index)) {
      if (is_refining(expr, reader) && !is_strictly_within(reader, read)) continue;
      const bool is_decided = !pack_->classes[oriel::at(read)].is_abstract;
      const bool is_new = asked_.emplace(read, is_strict || is_decided).second;
      if (is_new) questions_->push_back({reader, read, is_strict || is_decided, expr.span});
    }
  }

  /// A rule for a subclass that asks `self is CLASS` refines that label. Only features that have
  /// it, or one between, can get the subclass, so that the other subclasses do not matter.
  [[nodiscard]] bool is_refining(const Expr& expr, ClassId reader) const {
    const bool is_abstract = pack_->classes[oriel::at(expr.index)].is_abstract;
    return expr.level == 0 && !is_abstract && is_strictly_within(reader, expr.index);
  }
  [[nodiscard]] bool is_strictly_within(ClassId id, ClassId ancestor) const {
    return id != ancestor && is_within(pack_->classes, id, ancestor);
  }

  const Pack* pack_;
  int rule_;
  std::vector<Question>* questions_;
  /// What this rule has asked for; asking again adds nothing.
  std::set<std::pair<ClassId, bool>> asked_;
};

std::vector<Question> find_questions(const Pack& pack) {
  std::vector<Question> questions;
  for (int rule = 0; rule < static_cast<int>(pack.rules.size()); ++rule)
    QuestionFinder(pack, rule, questions).run();
  return questions;
}

/// The questions that lead from class `from` to class `to` inside one component, the fewest.
std::vector<Question> find_path(ClassId from, ClassId to, const std::vector<Question>& questions,
                                const std::vector<int>& component) {
  std::vector<const Question*> came_by(component.size(), nullptr);
  std::deque<ClassId> waiting = {from};
  std::vector<bool> is_seen(component.size(), false);
  is_seen[oriel::at(from)] = true;
  while (!waiting.empty() && !is_seen[oriel::at(to)]) {
    const ClassId at = waiting.front();
    waiting.pop_front();
    for (const Question& q : questions) {
      const bool is_step =
          q.reader == at && component[oriel::at(q.read)] == component[oriel::at(from)];
      if (!is_step || is_seen[oriel::at(q.read)]) continue;
      is_seen[oriel::at(q.read)] = true;
      came_by[oriel::at(q.read)] = &q;
      waiting.push_back(q.read);
    }
  }
  std::vector<Question> path;
  for (ClassId at = to; at != from; at = path.back().reader)
    path.push_back(*came_by[oriel::at(at)]);
  std::ranges::reverse(path);
  return path;
}

std::string describe(const Pack& pack, const Question& q) {
  const Place place = pack.source.place(q.span.begin);
  return fmt::format("'{}' asks for '{}' ({}:{}:{})", pack.classes[oriel::at(q.reader)].name,
                     pack.classes[oriel::at(q.read)].name, place.file, place.line, place.column);
}

/// A predicate above a decided class that could be asked for in its place.
std::string suggest_cut(const Pack& pack, const Question& q) {
  ClassId above = pack.classes[oriel::at(q.read)].parent;
  while (above != kNoClass) {
    const Class& c = pack.classes[oriel::at(above)];
    if (c.is_abstract && c.has_rules && above != q.reader)
      return fmt::format("; to break the cycle ask for '{}' in place of '{}'", c.name,
                         pack.classes[oriel::at(q.read)].name);
    above = c.parent;
  }
  return "; to break the cycle ask for an abstract class there, one that is found by its shape";
}

void report_circle(const Pack& pack, const Question& strict, const std::vector<Question>& questions,
                   const std::vector<int>& component, Findings& findings) {
  std::string circle = describe(pack, strict);
  for (const Question& q : find_path(strict.read, strict.reader, questions, component))
    circle += ", " + describe(pack, q);
  const char* reason = pack.classes[oriel::at(strict.read)].is_abstract
                           ? "not, none, count, unless and scores ask for what is known already"
                           : "a label is decided before it is asked for";
  findings.error(
      Code::R243, strict.span,
      "these rules depend on each other: " + circle + "; " + reason + suggest_cut(pack, strict));
}

/// One error for every component with a strict question inside; true if there is none.
bool check_circles(const Pack& pack, const std::vector<Question>& questions,
                   const std::vector<int>& component, Findings& findings) {
  std::vector<int> reported;
  for (const Question& q : questions) {
    const int c = component[oriel::at(q.read)];
    const bool is_inside = q.is_strict && c == component[oriel::at(q.reader)];
    if (!is_inside || std::ranges::find(reported, c) != reported.end()) continue;
    reported.push_back(c);
    report_circle(pack, q, questions, component, findings);
  }
  return reported.empty();
}

/// The stratum of every component. They are numbered so that what is waited for comes first.
std::vector<int> find_levels(const Pack& pack, std::vector<Question> questions,
                             const Components& components) {
  const auto component = [&](ClassId id) { return components.of_node[oriel::at(id)]; };
  std::ranges::stable_sort(questions, {}, [&](const Question& q) { return component(q.reader); });
  std::vector<int> levels(oriel::at(components.count), 0);
  for (const Question& q : questions) {
    const int step = pack.classes[oriel::at(q.read)].is_abstract ? 0 : 1;
    int& level = levels[oriel::at(component(q.reader))];
    level = std::max(level, levels[oriel::at(component(q.read))] + step);
  }
  return levels;
}

/// One step for each component of predicates, in their order, and after those of a stratum one for
/// its decision.
void make_steps(Pack& pack, const std::vector<Question>& questions, const Components& components) {
  const std::vector<int> levels = find_levels(pack, questions, components);
  const int last = levels.empty() ? -1 : *std::ranges::max_element(levels);
  std::vector<RuleStep> predicates(oriel::at(components.count));
  std::vector<RuleStep> decisions(oriel::at(last + 1));
  for (int rule = 0; rule < static_cast<int>(pack.rules.size()); ++rule) {
    const ClassId label = pack.rules[oriel::at(rule)].label;
    const int c = components.of_node[oriel::at(label)];
    const bool is_predicate = pack.classes[oriel::at(label)].is_abstract;
    RuleStep& step =
        is_predicate ? predicates[oriel::at(c)] : decisions[oriel::at(levels[oriel::at(c)])];
    step.is_decision = !is_predicate;
    step.rules.push_back(rule);
  }
  for (const Question& q : questions) {
    const int c = components.of_node[oriel::at(q.reader)];
    if (c == components.of_node[oriel::at(q.read)]) predicates[oriel::at(c)].is_recursive = true;
  }
  const auto add = [&](RuleStep& step) {
    if (!step.rules.empty()) pack.steps.push_back(std::move(step));
  };
  for (int level = 0; level <= last; ++level) {
    for (int c = 0; c < components.count; ++c)
      if (levels[oriel::at(c)] == level) add(predicates[oriel::at(c)]);
    add(decisions[oriel::at(level)]);
  }
}

bool asks_for_subclass(const Pack& pack, ExprId id, ClassId ancestor, ClassId label) {
  const Expr& expr = pack.code[oriel::at(id)];
  if (expr.op == Op::all_of)
    return std::ranges::any_of(
        expr.args, [&](ExprId arg) { return asks_for_subclass(pack, arg, ancestor, label); });
  return expr.op == Op::is_class && expr.level == 0 && expr.index != label &&
         is_within(pack.classes, expr.index, ancestor);
}

/// R245: see find_strata.
void check_tree(const Pack& pack, Findings& findings) {
  for (const Rule& rule : pack.rules) {
    ClassId above = pack.classes[oriel::at(rule.label)].parent;
    const auto is_predicate = [&](ClassId id) {
      return pack.classes[oriel::at(id)].is_abstract && pack.classes[oriel::at(id)].has_rules;
    };
    while (above != kNoClass && !is_predicate(above)) above = pack.classes[oriel::at(above)].parent;
    const bool is_asked = above == kNoClass || std::ranges::any_of(rule.require, [&](ExprId id) {
                            return asks_for_subclass(pack, id, above, rule.label);
                          });
    if (is_asked) continue;
    const std::string& name = pack.classes[oriel::at(above)].name;
    findings.error(Code::R245, rule.span,
                   fmt::format("'{}' is a kind of '{}', which has rules of its own: require 'self "
                               "is {}'",
                               pack.classes[oriel::at(rule.label)].name, name, name));
  }
}

constexpr int kUnseen = -1;

class Tarjan {
 public:
  Tarjan(int nodes, const std::vector<std::pair<int, int>>& edges)
      : targets_(oriel::at(nodes)), order_(oriel::at(nodes), kUnseen), low_(oriel::at(nodes), 0) {
    for (const auto& [from, to] : edges) targets_[oriel::at(from)].push_back(to);
    result_.of_node.assign(oriel::at(nodes), kUnseen);
  }

  Components run() {
    for (int node = 0; node < static_cast<int>(order_.size()); ++node)
      if (order_[oriel::at(node)] == kUnseen) visit(node);
    return result_;
  }

 private:
  struct OpenNode {
    int node = 0;
    std::size_t next = 0;
  };

  void enter(int node) {
    order_[oriel::at(node)] = low_[oriel::at(node)] = seen_++;
    stack_.push_back(node);
    open_.push_back({node, 0});
  }

  void visit(int root) {
    enter(root);
    while (!open_.empty()) {
      OpenNode& at = open_.back();
      if (at.next == targets_[oriel::at(at.node)].size()) {
        leave();
        continue;
      }
      const int target = targets_[oriel::at(at.node)][at.next++];
      if (order_[oriel::at(target)] == kUnseen)
        enter(target);
      else if (result_.of_node[oriel::at(target)] == kUnseen)
        low_[oriel::at(at.node)] = std::min(low_[oriel::at(at.node)], order_[oriel::at(target)]);
    }
  }

  void leave() {
    const int node = open_.back().node;
    open_.pop_back();
    if (!open_.empty()) {
      int& low = low_[oriel::at(open_.back().node)];
      low = std::min(low, low_[oriel::at(node)]);
    }
    if (low_[oriel::at(node)] != order_[oriel::at(node)]) return;
    int member = kUnseen;
    while (member != node) {
      member = stack_.back();
      stack_.pop_back();
      result_.of_node[oriel::at(member)] = result_.count;
    }
    ++result_.count;
  }

  std::vector<std::vector<int>> targets_;
  std::vector<int> order_;
  std::vector<int> low_;
  std::vector<int> stack_;
  std::vector<OpenNode> open_;
  int seen_ = 0;
  Components result_;
};

}  // namespace

std::vector<ClassId> members_of(const std::vector<Class>& classes, ClassId id) {
  const Class& c = classes[oriel::at(id)];
  if (c.is_abstract && c.has_rules) return {id};
  std::vector<ClassId> members;
  for (ClassId other = 0; other < static_cast<ClassId>(classes.size()); ++other)
    if (is_within(classes, other, id)) members.push_back(other);
  return members;
}

void find_strata(Pack& pack, Findings& findings) {
  check_tree(pack, findings);
  const std::vector<Question> questions = find_questions(pack);
  std::vector<std::pair<int, int>> edges;
  edges.reserve(questions.size());
  for (const Question& q : questions) edges.emplace_back(q.reader, q.read);
  const Components components = find_components(static_cast<int>(pack.classes.size()), edges);
  if (check_circles(pack, questions, components.of_node, findings))
    make_steps(pack, questions, components);
}

Components find_components(int nodes, const std::vector<std::pair<int, int>>& edges) {
  return Tarjan(nodes, edges).run();
}

}  // namespace oriel::rules
