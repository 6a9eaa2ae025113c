#pragma once

#include "interpret/language/findings.h"
#include "interpret/pack/pack.h"

#include <utility>
#include <vector>

namespace oriel::rules {

/// Finds in which order the rules of `pack` are to be run, and sets `pack.steps`.
///
/// A rule waits for the classes its conditions ask for. The strongly connected components of that
/// graph run one after the other, each after what it waits for. Inside a component only positive
/// questions for predicates (abstract classes) are allowed, so that it has one least fixpoint; a
/// question below `not`, `none`, `count`, `unless` or a score, or for a decided label, is strict: a
/// strict one inside a component is an error R243 that shows the circle with every place.
///
/// Labels are decided in strata: a class is in the stratum after those of all labels it asks for.
/// Rules of one stratum compete.
///
/// Also R245: a rule for a subclass of a predicate must ask for the predicate, so that the class
/// tree holds.
void find_strata(Pack& pack, Findings& findings);

/// The classes whose members make up `id`: itself, if it has rules of its own and is abstract; else
/// itself and all classes beneath it.
std::vector<ClassId> members_of(const std::vector<Class>& classes, ClassId id);

/// The strongly connected components of a graph. Numbered so that an edge leads to the same or to a
/// lower number.
struct Components {
  int count = 0;
  /// The component of every node.
  std::vector<int> of_node;
};

/// Tarjan 1972, without recursion. Nodes are 0 … nodes - 1, edges lead from first to second.
Components find_components(int nodes, const std::vector<std::pair<int, int>>& edges);

}  // namespace oriel::rules
