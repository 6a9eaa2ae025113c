#pragma once

#include "generalise/context.h"
#include "io/document.h"
#include "kernel/base/issue.h"
#include "kernel/base/work.h"
#include "kernel/validate/validate.h"
#include "model/labelled_building.h"
#include "model/solid.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace oriel {

/// What validate() finds for any judge in what as_written() makes of a solid in the place of the
/// polygons of `building`, one of the document: in the very numbers that the file gets.
std::vector<Finding> findings_as_written(const Document& document, const Building& building,
                                         const Solid& solid);

/// The first of these as an error E318; nothing if the solid is valid when it is read again.
std::optional<Issue> check_output(const Document& document, const Building& building,
                                  const Solid& solid);

/// The same of a solid that was redrawn. The error is a G410; if the building was not
/// valid as it was read, and its own solid, nothing done to it, would not be either, a G413.
/// `is_parted`: as WrittenJudge has it.
std::optional<Issue> check_redrawn(const Document& document, const Building& building,
                                   const Solid& own, bool is_parted, const Solid& solid);

/// What stays as it is beside the building's geometry and is not valid (E321): installations with
/// a geometry of their own, and other geometries of its level if it is not redrawn.
std::vector<Issue> invalid_rest(const Document& document, const Building& building,
                                bool is_redrawn);

/// The error G413.
Issue invalid_before(const Building& building, const std::string& why);

/// Returns a solid that is valid as it is written in the place of the polygons of `building`: as it
/// is, or mended, with what is one point in the file welded (weld_written) and facets that would be
/// folded there parted (part_folded); nothing if neither is.
std::optional<Solid> made_valid(const Document& document, const Building& building,
                                const Solid& solid);

/// Mends what is to be written with its labels: what is left of facets is what they were. Whether
/// the rest is valid has to be judged.
void part_written(const Document& document, const Building& building, LabelledBuilding& labelled);

/// Judge of solids to be written in the place of the polygons of a building, whose solid is `own`.
/// Each judgement is counted in the work; once that is used up, or nobody waits, all is unfit, and
/// no work is left. Refers to all that it is made of. `is_parted`: `own` is valid once it is
/// mended, and so will be what is written.
class WrittenJudge : public SolidJudge {
 public:
  WrittenJudge(const Document& document, const Building& building, const Solid& own, bool is_parted,
               Work& work, std::function<bool()> is_given_up = {})
      : document_(document),
        building_(building),
        own_(own),
        is_parted_(is_parted),
        work_(work),
        is_given_up_(std::move(is_given_up)) {}

  Fitness fitness_of(const Solid& solid) override;

 private:
  const Document& document_;
  const Building& building_;
  const Solid& own_;
  bool is_parted_;
  Work& work_;
  std::function<bool()> is_given_up_;
  std::optional<bool> can_be_valid_{};  ///< once it was asked
};

/// What drawing a building for its targets may take: the budget of a stage and half of it, as steps
/// are taken back one by one and all is cut anew each time.
Work drawing_work(std::int64_t budget);

/// E502 of a building that is generalised with that budget.
Issue not_all_drawn(const Building& building, std::int64_t budget);

}  // namespace oriel
