#pragma once

#include "interpret/language/findings.h"
#include "studio/editing/text_places.h"

#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// A change that takes a finding away.
struct QuickFix {
  std::string title{};  ///< "replace 'heigth' by 'height'"
  std::vector<TextEdit> edits{};
};

namespace rules {

/// What the sentence of `finding` suggests, such as "did you mean 'height'?" or "write '<='", as
/// changes of `text`, in which its span counts. The words of the sentence are read, so that what is
/// offered and what is said are the same. Nothing where a person has to decide.
std::vector<QuickFix> fixes_of(std::string_view text, const SpannedFinding& finding);

}  // namespace rules

}  // namespace oriel
