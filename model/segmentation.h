#pragma once

#include "kernel/base/ids.h"
#include "kernel/base/issue.h"
#include "model/solid.h"
#include "model/vec3.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// In which order features are split off (docs/segmentation.md): along existing edges first, or the
/// paper's.
enum class Order { natural, paper };

/// What a feature is to the building: material that sticks out, air that cuts in, air closed in on
/// all sides, or an outline without depth. A hole that is cut from a void (the chimney in a roof
/// terrace's air) is material, so a protrusion.
enum class Sense { protrusion, hole, cavity, imprint };

/// A node of the CSG tree. A union says body = rest ∪ parts, a difference body = rest ∖ parts; a
/// leaf is a cell. `rest` and `parts` hold one node per lump.
struct CsgNode {
  enum class Kind { leaf, unite, subtract };
  Kind kind = Kind::leaf;
  /// The split planes; none for a cavity and where a body of several lumps falls apart without a
  /// cut.
  std::vector<PlaneId> planes;
  /// The key the order sorted by; missing where nothing was cut.
  std::optional<double> value;
  /// The paper's quality: new area / old area in the split planes.
  std::optional<double> quality;
  std::vector<NodeId> rest;
  std::vector<NodeId> parts;
  /// The leaf's cell.
  CellId cell;
};

/// Why a leaf was not split further.
enum class LeafFlag {
  convex,  ///< nothing to split
  own,     ///< convex but for the planes of the cut that made it, which are no split planes of it
  no_candidate,  ///< not convex, and no valid candidate
  cycle,         ///< a state came back: the safety net of the termination argument
  budget,        ///< the counted work budget is used up
  open           ///< no closed body: the facets of a building that stayed open
};

/// A leaf of the tree as a closed body. The body of a solid is the sum of its cells with their
/// signs: at every point the signs of the cells around it add up to 1 inside and 0 outside.
struct Cell {
  /// +1 solid, -1 void: the product of the signs on the leaf's path.
  int sign = 1;
  double volume_m3 = 0;
  bool is_convex = true;
  LeafFlag flag = LeafFlag::convex;
  NodeId node;
  /// The innermost feature the cell is in, or invalid: the body.
  FeatureId feature;
  /// Outward from the cell (also of a void); loops index Segmentation::vertices.
  std::vector<Facet> facets;
};

/// A facet of a cell.
struct CellFacet {
  CellId cell;
  int facet = -1;
};

/// A part that a node of the tree splits off, at any level: paper 4. Or an imprint, which no node
/// splits off: see add_imprints for what its members are.
struct Feature {
  Sense sense = Sense::protrusion;
  /// The feature in whose subtree this one was found, or invalid: the body.
  FeatureId parent;
  /// The feature (or invalid: the body) that owns the facet in which the largest cap lies.
  FeatureId host;
  /// That facet, all features on it taken away: of a wall, the facade. Missing for cavities.
  std::optional<CellFacet> host_facet;
  /// The node of the feature's own subtree; invalid for an imprint and an uncut feature.
  NodeId node;
  /// See CsgNode.
  std::optional<double> value;
  std::optional<double> quality;
  double new_area_m2 = 0;
  double old_area_m2 = 0;
  /// The split planes, the one with the largest cap first. They look out of the building: a
  /// protrusion is in front of them, a hole behind them, an imprint in it.
  std::vector<PlaneId> planes;
  /// A point inside the largest cap.
  Vec3 cap_point;
  /// True if the cut follows existing edges of the body and splits no facet.
  bool is_natural = false;
  double volume_m3 = 0;
  /// The area of the boundary without the caps.
  double surface_m2 = 0;
  Box box;
  /// The vertices of the lump, sorted, without repetition; indices into Segmentation::vertices.
  std::vector<int> vertices;
  /// Input polygons that lie in the feature with most of their area, also those of features within
  /// it; sorted.
  std::vector<int> source_polygons;
  /// Of an imprint and of an uncut feature its outline, counter-clockwise seen from outside.
  Loop outline{};
  /// True: no cut splits it off, it is known by a ring only (see add_ring_features). It has no
  /// node, no value and no quality, and its volume is not known: 0.
  bool is_uncut = false;
};

/// Counts of the work, all independent of the machine.
struct SegmentationStats {
  std::size_t leaves = 0;
  std::size_t inner = 0;
  /// Bodies looked at: leaves + inner.
  std::size_t recursions = 0;
  /// Oriented planes, or sets of planes, tested for protrusions and for holes.
  std::size_t protrusion_tests = 0;
  std::size_t hole_tests = 0;
  /// Candidates found by them.
  std::size_t candidates = 0;
  /// Parts that were not segmented themselves: they are congruent to another one of their node and
  /// have got its subtree.
  std::size_t instanced = 0;
};

/// The whole result for one solid.
struct Segmentation {
  Order order = Order::natural;
  /// Metres per grid unit of the solid (Solid::grid_m).
  double grid_m = 0;
  /// The oriented split planes, which are Solid::planes with the same ids, then planes that only
  /// caps of parts lie in.
  std::vector<Plane> planes;
  /// The solid's vertices, same indices, then those that cuts made, then those of uncut features
  /// and of the outlines of imprints, which may lie on edges and in facets of the solid.
  std::vector<Vertex> vertices;
  std::vector<CsgNode> nodes;
  NodeId root;
  std::vector<Cell> cells;
  /// In the order of the tree, parents before what they contain; then uncut features and imprints,
  /// of each outer before inner ones.
  std::vector<Feature> features;
  SegmentationStats stats;
  std::vector<Issue> issues;
};

/// "natural", "paper".
std::string to_string(Order order);
/// "protrusion", "hole", "cavity", "imprint".
std::string to_string(Sense sense);
/// "convex", "own", "no-candidate", "cycle", "budget", "open".
std::string to_string(LeafFlag flag);

}  // namespace oriel
