#pragma once

#include "cli/commands/labelling.h"
#include "cli/commands/targets.h"
#include "cli/output/accounts.h"
#include "generalise/generalise.h"
#include "interpret/pack/rule_base.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace oriel::cli {

/// How what is cut is judged on the way, by how it would be written.
enum class Judging {
  none,      ///< not at all: it would take too long
  refused,   ///< where features do not come off, what is left instead
  thorough,  ///< every step (SolidValidator::is_thorough)
};

/// What became of a building of a record; nothing is in `all` if it was set aside.
struct DrawnBuilding {
  std::size_t building = 0;
  std::vector<Redrawn> all;  ///< one for each target
  Product told;              ///< what is to be told of it

  /// Something is not valid as it is written, as it was not when it was read (G413).
  [[nodiscard]] bool is_excused() const;
  /// What was drawn is valid at no scale of the file (G410).
  [[nodiscard]] bool is_given_up() const;
};

/// Draws buildings for the targets of `generalise`, so that they are valid as they are written.
/// Several threads may ask it. Refers to all that it is made of.
class BuildingDrawer {
 public:
  BuildingDrawer(const LabelArguments& arguments, const Targets& targets, const RuleBase& rules,
                 const LabelOutputs& outputs, const Accounts& accounts)
      : arguments_(arguments),
        targets_(targets),
        rules_(rules),
        outputs_(outputs),
        accounts_(accounts) {}

  /// A building of the document, which is a solid.
  [[nodiscard]] DrawnBuilding draw(const Document& document, std::size_t building,
                                   const OnLine& line, Judging judging = Judging::refused) const;

  /// Says how fine the file has to be for a building to be valid in it. What is valid at no scale
  /// is drawn again with each step judged; if that is valid at none either it stays as it came,
  /// levels of detail are set aside (G410).
  void keep_valid(const Document& document, const OnLine& line, DrawnBuilding& drawn) const;

  /// Draws a building that is excused or given up again, from its mended_line(), which is returned;
  /// nothing is done if there is none, or if what was given up is so again.
  std::optional<OnLine> mend(const Document& document, const OnLine& line, DrawnBuilding& drawn,
                             Timings& timings) const;

 private:
  /// What a building is drawn of.
  struct Subject {
    const Document& document;
    const Building& building;
    const OnLine& line;
    const LabelledBuilding& labelled;
  };

  [[nodiscard]] std::optional<Redrawn> draw_for(const Profile* profile, const Subject& of,
                                                Judging judging, Product& told) const;
  [[nodiscard]] Plan plan_for(const Profile* profile, const OnLine& line, Product& told) const;
  [[nodiscard]] Invariants invariants_for(const Profile* profile, const Subject& of,
                                          Judging judging) const;
  [[nodiscard]] Checked<Generalised> carried_out(const Profile* profile, const OnLine& line,
                                                 const Invariants& invariants, Plan& plan) const;
  void keep_figures(const Profile* profile, const Subject& of, const Generalised& changes,
                    const Redrawn& redrawn, Product& told) const;
  void give_up(const Document& document, const OnLine& line, Issue fault,
               DrawnBuilding& drawn) const;
  [[nodiscard]] Redrawn untouched(const Document& document, const Building& building,
                                  const OnLine& line, Product& told) const;
  [[nodiscard]] std::string target_text(const Profile* profile) const;

  const LabelArguments& arguments_;
  const Targets& targets_;
  const RuleBase& rules_;
  const LabelOutputs& outputs_;
  const Accounts& accounts_;
};

}  // namespace oriel::cli
