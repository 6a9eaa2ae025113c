#pragma once

#include "generalise/invariants/invariants.h"
#include "kernel/base/issue.h"
#include "kernel/io/document.h"
#include "kernel/model/labelled_building.h"
#include "kernel/model/solid.h"

#include <optional>

namespace oriel {

/// Whether a solid is valid when it is read again.
struct OutputCheck {
  int digits = 0;               ///< LabelledBuilding::digits that it takes, the fewest
  std::optional<Issue> fault;   ///< E318: it is not, whatever the scale; the first finding says why
  std::optional<Issue> excuse;  ///< G413, a warning: it is not, but could not have been either
};

/// Judges `solid` in the place of the polygons of `building`, one of the document, by validate() on
/// what as_written() makes of it, first at the scale that the document has.
OutputCheck check_output(const Document& document, const Building& building, const Solid& solid);

/// The same of a solid that was redrawn. Its fault is a G410; if the building was not valid as it
/// was read and its own solid, nothing done to it, would not be either, that is its excuse.
OutputCheck check_redrawn(const Document& document, const Building& building, const Solid& own,
                          const Solid& solid);

/// The warning G413.
Issue invalid_before(const Building& building, const std::string& why);

/// Of what is to be written in the place of the polygons of `building`, welds what the file's grid
/// makes one point (weld_written), and parts facets that would be folded there (part_folded), if
/// nothing else is wrong; what is left of facets is what they were.
void part_written(const Document& document, const Building& building, LabelledBuilding& labelled);

/// A judge of solids to be written in the place of the polygons of `building`, whose solid is
/// `own`; all must outlive it.
SolidValidator judge_as_written(const Document& document, const Building& building,
                                const Solid& own, bool is_thorough);

}  // namespace oriel
