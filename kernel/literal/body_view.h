#pragma once

#include "kernel/base/work.h"
#include "kernel/literal/arrangement.h"

#include <array>
#include <span>
#include <vector>

namespace oriel::literal {

/// A plane of a body, as its facets there look.
struct SplitPlane {
  int plane = -1;  ///< of the arrangement
  /// True: the body's facets look where the plane's normal does.
  bool is_along = true;
  /// The unit normal and offset of that orientation.
  Vec3 normal;
  double offset_m = 0;
  /// The area of the body's facets in it.
  double old_area_m2 = 0;
  /// Number of its normal: equal numbers are equal normals.
  int normal_class = -1;
};

/// A connected piece that split planes take from a body, or add to it.
struct LiteralLump {
  /// What it is made of: see BodyView::regions_of.
  std::vector<int> groups;
  double volume_m3 = 0;
  /// By split plane of the test: the new area in it.
  std::vector<double> new_area_m2;
  /// Of a hole: along a reflex edge of the body both facets are the lump's walls.
  bool has_reflex_edge = false;
};

/// A body, a set of regions of an arrangement, prepared to be cut by its own planes.
class BodyView {
 public:
  BodyView(const PlaneArrangement& arrangement, const Bits& body, Work& work);

  /// In descending order of normal, then offset.
  [[nodiscard]] const std::vector<SplitPlane>& planes() const { return planes_; }
  /// It has no reflex edge.
  [[nodiscard]] bool is_convex() const { return reflex_edges_.empty(); }

  /// What of the body lies in front of a split plane, in connected pieces that touch what lies
  /// behind it (paper, figure 1).
  std::vector<LiteralLump> protrusions(int split);
  /// The finite connected pieces of what lies behind all of some split planes and not in the body
  /// (paper, figures 2 and 3).
  std::vector<LiteralLump> holes(std::span<const int> splits);
  /// The finite pieces of air that no split plane is needed for.
  std::vector<LiteralLump> cavities();
  /// The regions of the arrangement that a lump takes up.
  [[nodiscard]] Bits regions_of(const LiteralLump& lump) const;

 private:
  /// What the body's own planes do not tell apart.
  struct RegionGroup {
    std::vector<int> regions;
    double volume_m3 = 0;
    bool is_endless = false;
    bool is_solid = false;
  };
  struct Link {
    int to = -1;
    int plane = -1;
    double area_m2 = 0;
  };

  void find_planes(const Bits& body);
  void group_regions(const Bits& body);
  void link_groups(const Bits& own);
  void find_reflex_edges(const Bits& body);
  /// Takes away what is joined to the endless, of the marked groups.
  void take_endless(Bits space);
  /// The groups that can be reached from `start` within the marked ones, which lose their marks.
  const std::vector<int>& take_piece(int start);
  void mark(const Bits& groups);
  LiteralLump lump_of(const std::vector<int>& piece, std::span<const int> splits, bool is_hole);
  [[nodiscard]] bool has_reflex_edge(const std::vector<int>& piece);

  const PlaneArrangement& arrangement_;
  Work& work_;
  std::vector<SplitPlane> planes_;
  std::vector<RegionGroup> groups_;
  std::vector<std::vector<Link>> links_;
  Bits solid_, air_, endless_;
  /// By split plane: the groups behind it.
  std::vector<Bits> behind_;
  /// The groups of air in the angle of each reflex edge, sorted; no two alike.
  std::vector<std::vector<int>> reflex_edges_;
  std::vector<int> group_of_region_;
  std::vector<char> is_marked_;
  std::vector<int> piece_;
  /// By group: the last lump that it was of.
  std::vector<int> lump_of_group_;
  int lumps_ = 0;
};

}  // namespace oriel::literal
