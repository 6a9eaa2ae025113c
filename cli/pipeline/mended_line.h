#pragma once

#include "cli/commands/options.h"
#include "cli/pipeline/line.h"
#include "kernel/io/document.h"

#include <optional>

namespace oriel::cli {

/// A building down the whole line as the arguments say, with its surfaces where there are rules.
OnLine run_whole_line(const LineArguments& arguments, const RuleBase* rules,
                      const Building& building, const Tolerances& tolerances, Timings& timings);

/// The same for a building that has come to its solid already, or to none.
OnLine whole_line_from(OnLine solid, const LineArguments& arguments, const RuleBase* rules,
                       const Building& building, const Tolerances& tolerances, Timings& timings);

/// The solid of a building whose own solid would not be valid as it is written: its surface runs
/// through itself, say. It becomes the boundary of its inside (Crossings::cut_closed), and facets
/// that are folded in the file are parted (part_folded), with the tolerances given, or finer or up
/// to five times coarser ones if they do not help. Nothing if none makes it valid.
struct MendedSolid {
  OnLine line;     ///< as far as the solid; `tolerances` are those it was made with
  int digits = 0;  ///< LabelledBuilding::digits that it takes
};
std::optional<MendedSolid> mended_solid(const LineArguments& arguments, const Document& document,
                                        const Building& building, const Tolerances& tolerances,
                                        Timings& timings);

/// The building on the whole line with its mended_solid(), and a warning G417 that says so.
std::optional<OnLine> mended_line(const LineArguments& arguments, const RuleBase* rules,
                                  const Document& document, const Building& building,
                                  const OnLine& line, Timings& timings);

}  // namespace oriel::cli
