#include "examples/generator/english/english_shell.h"

#include "examples/generator/house/extrude.h"

#include <string>

namespace oriel::generator {
namespace {

constexpr Point kAlong{1, 0, 0}, kInto{0, 1, 0}, kHigh{0, 0, 1};
/// Thickness of the parapet before a town roof: one and a half bricks.
constexpr Um kParapetThickness = 340'000;

FacetId add_bare(Draft& draft, Class kind, std::string_view subclass) {
  return draft.add_facet({draft.add_object({kind, std::string(subclass), -1, -1, {}, {}})});
}

/// A row under a gable roof that starts behind a parapet on the front wall. The ridge runs along x.
class ParapetRow {
 public:
  ParapetRow(Draft& draft, const EnglishPlan& plan)
      : draft_(draft),
        plan_(plan),
        ground_(add_bare(draft, Class::ground, "ground")),
        front_(add_bare(draft, Class::wall, "WallSurface")),
        back_(add_bare(draft, Class::wall, "WallSurface")),
        left_(add_bare(draft, Class::wall, "WallSurface")),
        right_(add_bare(draft, Class::wall, "WallSurface")),
        roof_front_(add_bare(draft, Class::roof, "RoofSurface")),
        roof_back_(add_bare(draft, Class::roof, "RoofSurface")) {}

  EnglishShell build() {
    build_body();
    offer_walls();
    offer_roof();
    return shell_;
  }

 private:
  [[nodiscard]] Um run() const { return (plan_.depth - kParapetThickness) / 2; }
  void build_body();
  void offer_walls();
  void offer_roof();

  Draft& draft_;
  const EnglishPlan& plan_;
  FacetId ground_, front_, back_, left_, right_, roof_front_, roof_back_;
  EnglishShell shell_;
};

void ParapetRow::build_body() {
  const int parapet =
      draft_.add_object({Class::other, "parapet", draft_.owner(roof_front_).object, -1, {}, {}});
  const FacetId coping = draft_.add_facet({parapet});
  shell_.parapet = draft_.add_facet({parapet});
  const Um d = plan_.depth, h = plan_.wall_height(), t = kParapetThickness;
  const Um peak = h + plan_.slope.rise(run()), top = h + plan_.parapet;
  extrude(
      draft_, Frame{}.turned(),
      {{{0, 0}, {d, 0}, {d, h}, {t + run(), peak}, {t, h}, {t, top}, {0, top}}, 0, plan_.width()},
      Matter::solid, draft_.owner(front_),
      {{ground_, back_, roof_back_, roof_front_, shell_.parapet, coping, front_}, left_, right_});
}

void ParapetRow::offer_walls() {
  const Um w = plan_.width(), d = plan_.depth;
  shell_.house.ground = ground_;
  const auto add = [&](FacetId facet, const Frame& frame, Um length, bool is_front) {
    shell_.house.walls.push_back({facet,
                                  frame,
                                  ground_,
                                  {kWallMargin, length - kWallMargin, 0, plan_.wall_height()},
                                  {},
                                  -1,
                                  is_front});
  };
  add(front_, {{0, 0, 0}, kAlong, kHigh, -kInto}, w, true);
  add(back_, {{w, d, 0}, -kAlong, kHigh, kInto}, w, false);
  add(left_, {{0, d, 0}, -kInto, kHigh, -kAlong}, d, false);
  add(right_, {{w, 0, 0}, kInto, kHigh, kAlong}, d, false);
}

void ParapetRow::offer_roof() {
  const Um w = plan_.width(), h = plan_.wall_height(), t = kParapetThickness;
  const auto add = [&](FacetId facet, const Frame& frame) {
    shell_.house.roof.push_back({facet,
                                 frame,
                                 plan_.slope,
                                 {{0, 0}, {w, 0}, {w, run()}, {0, run()}},
                                 {500_mm, w - 500_mm, 500_mm, run() - 250_mm},
                                 {}});
  };
  add(roof_front_, {{0, t, h}, kAlong, kInto, kHigh});
  add(roof_back_, {{w, plan_.depth, h}, -kAlong, -kInto, kHigh});
  const Um peak = h + plan_.slope.rise(run());
  shell_.house.ridge = {{0, t + run(), peak}, {w, t + run(), peak}};
}

}  // namespace

EnglishShell build_english_shell(Draft& draft, const EnglishPlan& plan) {
  if (plan.roof == RoofKind::gable && plan.parapet > 0) return ParapetRow(draft, plan).build();
  Massing massing;
  massing.roof = plan.roof;
  massing.width = plan.width();
  massing.depth = plan.depth;
  massing.wall_height = plan.wall_height();
  massing.slope = plan.slope;
  massing.overhang = plan.overhang;
  massing.parapet = plan.parapet;
  EnglishShell shell;
  shell.house = build_house(draft, massing);
  return shell;
}

}  // namespace oriel::generator
