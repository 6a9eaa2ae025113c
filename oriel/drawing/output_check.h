#pragma once

#include "generalise/context.h"
#include "io/document.h"
#include "kernel/base/issue.h"
#include "kernel/base/work.h"
#include "kernel/validate/part_folded.h"
#include "kernel/validate/validate.h"
#include "model/labelled_building.h"
#include "model/solid.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace oriel {

/// Judges solids in the place of the polygons of a building, in the very numbers that the file
/// gets: each solid once, however often it is asked for. Refers to the document and the building.
class OutputCheck {
 public:
  OutputCheck(const Document& document, const Building& building)
      : document_(document), building_(building) {}

  [[nodiscard]] const Document& document() const { return document_; }
  [[nodiscard]] const Building& building() const { return building_; }

  /// Returns what validate() finds in the building as it was read.
  const std::vector<Finding>& findings_as_read();
  /// Returns what validate() finds for any judge in what as_written() makes of the solid.
  const std::vector<Finding>& findings(const Solid& solid);
  /// Returns the first of these as an error E318; nothing if the solid is valid when it is read
  /// again.
  std::optional<Issue> fault(const Solid& solid);
  /// Returns the same of a solid that was redrawn. The error is a G410; if the building cannot be
  /// valid a G413. `own` and `is_parted`: as WrittenJudge has them.
  std::optional<Issue> fault_of_redrawn(const Solid& own, bool is_parted, const Solid& solid);
  /// Says whether the building was valid as it was read, or its own solid, nothing done to it, is.
  bool can_be_valid(const Solid& own);

  /// Returns a solid that is valid as it is written: as it is, or mended, with what is one point in
  /// the file welded (weld_written) and facets that would be folded there parted (part_folded);
  /// nothing if neither is.
  std::optional<Solid> made_valid(Solid solid);
  /// Mends what is to be written with its labels: what is left of facets is what they were. Whether
  /// the rest is valid has to be judged.
  void part(LabelledBuilding& labelled);

 private:
  struct Judged {
    Solid solid;
    std::vector<Finding> findings;
  };

  std::optional<PartedSolid> parted_once(const Solid& solid);

  const Document& document_;
  const Building& building_;
  std::optional<std::vector<Finding>> as_read_{};
  std::deque<Judged> judged_{};  ///< of different shapes
};

/// What stays as it is beside the building's geometry and is not valid (E321): installations with
/// a geometry of their own, and other geometries of its level if it is not redrawn.
std::vector<Issue> invalid_rest(const Document& document, const Building& building,
                                bool is_redrawn);

/// The error G413.
Issue invalid_before(const Building& building, const std::string& why);

/// Judge of solids to be written in the place of the polygons of a building, whose solid is `own`.
/// Each judgement is counted in the work; once that is used up, or nobody waits, all is unfit, and
/// no work is left. Refers to all that it is made of. `is_parted`: `own` is valid once it is
/// mended, and so will be what is written.
class WrittenJudge : public SolidJudge {
 public:
  WrittenJudge(OutputCheck& check, const Solid& own, bool is_parted, Work& work)
      : check_(check), own_(own), is_parted_(is_parted), work_(work) {}

  Fitness fitness_of(const Solid& solid) override;

 protected:
  /// Says whether nobody waits for it any longer.
  virtual bool is_given_up() { return false; }

 private:
  OutputCheck& check_;
  const Solid& own_;
  bool is_parted_;
  Work& work_;
};

/// What drawing a building for its targets may take: the budget of a stage and half of it, as steps
/// are taken back one by one and all is cut anew each time.
Work drawing_work(std::int64_t budget);

/// E502 of a building that is generalised with that budget.
Issue not_all_drawn(const Building& building, std::int64_t budget);

}  // namespace oriel
