#include "examples/generator/english/english_entrance.h"

#include "examples/generator/facade/openings.h"
#include "examples/generator/house/attachments.h"
#include "examples/generator/house/extrude.h"

#include <algorithm>
#include <string>

namespace oriel::generator {
namespace {

/// Frame around the leaf and bar between it and the fanlight; how far both lie behind the frame.
constexpr Um kDoorFrame = 60'000;
constexpr Um kLeafDepth = 30'000;
/// Wall of a porch beside the door in it.
constexpr Um kPorchSide = 120'000;
/// Stairs are wider than the door or porch they lead to.
constexpr Um kStairSide = 150'000;
constexpr Um kHoodSide = 200'000;
/// How far a gabled hood may reach above the ceiling of the ground floor.
constexpr Um kGableReach = 500'000;
constexpr Um kPilasterWidth = 240'000, kPilasterGap = 20'000;

Um door_width(const EnglishPlan& plan) { return plan.entrance.leaf_width + 2 * kDoorFrame; }

/// Frame, leaf, bar, fanlight and frame.
Um door_height(const EntrancePlan& plan, bool has_fanlight) {
  const Um glass = has_fanlight && plan.fanlight > 0 ? plan.fanlight + kDoorFrame : 0;
  return plan.leaf_height + kDoorFrame + glass;
}

/// A pocket in the wall before the door; the vocabulary has no word for it, so it is decor. Returns
/// its back wall.
Panel add_porch(const EnglishSite& site, Panel& panel, const Rect& rect) {
  Draft& draft = site.draft;
  const Um depth = site.plan.entrance.porch;
  const int object = draft.add_object(
      {Class::other, "porch", draft.owner(panel.facet).object, panel.installation, {}, {}});
  panel.reserved.push_back(rect);
  const FacetId ground = rect.v0 == 0 ? panel.ground : kNewFacet;
  const BlockFacets room =
      carve_block(draft, panel.frame, {rect.u0, rect.u1, rect.v0, rect.v1, -depth, 0}, {object},
                  {.bottom = ground, .front = panel.facet});
  return {room.back, panel.frame.moved(0, 0, -depth), ground, rect, {}, object, false};
}

void add_brackets(const EnglishSite& site, const Panel& panel, const Rect& hood, FacetId below,
                  Um depth) {
  const Um width = 100_mm, height = 250_mm, inset = 20_mm;
  for (const Um u0 : {hood.u0 + inset, hood.u1 - inset - width}) {
    const int object = site.draft.add_object({Class::other,
                                              "bracket",
                                              site.draft.owner(panel.facet).object,
                                              panel.installation,
                                              {},
                                              {}});
    add_block(site.draft, panel.frame, {u0, u0 + width, hood.v0 - height, hood.v0, 0, depth},
              {object}, {.top = below, .back = panel.facet});
  }
}

/// A slab, perhaps on two brackets, or a small gabled roof.
void add_hood(const EnglishSite& site, Panel& panel, const Rect& rect) {
  const bool is_gabled = site.plan.entrance.hood == Hood::gabled;
  const int object = site.draft.add_object({Class::canopy,
                                            is_gabled ? "gabledHood" : "canopy",
                                            site.draft.owner(panel.facet).object,
                                            panel.installation,
                                            {},
                                            {}});
  const Um depth = site.length(500_mm, 900_mm);
  panel.reserved.push_back(rect);
  if (is_gabled) {
    const Um middle = (rect.u0 + rect.u1) / 2'000 * 1'000;
    extrude(site.draft, panel.frame,
            {{{rect.u0, rect.v0}, {rect.u1, rect.v0}, {middle, rect.v1}}, 0, depth}, Matter::solid,
            {object}, {{}, panel.facet});
    return;
  }
  const BlockFacets slab =
      add_block(site.draft, panel.frame, {rect.u0, rect.u1, rect.v0, rect.v1, 0, depth}, {object},
                {.back = panel.facet});
  if (!site.plan.entrance.has_pilasters && site.chance(0.5))
    add_brackets(site, panel, rect, slab.bottom, depth * 6 / 10'000 * 1'000);
}

Um draw_hood_height(const EnglishSite& site) {
  return site.plan.entrance.hood == Hood::gabled ? site.length(450_mm, 600_mm)
                                                 : site.length(80_mm, 150_mm);
}

}  // namespace

Um entrance_width(const EnglishPlan& plan) {
  const EntrancePlan& entrance = plan.entrance;
  Um side = kStairSide;
  if (entrance.porch > 0) side = std::max(side, kPorchSide + kStairSide);
  if (entrance.has_pilasters) side = std::max(side, kPilasterGap + kPilasterWidth);
  if (entrance.hood != Hood::none) side = std::max(side, kHoodSide);
  return door_width(plan) + 2 * side;
}

Rect add_english_door(const EnglishSite& site, Panel& panel, Um middle, Um v0, bool has_fanlight) {
  const EntrancePlan& plan = site.plan.entrance;
  Draft& draft = site.draft;
  const Um reveal = site.reveal(), width = door_width(site.plan);
  const Um u0 = (middle - width / 2) / 1'000 * 1'000, head = v0 + plan.leaf_height;
  const Rect r{u0, u0 + width, v0, v0 + door_height(plan, has_fanlight)};
  const int object = draft.add_object({Class::door,
                                       "Door",
                                       draft.owner(panel.facet).object,
                                       panel.installation,
                                       reveal > 0 ? reveal + kLeafDepth : 0,
                                       {}});
  const FacetId frame = draft.add_facet({object});
  panel.reserved.push_back(r);
  if (reveal == 0) {
    draft.add_ring(panel.facet, reversed(rectangle(panel.frame, r, 0)));
    draft.add_ring(frame, rectangle(panel.frame, r, 0));
    return r;
  }
  const BlockFacets niche = carve_block(
      draft, panel.frame, {r.u0, r.u1, r.v0, r.v1, -reveal, 0}, {object, true},
      {.bottom = v0 == 0 ? panel.ground : kNewFacet, .back = frame, .front = panel.facet});
  const Um left = r.u0 + kDoorFrame, right = r.u1 - kDoorFrame, deep = -reveal - kLeafDepth;
  carve_block(draft, panel.frame, {left, right, v0, head, deep, -reveal}, {object},
              {.bottom = niche.bottom, .front = frame});
  if (has_fanlight && plan.fanlight > 0)
    carve_block(draft, panel.frame,
                {left, right, head + kDoorFrame, head + kDoorFrame + plan.fanlight, deep, -reveal},
                {object}, {.front = frame});
  return r;
}

void add_plain_door(const EnglishSite& site, Panel& panel, const Rect& rect,
                    std::string_view subclass) {
  Opening door{Class::door, std::string(subclass), rect, site.reveal()};
  if (door.recess > 0 && rect.width() >= 1200_mm && subclass == "frenchWindow") door.columns = 2;
  add_opening(site.draft, panel, door);
}

Rect place_entrance(const EnglishSite& site, Panel& panel, Um middle, Um ceiling) {
  const EnglishPlan& plan = site.plan;
  const Um floor = plan.floor(0), half = entrance_width(plan) / 2'000 * 1'000;
  middle = middle / 1'000 * 1'000;
  Rect opening;
  if (plan.entrance.porch > 0) {
    const Um width = (door_width(plan) + 2 * kPorchSide) / 2'000 * 2'000;
    const Um wanted = floor + door_height(plan.entrance, true) + site.length(60_mm, 250_mm);
    opening = centred({middle - half, middle + half, 0, 0}, width, floor,
                      std::min(wanted, ceiling) - floor);
    Panel back = add_porch(site, panel, opening);
    const bool has_room = opening.height() >= door_height(plan.entrance, true) + 40_mm;
    add_english_door(site, back, middle, floor, has_room);
  } else {
    opening = add_english_door(site, panel, middle, floor, true);
  }
  if (plan.steps > 0) {
    const Um landing = site.length(300_mm, 900_mm), going = site.length(280_mm, 300_mm);
    add_stairs(site.draft, panel, {opening.u0 - kStairSide, opening.u1 + kStairSide, 0, floor},
               plan.steps, landing, going);
  }
  Um top = opening.v1;
  if (plan.entrance.has_pilasters)
    for (const Um u0 : {opening.u0 - kPilasterGap - kPilasterWidth, opening.u1 + kPilasterGap})
      add_decor(site.draft, panel, "pilaster", {u0, u0 + kPilasterWidth, floor + 20_mm, top},
                60_mm);
  if (plan.entrance.hood != Hood::none) {
    const Um v0 = top + 60_mm;
    const Rect hood{middle - half, middle + half, v0, v0 + draw_hood_height(site)};
    // A gabled hood may reach up between the windows of the next storey.
    const bool is_gabled = plan.entrance.hood == Hood::gabled;
    if (hood.v1 <= ceiling + (is_gabled ? kGableReach : 0)) {
      add_hood(site, panel, hood);
      top = hood.v1;
    }
  }
  return {middle - half, middle + half, 0, top};
}

}  // namespace oriel::generator
