#pragma once

#include "generalise/generalised.h"
#include "kernel/attach/attach.h"
#include "kernel/attach/raise_across.h"
#include "model/segmentation.h"
#include "model/solid.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace oriel::detail {

/// A wall or a roof that features are put back on, with its axes: u horizontal along it, v up in
/// it, n out of it. Of a facet that lies flat u is along a wall.
struct Host {
  FacetId facet;
  Plane plane;
  Vec3 u, v, n;
};

/// What is this close to an edge lies or stands on it.
inline constexpr double kOnEdge_m = 0.002;

/// The facet of `plane` that has the point in it, or nothing.
std::optional<Host> host_at(const Solid& solid, const Plane& plane, Vec3 point);

/// The facet that has the directed edge, of those whose normal rises or falls by more than
/// `steeper_than`.
std::optional<FacetId> facet_with_edge(const Solid& solid, int from, int to,
                                       double steeper_than = -1);

/// The axes of a wall, nothing of other planes; its facet is not looked for.
std::optional<Host> wall_axes(const Plane& plane);

/// The extents of some points along the axes of a host; `out` counts from its plane.
struct Extents {
  double u0, u1, v0, v1, out0, out1;

  [[nodiscard]] double width() const { return u1 - u0; }
  [[nodiscard]] double height() const { return v1 - v0; }
  /// How far it reaches from the plane to either side.
  [[nodiscard]] double depth() const { return std::max(out1, -out0); }
};
/// Wider by `more_u`, to either side, and higher by `more_v`, to either side or above the sill.
Extents grown(Extents box, double more_u, double more_v, bool is_on_sill = false);
/// Those that have both in them.
Extents united(const Extents& one, const Extents& other);
Extents extents_of(const Host& host, std::span<const Vec3> points);
Extents extents_of(const Host& host, const Segmentation& segmentation, const Feature& feature);

/// What an operator made: the solid, whose new facets have the polygons of the features that they
/// stand for; or the reason why not.
struct Placed {
  std::optional<Solid> solid;
  std::string reason;
  /// The feature is as the operator wants it already, or alone in its row: it stays, not refused.
  bool is_needless = false;
  /// Members of a task that may stay as they are, each with its own reason: the others are tried
  /// again without them.
  struct LeftMember {
    std::size_t member = 0;
    std::string reason;
    bool is_needless = false;
    Hindrance hindrance{};
  };
  std::vector<LeftMember> left{};
  /// The members that are still there; not given: all.
  std::optional<std::vector<std::size_t>> stays{};
};

/// A recess or a block with the outline u0…u1 × v0…v1 on a host and the given depth; its facets get
/// `polygons`. Its sides are horizontal and vertical if the host is a wall. One whose lower edge
/// lies on the lower edge of the wall stands on what is level there: the ground, which a recess is
/// open to, or a slab or a plinth before the wall. `spare` as attach() has it.
Placed place_box(const Solid& solid, const Host& host, Extents where, double depth_m, Attach kind,
                 const Clearance& clearance, const std::vector<int>& polygons,
                 Solid* spare = nullptr);

/// Attaches a body and gives its facets `polygons`. `spare` as attach() has it.
Placed place(const Solid& solid, const std::vector<FacetId>& contacts,
             const std::vector<Plane>& planes, Attach kind, const Clearance& clearance,
             const std::vector<int>& polygons, Solid* spare = nullptr);

/// The same of a block that stands across edges of a roof.
Placed place_across(const Solid& solid, const BlockAcross& block, const Clearance& clearance,
                    const std::vector<int>& polygons);

/// What takes the place of openings of one kind on their host: sunk in like a hole, put on like a
/// protrusion, or drawn like an imprint, whose polygons and semantics are those of `like`. Refused
/// if it would come nearer than the clearance to another imprint that stays on the host, or as
/// place_box says; an outline may end at the lower edge of its wall. `spare` as attach() has it.
Placed place_like(const Solid& solid, const Segmentation& segmentation, const Host& host,
                  const Extents& where, double depth_m, Sense sense, const Clearance& clearance,
                  const Feature& like, Solid* spare = nullptr);

/// Keeps `least_m` from all parts but those that features were nearer to, whose extents on their
/// host these are: they are taken off, and what is drawn takes their place.
Clearance clearance_after(const Host& host, double least_m, const std::vector<Extents>& features);

/// Draws the rectangle `where` on the host as an imprint that has the polygons of `like`.
Placed draw_outline(const Solid& solid, const Host& host, const Extents& where,
                    const Feature& like);

/// How deep the box is that a feature is redrawn as: its own depth if it is a box, else its volume
/// over width × height, the mean depth of a recess of several steps or panes. 0 of an imprint;
/// nothing if it is neither a recess in a wall, a box, nor a rectangle, or has no volume: in a roof
/// a box in place of another shape would have new directions.
std::optional<double> box_depth(const Host& host, const Feature& feature, const Extents& extents);

/// A feature is a box on its host if its volume is no less than this share of width × height ×
/// depth: reveals may lean a little.
inline constexpr double kBoxShare = 0.95;
bool is_box(const Feature& feature, const Extents& extents);

/// The directions of what is added are those of planes nearer than this.
inline constexpr double kSameDirection_deg = 0.5;

}  // namespace oriel::detail
