#include "examples/generator/house/additions.h"

#include "examples/generator/facade/openings.h"
#include "examples/generator/house/extrude.h"
#include "examples/generator/house/rooftop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace oriel::generator {
namespace {

using Shape = Addition::Shape;
using Surface = Addition::Surface;

constexpr Um kFromWallFeatures = 100'000, kFromRoofFeatures = 200'000;
/// Holes that reach no deeper meet nothing that is sunk into another wall beside the corner.
constexpr Um kShallow = 250'000;
/// What deep holes keep free under the top of their wall, and how far those of a roof may reach
/// below the top of the walls: rooms behind the walls end there.
constexpr Um kBelowWallTop = 350'000, kBelowEaves = 100'000;
/// What everything else keeps free there: a roof or its underside may begin at the top.
constexpr Um kFromWallTop = 100'000;
/// Holes of different surfaces keep this distance inside the house.
constexpr Um kBetweenHollows = 50'000;
/// Free places are looked for so often, on a grid of this step.
constexpr int kTries = 300;
constexpr Um kStep = 10'000;

Um whole_millimetres(double um) { return std::llround(um / 1000) * 1000; }

/// A length up the slope over its run, seen from above.
double stretch(const RoofPlane& plane) { return std::hypot(1.0, plane.slope.per_mille / 1000.0); }

std::string metres_text(double um) { return fmt::format("{:.2f}", um / 1e6); }

/// Puts one thing onto one house.
class AdditionPlacer {
 public:
  /// `hollows`: the boxes of the holes that were put onto the house before.
  AdditionPlacer(Draft& draft, House& house, const Addition& addition, Um wall_height,
                 std::vector<Extent>& hollows, Random& random)
      : draft_(draft),
        house_(house),
        addition_(addition),
        wall_height_(wall_height),
        hollows_(hollows),
        random_(random) {}

  /// False: it may stand anywhere, and there is no room.
  bool place() {
    if (addition_.surface == Surface::roof) return place_among(chosen(house_.roof));
    if (addition_.surface == Surface::gable) return place_among(chosen(house_.gables));
    if (addition_.surface == Surface::wall) return place_among(chosen(house_.walls));
    const auto wall = static_cast<std::size_t>(addition_.surface) - 1;
    return place_among(std::vector<Panel*>{&house_.walls[wall]});
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw AdditionError(fmt::format("E141 '{}' does not fit: {}", addition_.text, why));
  }

  template <class Plane>
  std::vector<Plane*> chosen(std::vector<Plane>& all) const {
    std::vector<Plane*> planes;
    for (Plane& plane : all) planes.push_back(&plane);
    const auto number = static_cast<std::size_t>(addition_.number);
    if (number == 0) return planes;
    const bool is_roof = addition_.surface == Surface::roof;
    if (number > planes.size())
      fail(fmt::format("the {} has {} {}{}", is_roof ? "roof" : "house", planes.size(),
                       is_roof ? "plane" : "gable", planes.size() == 1 ? "" : "s"));
    return {planes[number - 1]};
  }

  template <class Plane>
  bool place_among(const std::vector<Plane*>& planes) {
    if (addition_.at) {
      if (planes.empty()) fail("the house has no such surface");
      place_there(*planes.front());
      return true;
    }
    for (int attempt = 0; attempt < kTries && !planes.empty(); ++attempt) {
      Plane& plane =
          *planes[static_cast<std::size_t>(random_.below(static_cast<int>(planes.size())))];
      const Rect room = room_of(plane);
      const Um width = width_on(plane), height = height_on(plane);
      if (room.width() < width || room.height() < height) continue;
      const Um u0 = random_.between(room.u0, room.u1 - width, kStep);
      const Um v0 = random_.between(room.v0, room.v1 - height, kStep);
      const Rect rect{u0, u0 + width, v0, v0 + height};
      if (!obstacle(plane, rect).empty()) continue;
      build(plane, rect);
      return true;
    }
    return false;
  }

  template <class Plane>
  void place_there(Plane& plane) {
    const Um width = width_on(plane), height = height_on(plane);
    const Um u0 = addition_.at->u, v0 = run_on(plane, addition_.at->v);
    const Rect rect{u0, u0 + width, v0, v0 + height}, room = room_of(plane);
    if (room.width() < width || room.height() < height)
      fail(fmt::format("the surface takes at most {} x {} m", metres_text(double(room.width())),
                       metres_text(up(plane, room.height()))));
    if (!room.contains(rect))
      fail(fmt::format("X may be {} .. {} m there and Y {} .. {} m", metres_text(double(room.u0)),
                       metres_text(double(room.u1 - width)), metres_text(up(plane, room.v0)),
                       metres_text(up(plane, room.v1 - height))));
    if (const std::string what = obstacle(plane, rect); !what.empty()) fail(what);
    build(plane, rect);
  }

  // Positions and sizes on a wall are what was asked for; those on a roof are seen from above.
  static Um run_on(const Panel& /*panel*/, Um length) { return length; }
  static Um run_on(const RoofPlane& plane, Um length) {
    return whole_millimetres(static_cast<double>(length) / stretch(plane));
  }
  static double up(const Panel& /*panel*/, Um run) { return static_cast<double>(run); }
  static double up(const RoofPlane& plane, Um run) {
    return static_cast<double>(run) * stretch(plane);
  }
  [[nodiscard]] Um width_on(const auto& /*plane*/) const { return addition_.width; }
  [[nodiscard]] Um height_on(const auto& plane) const { return run_on(plane, addition_.height); }

  [[nodiscard]] Rect room_of(const Panel& panel) const {
    Rect room = panel.usable;
    const bool is_gable = addition_.surface == Surface::gable;
    const bool is_deep = addition_.shape == Shape::hole && addition_.depth > kShallow;
    if (is_gable) room.v0 += kFromWallFeatures;
    if (is_deep) {
      room.u0 += kCornerMargin - kWallMargin;
      room.u1 -= kCornerMargin - kWallMargin;
    }
    if (is_deep || !is_gable) room.v1 -= is_deep ? kBelowWallTop : kFromWallTop;
    return room;
  }
  [[nodiscard]] Rect room_of(const RoofPlane& plane) const { return plane.usable; }

  /// What keeps the thing from standing there; empty if nothing does.
  template <class Plane>
  [[nodiscard]] std::string obstacle(const Plane& plane, const Rect& rect) const {
    if (!is_free(plane, rect)) return "something else stands there";
    if (!reaches_no_room(plane, rect)) return "it would reach into the walls below";
    const Extent hollow = hollow_of(plane, rect).grown(kBetweenHollows);
    const auto meets = [&](const Extent& other) { return other.overlaps(hollow); };
    if (addition_.shape == Shape::hole && std::ranges::any_of(hollows_, meets))
      return "it would meet another hole inside the house";
    return {};
  }

  [[nodiscard]] bool is_free(const Panel& panel, const Rect& rect) const {
    return panel.is_free(rect, kFromWallFeatures / 2);
  }
  [[nodiscard]] bool is_free(const RoofPlane& plane, const Rect& rect) const {
    return is_roof_free(house_, to_plan(plane, rect), kFromRoofFeatures);
  }

  [[nodiscard]] bool reaches_no_room(const Panel& /*panel*/, const Rect& /*rect*/) const {
    return true;
  }
  /// The lowest point of a hole in a roof lies over the walls.
  [[nodiscard]] bool reaches_no_room(const RoofPlane& plane, const Rect& rect) const {
    if (addition_.shape != Shape::hole) return true;
    return plane.at({rect.u0, rect.v0}).z - drop_on(plane) >= wall_height_ - kBelowEaves;
  }
  /// Its depth, measured straight up and down.
  [[nodiscard]] Um drop_on(const RoofPlane& plane) const {
    return whole_millimetres(static_cast<double>(addition_.depth) * stretch(plane));
  }

  /// The box of a hole there.
  [[nodiscard]] Extent hollow_of(const Panel& panel, const Rect& r) const {
    return extent_of({panel.frame.at(r.u0, r.v0, 0), panel.frame.at(r.u1, r.v1, -addition_.depth)});
  }
  [[nodiscard]] Extent hollow_of(const RoofPlane& plane, const Rect& r) const {
    return extent_of(
        {plane.at({r.u0, r.v0}) - drop_on(plane) * plane.frame.w, plane.at({r.u1, r.v1})});
  }

  [[nodiscard]] Object object_on(FacetId facet, int installation) const {
    Object object;
    object.subclass = addition_.class_name;
    object.host = draft_.owner(facet).object;
    object.parent = installation;
    if (const std::optional<Class> kind = class_named(addition_.class_name))
      object.kind = *kind;
    else
      object.given_class = addition_.class_name;
    if (object.kind == Class::door) object.subclass = "Door";
    if (object.kind == Class::window)
      object.subclass = addition_.surface == Surface::roof ? "roofWindow" : "Window";
    return object;
  }

  void build(Panel& panel, const Rect& r) {
    if (addition_.shape == Shape::hole) hollows_.push_back(hollow_of(panel, r));
    panel.reserved.push_back(r.grown(kFromWallFeatures / 2));
    Object object = object_on(panel.facet, panel.installation);
    if (is_opening(object.kind)) {
      add_opening(draft_, panel, {object.kind, object.subclass, r, addition_.depth});
      return;
    }
    const int number = draft_.add_object(std::move(object));
    const FacetId below = r.v0 == 0 ? panel.ground : kNewFacet;
    if (addition_.shape != Shape::hole) {
      add_block(draft_, panel.frame, {r.u0, r.u1, r.v0, r.v1, 0, addition_.depth}, {number},
                {.bottom = below, .back = panel.facet});
    } else if (addition_.depth > 0) {
      carve_block(draft_, panel.frame, {r.u0, r.u1, r.v0, r.v1, -addition_.depth, 0}, {number},
                  {.bottom = below, .front = panel.facet});
    } else {
      draft_.add_ring(panel.facet, reversed(rectangle(panel.frame, r, 0)));
      draft_.add_ring(kNewFacet, {number}, rectangle(panel.frame, r, 0));
    }
  }

  void build(RoofPlane& plane, const Rect& r) {
    if (addition_.shape == Shape::hole) hollows_.push_back(hollow_of(plane, r));
    Object object = object_on(plane.facet, -1);
    if (is_opening(object.kind)) object.recess = addition_.depth;
    const Rect plan = to_plan(plane, r);
    const bool is_framed = is_opening(object.kind);
    const int number = draft_.add_object(std::move(object));
    if (addition_.shape == Shape::block) {
      const Um top = plane.at({r.u0, r.v1}).z + addition_.depth;
      stand_on_roof(draft_, house_, rectangle({}, plan, 0), top, {number},
                    draft_.add_facet({number}));
    } else {
      const Um rise = addition_.shape == Shape::hole ? -drop_on(plane) : drop_on(plane);
      shift_part(plane, r, rise, number, is_framed);
    }
    reserve_roof(house_, plan);
  }

  /// The rectangle's part of the plane is lifted or sunk, with upright sides.
  void shift_part(const RoofPlane& plane, const Rect& r, Um rise, int object, bool is_framed) {
    const std::array<Uv, 4> corners{{{r.u0, r.v0}, {r.u1, r.v0}, {r.u1, r.v1}, {r.u0, r.v1}}};
    const Point up = rise * plane.frame.w;
    Ring rim, shifted;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point a = plane.at(corners[i]), b = plane.at(corners[(i + 1) % corners.size()]);
      rim.push_back(a);
      shifted.push_back(a + up);
      if (rise != 0) draft_.add_ring(kNewFacet, {object, is_framed}, {a, b, b + up, a + up});
    }
    draft_.add_ring(plane.facet, reversed(std::move(rim)));
    draft_.add_ring(kNewFacet, {object}, shifted);
  }

  Draft& draft_;
  House& house_;
  const Addition& addition_;
  Um wall_height_;
  std::vector<Extent>& hollows_;
  Random& random_;
};

}  // namespace

std::vector<int> place_additions(Draft& draft, House& house, const std::vector<Addition>& additions,
                                 Um wall_height, Random& random) {
  std::vector<int> left;
  std::vector<Extent> hollows;
  for (const bool has_place : {true, false})  // those that look for room leave the others theirs
    for (std::size_t i = 0; i < additions.size(); ++i)
      if (additions[i].at.has_value() == has_place &&
          !AdditionPlacer(draft, house, additions[i], wall_height, hollows, random).place())
        left.push_back(static_cast<int>(i));
  return left;
}

}  // namespace oriel::generator
