#pragma once

#include "oriel/generalise.h"

#include <optional>

namespace oriel {

/// How what is cut is judged on the way, by how it would be written.
enum class Judging {
  none,      ///< not at all: it would take too long
  refused,   ///< where features do not come off, what is left instead
  thorough,  ///< every step (SolidValidator::is_thorough)
};

/// Draws one building for its targets, so that it is valid as it is written. Refers to all that it
/// is made of.
class BuildingDrawer {
 public:
  BuildingDrawer(const Document& document, const Building& building, const RuleBase& rules,
                 const Targets& targets, const GeneraliseOptions& options)
      : document_(document),
        building_(building),
        rules_(rules),
        targets_(targets),
        options_(options) {}

  /// `result` has a solid that is closed.
  [[nodiscard]] GeneralisedBuilding draw(const PipelineResult& result,
                                         Judging judging = Judging::refused) const;

  /// Says how fine the file has to be for the building to be valid in it. What is valid at no scale
  /// is drawn again with each step judged; if that is valid at none either it stays unchanged,
  /// levels of detail are rejected (G410).
  void keep_valid(const PipelineResult& result, GeneralisedBuilding& drawn) const;

  /// Draws a building that is not valid, or was given up, from its repair_and_retry(), which
  /// becomes drawn.repaired; nothing is done if there is none, or if what was given up is so again.
  void repair(const PipelineResult& result, GeneralisedBuilding& drawn) const;

 private:
  struct LabelledResult {
    const PipelineResult& result;
    const LabelledBuilding& labelled;
  };

  [[nodiscard]] std::optional<Redrawn> draw_for(const Profile* profile, const LabelledResult& of,
                                                Judging judging, GeneralisedBuilding& out) const;
  [[nodiscard]] Plan plan_for(const Profile* profile, const PipelineResult& result,
                              GeneralisedBuilding& out) const;
  [[nodiscard]] Invariants invariants_for(const Profile* profile, const PipelineResult& result,
                                          Judging judging) const;
  [[nodiscard]] Checked<Generalised> carried_out(const Profile* profile,
                                                 const PipelineResult& result,
                                                 const Invariants& invariants, Plan& plan) const;
  [[nodiscard]] std::optional<Issue> check(const PipelineResult& result,
                                           GeneralisedBuilding& drawn) const;
  void redraw_unchanged(const PipelineResult& result, Generalised& generalised,
                        GeneralisedBuilding& out) const;
  void keep_figures(const Profile* profile, const PipelineResult& result,
                    const Generalised& changes, const Redrawn& redrawn,
                    GeneralisedBuilding& out) const;
  void give_up(const PipelineResult& result, Issue fault, GeneralisedBuilding& drawn) const;
  [[nodiscard]] Redrawn untouched(const PipelineResult& result, GeneralisedBuilding& out) const;
  [[nodiscard]] std::string target_text(const Profile* profile) const;

  const Document& document_;
  const Building& building_;
  const RuleBase& rules_;
  const Targets& targets_;
  const GeneraliseOptions& options_;
};

}  // namespace oriel
