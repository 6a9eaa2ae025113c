#pragma once

#include "studio/editing/layers.h"
#include "studio/editing/text_places.h"

#include <string>
#include <vector>

namespace oriel {

/// A part of a pack's text, for lists of what is in it.
struct OutlineItem {
  /// "section", "param", "class", "predicate", "macro", "relation", "group", "rule", "entry",
  /// "fixture" or "test".
  std::string kind{};
  std::string name{};
  /// The section; empty: it is one itself.
  std::string section{};
  /// Of a class its superclass, of a rule its label; else empty.
  std::string parent{};
  std::string detail{};
  /// From its name to its end, blank lines and comments after it not counted.
  TextSpan where{};
  TextSpan name_span{};
};

namespace rules {

/// What the top layer declares, in the order of the text.
std::vector<OutlineItem> outline_of(const PackLayers& layers);

}  // namespace rules

}  // namespace oriel
