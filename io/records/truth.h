#pragma once

#include "kernel/base/issue.h"
#include "model/vec3.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// An object that is known to be there.
struct TruthObject {
  std::string id;
  /// The member "class": window, door, vent, … wall, roof, ground, other.
  std::string label;
  std::string subclass;
  /// Its box in the input's coordinates, in metres.
  Box aabb;
  /// Of an opening the box of pane and niche.
  std::optional<Box> feature_aabb;
  /// Its polygons: numbers in reading order in the stripped file. Empty: it fell out of the shell.
  std::vector<int> faces;
  /// Of an opening: whether it is in the shell and recessed.
  std::optional<bool> is_detectable;
};

/// What is known of one building (`*.truth.json`).
struct GroundTruth {
  std::string building;
  std::string dataset;
  std::vector<TruthObject> objects;
  /// Polygons that were added to close the shell, without truth.
  std::vector<int> capped_faces;
};

/// Reads a file of true objects. E112 names the object and the member that is missing or of the
/// wrong type, and there is no value then; E102 to E105, E503, E504 if the file is not JSON. Throws
/// InputError E101 if it cannot be read.
Checked<GroundTruth> read_truth(const std::string& path);

/// Reads the truth of many buildings: one per line of a `.jsonl` file, any other file as read_truth
/// does. A line that does not fit costs that line; no value if none is left.
Checked<std::vector<GroundTruth>> read_truths(const std::string& path);

}  // namespace oriel
