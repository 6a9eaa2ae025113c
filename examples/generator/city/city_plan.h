#pragma once

#include "examples/generator/house/plan.h"
#include "examples/generator/options.h"

#include <cstdint>

namespace oriel::generator {

/// The walls of a house, in the order of House::walls.
enum class Side { front, back, left, right };

/// What houses of a city stand in.
enum class GroupKind {
  terrace,    ///< two rows of eight, back to back, with gardens between them
  perimeter,  ///< sixteen houses around a courtyard
  detached    ///< two rows of eight single houses along a street
};

/// So many houses make a group.
inline constexpr int kHousesInGroup = 16;

/// The kind of group number `group`: they take turns.
GroupKind kind_of_group(int group);

/// One house of a city: what is drawn of it, and where it stands.
struct CitySite {
  Plan plan;
  /// Walls against which a neighbour stands: they get nothing.
  bool is_blind[4] = {false, false, false, false};
  /// The back wall ends in an inner corner of the courtyard: at its start, at its end.
  bool ends_in_corner[2] = {false, false};
  /// A stack stands on the ridge, flush with the left wall, which is shared.
  bool has_party_chimney = false;
  /// The house turns so often by 90 degrees, counter-clockwise, then moves.
  int quarter_turns = 0;
  Point place;

  [[nodiscard]] bool is_blind_at(Side side) const { return is_blind[static_cast<int>(side)]; }
};

/// House `index` of a city. Neighbours of a group are drawn from the same numbers, so that their
/// walls meet to the micrometre; a house depends on the seed and its index only. `random` draws
/// what is its own.
CitySite draw_site(const Options& options, int index, Random& random);

}  // namespace oriel::generator
