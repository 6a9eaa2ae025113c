#pragma once

#include "interpret/pack/pack.h"

#include <string>
#include <vector>

namespace oriel::rules {

/// An entry of `surfaces:`.
struct SurfaceRule {
  std::string id;
  /// RoofSurface, WallSurface, …
  std::string type;
  /// All of them must hold; over attributes of surfaces.
  std::vector<ExprId> when;
  SourceSpan span;
};

/// `surfaces:`. Its expressions are over surface_schema(), so they have a code, and words, of their
/// own; `pack` has the same source, params and classes as the pack around it.
struct SurfaceRules {
  explicit SurfaceRules(Source source) : pack(std::move(source)) {}

  Pack pack;
  std::vector<SurfaceRule> rules;
};

}  // namespace oriel::rules
