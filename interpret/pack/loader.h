#pragma once

#include "interpret/compile/checker.h"
#include "interpret/language/findings.h"
#include "interpret/pack/names.h"
#include "interpret/pack/pack.h"
#include "interpret/yaml/yaml_tree.h"
#include "model/plan.h"

#include <optional>
#include <string>

namespace oriel::rules {

/// What the readers of a pack's sections share. Every reader takes its section's node, adds what
/// it says to `pack` and what is wrong with it to `findings`, and goes on after an error: all
/// findings come at once.
struct Loader {
  Loader(Pack& p, Findings& f) : pack(p), findings(f), checker(p, names, f) {}

  Pack& pack;
  Findings& findings;
  Names names;
  Checker checker;
};

void read_header(const YamlNode& node, Loader& loader);
void read_params(const YamlNode& node, Loader& loader);
void read_classes(const YamlNode& node, Loader& loader);
void read_macros(const YamlNode& node, Loader& loader);
void read_hosts(const YamlNode& node, Loader& loader);
void read_relations(const YamlNode& node, Loader& loader);
void read_groups(const YamlNode& node, Loader& loader);
void read_rules(const YamlNode& node, Loader& loader);
void read_decide(const YamlNode& node, Loader& loader);
void read_iterate(const YamlNode& node, Loader& loader);
void read_emit(const YamlNode& node, Loader& loader);
void read_surfaces(const YamlNode& node, Loader& loader);
void read_generalise(const YamlNode& node, Loader& loader);
void read_invariants(const YamlNode& node, Loader& loader);

/// What `invariants:` of a pack or a profile says: a map of numbers above 0. Of what is wrong with
/// it findings as of a YamlSection, and R211.
Limits read_limits(const YamlNode& node, Findings& findings);

/// True if `node` can name something new; else an error R216 that calls it `what`.
bool expect_name(const YamlNode& node, const std::string& what, Findings& findings);

/// The number of the relation called by `node`, with _ or blanks between its words, or -1 and R207.
int read_relation(const YamlNode& node, const std::string& what, Loader& loader);

/// The class called by `node`, or kNoClass and R205.
ClassId read_class(const YamlNode& node, const std::string& what, Loader& loader);

/// A constant lo .. hi of the given dimension (any, if none is given), both folded; or nothing and
/// an error. R212 if lo is above hi.
struct FixedRange {
  double low = 0;
  double high = 0;
  Dimension dimension;
  ExprId low_expr = kNoExpr;
  ExprId high_expr = kNoExpr;
};
std::optional<FixedRange> read_range(const YamlNode& node, std::optional<Dimension> dimension,
                                     Loader& loader);

/// A constant of the given dimension (any, if none is given), folded; or nothing and an error.
struct FixedValue {
  double value = 0;
  Dimension dimension;
  ExprId expr = kNoExpr;
};
std::optional<FixedValue> read_quantity(const YamlNode& node, std::optional<Dimension> dimension,
                                        Loader& loader);

/// The same, not folded: it may depend on the scale.
ExprId read_constant(const YamlNode& node, std::optional<Dimension> dimension, Loader& loader);

/// The condition in `node`, or kNoExpr and an error.
ExprId read_condition(const YamlNode& node, Loader& loader);

}  // namespace oriel::rules
