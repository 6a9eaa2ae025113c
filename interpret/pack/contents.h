#pragma once

#include "interpret/pack/rule_base.h"
#include "kernel/base/issue.h"

#include <string>
#include <vector>

namespace oriel {

/// A class of a pack.
struct ClassOfPack {
  std::string name;
  /// Its place in classes_of(), or -1.
  int parent = -1;
  bool is_abstract = false;
  Place place;
};

/// A rule of a pack.
struct RuleOfPack {
  std::string id;
  std::string label;
  Place place;
};

/// The classes of the pack, abstract ones too, in its order.
std::vector<ClassOfPack> classes_of(const RuleBase& base);

/// The rules of the pack, in its order.
std::vector<RuleOfPack> rules_of(const RuleBase& base);

/// Where each of params_of() stands, in their order.
std::vector<Place> places_of_params(const RuleBase& base);

/// True if it is certain that interpret() gives any building the same verdicts and groups with both
/// packs: what they say of features and labels is the same, word by word, and so are the values of
/// their params. Comments, reasons, `emit:`, `surfaces:`, `generalise:` and `invariants:` may
/// differ.
bool is_labelling_alike(const RuleBase& one, const RuleBase& other);

}  // namespace oriel
