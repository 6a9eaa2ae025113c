#pragma once

#include "kernel/model/building.h"

#include <cstdint>
#include <string>
#include <vector>

namespace oriel::cli {

/// Which buildings a command works on: those for which all that is asked for holds, or, excluding,
/// the others. The words are cjseq's.
struct Selection {
  /// One of these ids; empty: any.
  std::vector<std::string> ids;
  /// xmin, ymin, xmax, ymax in the input's coordinates, around the middle of the building's box;
  /// empty: anywhere.
  std::vector<double> bbox;
  /// The type of the feature's object (Building, Road, …), of which a BuildingPart is a part;
  /// empty: any.
  std::string cotype;
  /// One in so many, drawn by `seed` and the building's id, so that neither order nor shards
  /// matter; 1: all.
  std::uint64_t one_in = 1;
  std::uint64_t seed = 0;
  bool is_exclusion = false;

  /// Nothing was asked for.
  [[nodiscard]] bool is_all() const;
  /// A building of a feature of this type.
  [[nodiscard]] bool takes(const Building& building, const std::string& type) const;
  /// Of a building of which only the id is known: with `bbox` it fits nowhere.
  [[nodiscard]] bool takes(const std::string& id, const std::string& type) const;
  /// A feature without a building that could be read: only if a type was asked for.
  [[nodiscard]] bool takes_feature(const std::string& id, const std::string& type) const;

 private:
  [[nodiscard]] bool fits(const std::string& id, const std::string& type) const;
};

}  // namespace oriel::cli
