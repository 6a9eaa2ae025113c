#pragma once

#include "interpret/language/expr.h"
#include "interpret/language/source.h"
#include "kernel/base/name.h"
#include "model/plan.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel::rules {

using ClassId = int;
inline constexpr ClassId kNoClass = -1;

struct Param {
  std::string name;
  double value = 0;
  Dimension dimension;
  std::optional<std::pair<double, double>> range;
  std::string why;
  SourceSpan span;
  SourceSpan value_span;
};

/// How many of a class there are as a rule: `typical: {per storey: 2 .. 12}`.
struct Typical {
  /// "storey", "facade" or "building".
  std::string per;
  ExprId low = kNoExpr;
  /// kNoExpr: no end.
  ExprId high = kNoExpr;
  SourceSpan span;
  /// The relation that leads to the others of the storey or the facade; -1: those of the building.
  int relation = -1;
};

/// How objects of a class are written: `emit:`.
struct Emission {
  /// SIG3D's class of building installations on the outside of a building.
  static constexpr std::string_view kUsualClass = "1000";
  static constexpr std::string_view kUsualTop = "RoofSurface";

  std::string type;
  std::string class_code;
  /// Code list -> code.
  std::map<std::string, std::string> function;
  /// What its faces that look up are.
  std::string top{kUsualTop};
};

struct Class {
  std::string name;
  ClassId parent = kNoClass;
  bool is_abstract = false;
  /// True if a rule names it as its label. An abstract class without rules is the union of its
  /// subclasses.
  bool has_rules = false;
  /// What a feature of it is, too: itself first, then what is the union of its subclasses. Found
  /// when all of the pack is read.
  std::vector<ClassId> raised;
  std::vector<Typical> typical;
  std::optional<Emission> emission;
  SourceSpan span;
};

/// A ramp from 0 to 1 (rise) or from 1 to 0 (fall).
struct Ramp {
  ExprId from = kNoExpr;
  ExprId to = kNoExpr;
};

/// One term of a score: a number judged by its ramps, or a condition (1 if it holds, else 0).
struct ScoreTerm {
  ExprId value = kNoExpr;
  std::optional<Ramp> rise;
  std::optional<Ramp> fall;
  double weight = 1;
};

struct Rule {
  std::string id;
  ClassId label = kNoClass;
  /// The label as verdicts carry it, once the pack is read.
  Name name_of_label;
  int priority = 0;
  std::vector<ExprId> require;
  std::vector<ExprId> unless;
  std::vector<ScoreTerm> score;
  SourceSpan span;
};

/// The id of a rule and its label as verdicts carry them.
struct NamesOfRule {
  Name id;
  Name label;
};

/// Rules that are run together: those of one strongly connected component of predicates, or all
/// rules of one stratum that compete for the label.
struct RuleStep {
  bool is_decision = false;
  /// Predicates that need each other run to their least fixpoint.
  bool is_recursive = false;
  /// Indices into Pack::rules.
  std::vector<int> rules;
};

/// An angle's range that makes a facet a wall, a roof or a ground; kNoExpr: it was not written.
struct HostRange {
  ExprId low = kNoExpr;
  ExprId high = kNoExpr;
};

/// `hosts:`. What was not written is as PackValues has it.
struct Hosts {
  HostRange wall, roof, ground;
  ExprId ground_reach = kNoExpr;
};

/// How much the labels of its others count for a feature: `decide: {evidence, company}`.
struct EvidenceSettings {
  /// The most that a score is moved by; kNoExpr: it was not written.
  ExprId most = kNoExpr;
  /// The numbers of the relations that lead to what is comparable.
  std::vector<int> company;
  SourceSpan span;

  [[nodiscard]] bool is_written() const { return most != kNoExpr; }
};

struct Decide {
  ExprId min_score = kNoExpr;
  ExprId ambiguous_below = kNoExpr;
  EvidenceSettings evidence;
};

/// What a relation asks of its pairs.
struct RelationSides {
  /// The conditions on self alone, on the other alone, and on both.
  std::vector<ExprId> of_self, of_other, of_both;
  /// If they ask both for the same and for equal values, and for nothing else: these values, of
  /// self.
  std::optional<std::vector<ExprId>> keys;
};

/// A relation that the pack declares: the pairs of another one for which a condition holds.
/// Relations are numbered: those of relation_schema(), then those of the pack in their order.
struct RelationDefinition {
  std::string name;
  /// The number of the relation that it narrows, below its own.
  int within = -1;
  /// Over self (level 0) and other (level 1); neither classes nor quantifiers stand in it.
  ExprId where = kNoExpr;
  /// What `where` says, once the pack is read.
  RelationSides sides;
  SourceSpan span;
};

/// Features of a class that hang together by a relation: `groups:`.
struct GroupKind {
  std::string name;
  ClassId of = kNoClass;
  /// The number of the relation.
  int by = -1;
  int at_least = 2;
  SourceSpan span;
};

/// An entry of `generalise:`.
struct GeneraliseEntry {
  std::string id;
  double scale_from = 0;
  double scale_to = 0;
  /// kNoClass: any feature.
  ClassId target = kNoClass;
  /// The members of the groups of this kind (Pack::groups) in place of a class, or -1.
  int group = -1;
  ExprId when = kNoExpr;
  std::string operation;
  /// The operator's arguments: constants, or words.
  struct Argument {
    std::string name;
    ExprId value = kNoExpr;
    std::string word;
  };
  std::vector<Argument> arguments;
  /// What goes along with a feature that leaves its place: the number of a relation that leads to
  /// it, or -1; its class, kNoClass: what has no label; and what becomes of it when the feature is
  /// drawn again.
  int with = -1;
  ClassId with_of = kNoClass;
  Belonging with_as = Belonging::goes;
  SourceSpan span;
};

struct SurfaceRules;

/// A pack, checked: every name is looked up and every expression has a type.
/// What a pack reads of a building.
struct Reads {
  /// Columns of texts and of numbers, yes/no included.
  std::vector<std::size_t> texts;
  std::vector<std::size_t> numbers;
  /// By number: whether an expression or a group leads over the relation, or one that narrows it.
  std::vector<bool> relations;
  /// Pack::words, each with its number.
  std::map<std::string, std::size_t, std::less<>> words;
};

struct Pack {
  explicit Pack(Source text) : source(std::move(text)) {}

  Source source;
  std::string sha256;
  std::string name;
  std::string version;
  Hosts hosts;
  std::vector<Param> params;
  std::vector<Class> classes;
  std::vector<RelationDefinition> relations;
  std::vector<GroupKind> groups;
  std::vector<Rule> rules;
  /// Parallel to `rules`; once the pack is read.
  std::vector<NamesOfRule> names_of_rules;
  std::vector<RuleStep> steps;
  Decide decide;
  /// How often the pack is run at most; 0: once, without `iterate:`.
  int rounds = 0;
  std::vector<GeneraliseEntry> entries;
  Limits limits;  ///< `invariants:`
  /// Null: the pack says nothing of surfaces but `hosts:`.
  std::shared_ptr<const SurfaceRules> surfaces;
  ExprList code;
  /// The words that texts are compared with; the value of a text is the number of its word.
  std::vector<std::string> words;
  /// Found when all of it is read.
  Reads reads;
};

/// True if `id` is `ancestor` or beneath it.
inline bool is_within(const std::vector<Class>& classes, ClassId id, ClassId ancestor) {
  while (id != kNoClass && id != ancestor) id = classes[static_cast<std::size_t>(id)].parent;
  return id == ancestor && id != kNoClass;
}

}  // namespace oriel::rules
