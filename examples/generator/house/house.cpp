#include "examples/generator/house/house.h"

#include "examples/generator/house/extrude.h"

#include <algorithm>
#include <array>
#include <string>

namespace oriel::generator {
namespace {

constexpr Point kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

/// Builds one house; its members are the facets that several steps share.
class Builder {
 public:
  Builder(Draft& draft, const Massing& massing)
      : draft_(draft),
        m_(massing),
        ground_(surface(Class::ground, "ground")),
        front_(surface(Class::wall, "WallSurface")),
        back_(surface(Class::wall, "WallSurface")),
        left_(surface(Class::wall, "WallSurface")),
        right_(surface(Class::wall, "WallSurface")) {}

  House build() {
    house_.ground = ground_;
    add_panels();
    switch (m_.roof) {
      case RoofKind::flat:
        build_flat();
        break;
      case RoofKind::gable:
        build_gable();
        break;
      case RoofKind::hip:
        build_hip();
        break;
      case RoofKind::shed:
        build_shed();
        break;
    }
    if (m_.wing) m_.roof == RoofKind::gable ? add_gabled_wing() : add_flat_wing();
    return std::move(house_);
  }

 private:
  FacetId surface(Class kind, std::string_view subclass) {
    return draft_.add_facet({draft_.add_object({kind, std::string(subclass), -1, -1, {}, {}})});
  }
  FacetId roof_surface() { return surface(Class::roof, "RoofSurface"); }
  /// Another facet of the same object: a soffit or fascia of a roof.
  FacetId also(FacetId facet) { return draft_.add_facet(draft_.owner(facet)); }
  [[nodiscard]] Owner owner(FacetId facet) const { return draft_.owner(facet); }

  void add_panel(FacetId facet, const Frame& frame, Um length, Um height, bool is_front = false) {
    house_.walls.push_back(
        {facet, frame, ground_, {kWallMargin, length - kWallMargin, 0, height}, {}, -1, is_front});
  }
  void add_panels();
  void add_gable(FacetId wall, const Frame& frame, Um middle, Um half, Um eaves);
  void add_rectangular_plane(FacetId facet, const Frame& frame, Um length, Um run, Um margin,
                             Um top);
  void add_hip_plane(FacetId facet, const Frame& frame, Um length, Um run, Um margin);

  void build_flat();
  void build_gable();
  void build_hip();
  void build_shed();
  struct WingWalls {
    FacetId left{}, right{}, front{};
  };
  WingWalls add_wing_walls();
  void add_gabled_wing();
  void add_flat_wing();

  Draft& draft_;
  const Massing& m_;
  House house_;
  FacetId ground_, front_, back_, left_, right_;
};

void Builder::add_panels() {
  const Um h = m_.wall_height;
  add_panel(front_, {{0, 0, 0}, kX, kZ, -kY}, m_.width, h, true);
  add_panel(back_, {{m_.width, m_.depth, 0}, -kX, kZ, kY}, m_.width, h);
  add_panel(left_, {{0, m_.depth, 0}, -kY, kZ, -kX}, m_.depth, h);
  add_panel(right_, {{m_.width, 0, 0}, kY, kZ, kX}, m_.depth, h);
}

/// A rectangle inside the gable's triangle that starts at `eaves` and is 2 · `half` wide there.
void Builder::add_gable(FacetId wall, const Frame& frame, Um middle, Um half, Um eaves) {
  const Um top = m_.slope.rise(half) / 2;
  const Um reach = half / 2 - 400_mm;
  house_.gables.push_back({wall,
                           frame,
                           kNewFacet,
                           {middle - reach, middle + reach, eaves, eaves + top},
                           {},
                           -1,
                           false});
}

/// A rectangular plane that keeps `margin` free at the eaves and the sides, and `top` above.
void Builder::add_rectangular_plane(FacetId facet, const Frame& frame, Um length, Um run, Um margin,
                                    Um top) {
  house_.roof.push_back({facet,
                         frame,
                         m_.slope,
                         {{0, 0}, {length, 0}, {length, run}, {0, run}},
                         {margin, length - margin, margin, run - top},
                         {}});
}

/// A trapezoid or triangle between hips; usable is the rectangle in its lower part.
void Builder::add_hip_plane(FacetId facet, const Frame& frame, Um length, Um run, Um margin) {
  const Um top = run / 10000 * 6000;
  house_.roof.push_back({facet,
                         frame,
                         m_.slope,
                         {{0, 0}, {length, 0}, {length - run, run}, {run, run}},
                         {top + 300_mm, length - top - 300_mm, margin, top},
                         {}});
}

void Builder::build_flat() {
  const Um w = m_.width, d = m_.depth, h = m_.wall_height, o = m_.overhang;
  const FacetId roof = roof_surface();
  const FacetId top = o > 0 ? also(roof) : m_.parapet > 0 ? kNewFacet : roof;
  const Um wall_top = h + m_.parapet;
  const Block box{0, w, 0, d, 0, wall_top};
  // Seen from above: bottom and top of the block are the front and back walls.
  const BlockFacets walls{left_, right_, front_, back_, ground_, top};
  Um roof_z = h;
  if (m_.parapet > 0) {
    const int parapet =
        draft_.add_object({Class::other, "parapet", owner(roof).object, -1, {}, {}});
    const BlockFacets made = add_block(draft_, {}, box, {parapet}, walls);
    const Um t = 200_mm;
    carve_block(draft_, {}, {t, w - t, t, d - t, h, wall_top}, {parapet},
                {.back = roof, .front = made.front});
  } else {
    add_block(draft_, {}, box, owner(roof), walls);
  }
  if (o > 0) {
    roof_z = h + kRoofThickness;
    add_block(draft_, {}, {-o, w + o, -o, d + o, h, roof_z}, owner(roof),
              {.back = top, .front = roof});
  }
  add_rectangular_plane(roof, {{-o, -o, roof_z}, kX, kY, kZ}, w + 2 * o, d + 2 * o, o + 600_mm,
                        o + 600_mm);
}

void Builder::build_gable() {
  const Um w = m_.width, d = m_.depth, h = m_.wall_height, o = m_.overhang;
  const Um peak = h + m_.slope.rise(d / 2);
  const FacetId front = roof_surface(), back = roof_surface();
  const FacetId under_front = o > 0 ? also(front) : front;
  const FacetId under_back = o > 0 ? also(back) : back;
  extrude(draft_, Frame{}.turned(), {{{0, 0}, {d, 0}, {d, h}, {d / 2, peak}, {0, h}}, 0, w},
          Matter::solid, owner(front),
          {{ground_, back_, under_back, under_front, front_}, left_, right_});
  if (o > 0) {
    const Um low = h - m_.slope.rise(o), t = kRoofThickness;
    extrude(draft_, Frame{}.turned(),
            {{{-o, low},
              {d / 2, peak},
              {d + o, low},
              {d + o, low + t},
              {d / 2, peak + t},
              {-o, low + t}},
             -o,
             w + o},
            Matter::solid, owner(front), {{under_front, under_back, also(back), back, front}});
    house_.walls[0].usable.v1 = house_.walls[1].usable.v1 = low - 50_mm;
  }
  const Um eaves = o > 0 ? h - m_.slope.rise(o) + kRoofThickness : h;
  const Um length = w + 2 * o, run = d / 2 + o;
  add_rectangular_plane(front, {{-o, -o, eaves}, kX, kY, kZ}, length, run, o + 500_mm, 250_mm);
  add_rectangular_plane(back, {{w + o, d + o, eaves}, -kX, -kY, kZ}, length, run, o + 500_mm,
                        250_mm);
  const Um ridge = eaves + m_.slope.rise(run);
  house_.ridge = {{-o, d / 2, ridge}, {w + o, d / 2, ridge}};
  for (const std::size_t side : {2U, 3U})
    add_gable(house_.walls[side].facet, house_.walls[side].frame, d / 2, d / 2, h);
}

void Builder::build_hip() {
  const Um o = m_.overhang, t = o > 0 ? kRoofThickness : 0;
  const Um w = m_.width + 2 * o, d = m_.depth + 2 * o, run = d / 2, h = m_.wall_height;
  const std::array<FacetId, 4> roof{roof_surface(), roof_surface(), roof_surface(), roof_surface()};
  // Around the walls the roof's underside is a soffit. Where two parts are glued nothing is left.
  const FacetId under = also(roof[0]);
  add_block(draft_, {}, {0, m_.width, 0, m_.depth, 0, h}, owner(roof[0]),
            {left_, right_, front_, back_, ground_, under});
  const Frame base{{-o, -o, h + t}};
  const FacetId seam = o > 0 ? also(roof[0]) : under;
  if (o > 0)
    add_block(draft_, base, {0, w, 0, d, -t, 0}, owner(roof[0]), {.back = under, .front = seam});
  const Point a = base.at(0, 0, 0), b = base.at(w, 0, 0), c = base.at(w, d, 0),
              e = base.at(0, d, 0);
  const Point r1 = base.at(run, run, m_.slope.rise(run));
  const Point r2 = base.at(w - run, run, m_.slope.rise(run));
  draft_.add_ring(seam, {a, e, c, b});
  draft_.add_ring(roof[0], {a, b, r2, r1});
  draft_.add_ring(roof[1], {b, c, r2});
  draft_.add_ring(roof[2], {c, e, r1, r2});
  draft_.add_ring(roof[3], {e, a, r1});
  add_hip_plane(roof[0], {a, kX, kY, kZ}, w, run, o + 500_mm);
  add_hip_plane(roof[1], {b, kY, -kX, kZ}, d, run, o + 500_mm);
  add_hip_plane(roof[2], {c, -kX, -kY, kZ}, w, run, o + 500_mm);
  add_hip_plane(roof[3], {e, -kY, kX, kZ}, d, run, o + 500_mm);
  house_.ridge = {r1};
  if (r2 != r1) house_.ridge.push_back(r2);
}

void Builder::build_shed() {
  const Um w = m_.width, d = m_.depth, h = m_.wall_height, o = m_.overhang;
  const FacetId roof = roof_surface();
  const FacetId under = o > 0 ? also(roof) : roof;
  const auto z = [&](Um y) { return h + m_.slope.rise(y); };
  extrude(draft_, Frame{}.turned(), {{{0, 0}, {d, 0}, {d, z(d)}, {0, h}}, 0, w}, Matter::solid,
          owner(roof), {{ground_, back_, under, front_}, left_, right_});
  const Um t = o > 0 ? kRoofThickness : 0;
  if (o > 0)
    extrude(draft_, Frame{}.turned(),
            {{{-o, z(-o)}, {d + o, z(d + o)}, {d + o, z(d + o) + t}, {-o, z(-o) + t}}, -o, w + o},
            Matter::solid, owner(roof), {{under, kNewFacet, roof, kNewFacet}});
  house_.walls[0].usable.v1 = z(-o) - (o > 0 ? 50_mm : 0);
  add_rectangular_plane(roof, {{-o, -o, z(-o) + t}, kX, kY, kZ}, w + 2 * o, d + 2 * o, o + 500_mm,
                        o + 500_mm);
}

/// The wing's side and front walls. A wing flush with a wall of the house continues that wall.
Builder::WingWalls Builder::add_wing_walls() {
  const Wing& wing = *m_.wing;
  const bool is_left_flush = wing.u0 == 0, is_right_flush = wing.u1 == m_.width;
  const WingWalls walls{is_left_flush ? left_ : surface(Class::wall, "WallSurface"),
                        is_right_flush ? right_ : surface(Class::wall, "WallSurface"),
                        surface(Class::wall, "WallSurface")};
  const Um h = wing.wall_height;
  add_panel(walls.left, {{wing.u0, 0, 0}, -kY, kZ, -kX}, wing.length, h);
  if (!is_left_flush) house_.walls.back().usable.u0 = kCornerMargin;
  add_panel(walls.right, {{wing.u1, -wing.length, 0}, kY, kZ, kX}, wing.length, h);
  if (!is_right_flush) house_.walls.back().usable.u1 = wing.length - kCornerMargin;
  add_panel(walls.front, {{wing.u0, -wing.length, 0}, kX, kZ, -kY}, wing.u1 - wing.u0, h, true);
  house_.walls[0].reserved.push_back(
      {wing.u0 - kCornerMargin, wing.u1 + kCornerMargin, 0, m_.wall_height});
  return walls;
}

/// The wing's gable roof runs into the house's front slope; its eaves are at the same height.
void Builder::add_gabled_wing() {
  const Wing& wing = *m_.wing;
  const WingWalls walls = add_wing_walls();
  const Um h = m_.wall_height, half = (wing.u1 - wing.u0) / 2, middle = wing.u0 + half;
  const Um peak = h + m_.slope.rise(half);
  const FacetId left = roof_surface(), right = roof_surface();
  const FacetId house_roof = house_.roof[0].facet;
  // The outline is in (z, x).
  extrude(
      draft_, Frame{}.turned().turned(),
      {{{0, wing.u0}, {h, wing.u0}, {peak, middle}, {h, wing.u1}, {0, wing.u1}}, -wing.length, 0},
      Matter::solid, owner(left),
      {{walls.left, left, right, walls.right, ground_}, walls.front, front_});
  const Point a{wing.u0, 0, h}, b{wing.u1, 0, h}, c{middle, 0, peak}, e{middle, half, peak};
  draft_.add_ring(front_, {a, b, c});
  draft_.add_ring(left, {a, c, e});
  draft_.add_ring(right, {b, e, c});
  draft_.add_ring(house_roof, {a, e, b});
  house_.roof[0].reserved.push_back({wing.u0 - 300_mm, wing.u1 + 300_mm, 0, half + 300_mm});
  add_rectangular_plane(left, {a, -kY, kX, kZ}, wing.length, half, 500_mm, 250_mm);
  add_rectangular_plane(right, {{wing.u1, -wing.length, h}, kY, -kX, kZ}, wing.length, half, 500_mm,
                        250_mm);
  add_gable(walls.front, house_.walls.back().frame, half, half, h);
}

void Builder::add_flat_wing() {
  const Wing& wing = *m_.wing;
  const WingWalls walls = add_wing_walls();
  const FacetId roof = roof_surface();
  add_block(draft_, {}, {wing.u0, wing.u1, -wing.length, 0, 0, wing.wall_height}, owner(roof),
            {walls.left, walls.right, walls.front, front_, ground_, roof});
  add_rectangular_plane(roof, {{wing.u0, -wing.length, wing.wall_height}, kX, kY, kZ},
                        wing.u1 - wing.u0, wing.length, 600_mm, 600_mm);
}
}  // namespace
std::string_view name_of(RoofKind kind) {
  constexpr std::array<std::string_view, 4> names{"flat", "gable", "hip", "shed"};
  return names[static_cast<std::size_t>(kind)];
}

House build_house(Draft& draft, const Massing& massing) { return Builder(draft, massing).build(); }

}  // namespace oriel::generator
