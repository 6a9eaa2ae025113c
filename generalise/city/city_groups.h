#pragma once

#include "generalise/generalise.h"
#include "interpret/plan/profile.h"
#include "kernel/base/issue.h"
#include "kernel/base/parallel.h"
#include "kernel/neighbours/alike_groups.h"
#include "kernel/neighbours/kept_ground.h"
#include "kernel/neighbours/neighbours.h"
#include "model/building.h"
#include "model/solid.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// Rows and blocks of a city: buildings that adjoin and are alike in height become one
/// block, and of rows of detached buildings some stand for all (docs/generalisation.md, Rows and
/// blocks).
class CityGroups {
 public:
  /// What the profile asks for at the scale, of the buildings of a search, which outlives it. All
  /// solids are made, in shares by what `each` calls. No block covers more of the ground to be
  /// `kept` free than its members do; null: none is.
  CityGroups(const NeighbourSearch& search, const Profile& profile, double scale,
             const ForEachShare& each = for_each_in_turn, const KeptGround* kept = nullptr);

  /// What becomes of one building.
  struct Membership {
    bool leads = false;      ///< it gets the solid of the group, the others leave
    std::size_t group = 0;   ///< its number
    std::size_t leader = 0;  ///< the building that leads, or stands for it in a row
  };
  /// Nothing for a building that is in no group, and for one of a row that stays.
  [[nodiscard]] std::optional<Membership> place_of(const Neighbourhood& building) const;
  /// The ids of a building of a row and of those that it stands for, ascending; none for others.
  [[nodiscard]] std::vector<std::string> stood_for(const Neighbourhood& building) const;
  /// A group without a solid is a row of detached buildings, some of which stay.
  [[nodiscard]] bool is_row(std::size_t group) const { return !groups_[group].stays.empty(); }
  [[nodiscard]] const std::string& id(std::size_t building) const {
    return search_.buildings()[building].id;
  }

  /// The solid, in the frame of the building that leads: it is made again, as a city has many.
  [[nodiscard]] Solid solid(std::size_t group) const;
  /// Ids of the members, ascending.
  [[nodiscard]] std::vector<std::string> members(std::size_t group) const;
  [[nodiscard]] std::size_t size() const { return groups_.size(); }
  /// What was found at a building: G421 (note) for each that became part of a group, G422 (warning)
  /// where no valid solid came of one, G423 (note) where adjoining buildings are not alike; G440
  /// where ground is to be kept free: a note at a gap, a warning for a group; E191 (warning) for a
  /// building that stands on such ground.
  [[nodiscard]] std::vector<Issue> issues_of(const Neighbourhood& building) const;

 private:
  struct BlockForm;
  struct DrawnGroup {
    AlikeGroup found;  ///< without its areas once its solid was made
    std::shared_ptr<const BlockForm>
        form;  ///< what the solid is made of; null: members stay as they were
    bool is_gabled = false;
    Code code = Code::G422;  ///< why
    std::string fault;
    /// Of a row: who stands for each member, parallel to them, itself if it stays. Else empty.
    std::vector<std::size_t> stays{};
  };

  void make_solid(DrawnGroup& group, const Profile& profile, double least_edge_m) const;
  [[nodiscard]] double on_kept_m2(std::size_t building) const;
  void make_gabled(DrawnGroup& group, const std::vector<Outline>& outlines) const;
  [[nodiscard]] bool covers_kept(DrawnGroup& group, const std::vector<Outline>& outlines) const;
  void look_at_kept(DrawnGroup& group);
  void find_blocks(const Profile& profile, double scale, const ForEachShare& each);
  void find_rows(const Profile& profile);
  void add_row(const std::vector<std::size_t>& row, double ratio);
  [[nodiscard]] std::size_t standing_for(std::size_t building) const;

  const NeighbourSearch& search_;
  std::vector<DrawnGroup> groups_;
  std::vector<int> group_of_;  ///< by building; -1: none
  /// A building and another one, both ways round, ascending.
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  Pairs unlike_;      ///< they adjoin and are of different heights
  Pairs kept_apart_;  ///< they stay apart
  const KeptGround* kept_;
  /// By building: how much of the ground to be kept free it stands on, m2.
  std::map<std::size_t, double> on_kept_m2_;
};

/// True if the profile asks for groups at the scale.
bool asks_for_groups(const Profile& profile, double scale);

/// The building that leads a group, drawn as the group's block, with the attributes
/// `oriel_members` and those of `labelled`.
Redrawn drawn_group(const LabelledBuilding& labelled, const Solid& solid,
                    std::span<const std::string> members);

}  // namespace oriel
