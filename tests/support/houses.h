#pragma once

#include "tests/support/convex_body.h"
#include "tests/support/shapes.h"

/// The bodies of docs/segmentation.md with exact answers, and some houses.
namespace oriel::test {

/// x 0…12, y 0…8, ridge along x at z = 9 over eaves at z = 6.
inline std::vector<HalfSpace> gable() {
  return {{{-1, 0, 0}, 0}, {{1, 0, 0}, 12},  {{0, -1, 0}, 0}, {{0, 1, 0}, 8},
          {{0, 0, -1}, 0}, {{0, -3, 4}, 24}, {{0, 3, 4}, 48}};
}

inline Building two_boxes_on_a_slab() {  // T1
  return BoxBody()
      .add({0, 0, 0}, {8, 4, 2})
      .add({1, 1, 2}, {2, 3, 3})
      .add({5, 1, 2}, {6, 3, 3})
      .build();
}

inline Building pocket() {  // T2
  return BoxBody().add({0, 0, 0}, {4, 4, 2}).remove({1, 1, 1}, {2, 2, 2}).build();
}

inline Building three_notches() {  // T3
  return BoxBody()
      .add({0, 0, 0}, {8, 4, 4})
      .remove({1, 0, 3}, {3, 1, 4})
      .remove({5, 2, 3}, {6, 3, 4})
      .remove({7, 3, 3}, {8, 4, 4})
      .build();
}

inline Building long_notch() {  // T4
  return BoxBody().add({0, 0, 0}, {4, 2, 6}).remove({3, 0, 4}, {4, 2, 6}).build();
}

inline Building corner_notch() {  // T5
  return BoxBody().add({0, 0, 0}, {4, 4, 3}).remove({2, 2, 1}, {4, 4, 3}).build();
}

inline Building six_pockets() {  // T6
  BoxBody body;
  body.add({0, 0, 0}, {12, 6, 8});
  for (const double x : {1, 5, 9})
    for (const double z : {1, 5}) body.remove({x, 0, z}, {x + 2, 1, z + 2});
  return body.build();
}

inline Building l_of_boxes() {  // T7
  return BoxBody().add({0, 0, 0}, {2, 1, 1}).add({0, 1, 0}, {1, 2, 1}).build();
}

inline Building gabled_house() { return ConvexBody().add(gable()).build(); }  // T10

inline Building cross_gable() {  // T11
  return ConvexBody()
      .add(gable())
      .add({{{-1, 0, 0}, -3},
            {{1, 0, 0}, 9},
            {{0, -1, 0}, -4},
            {{0, 1, 0}, 14},
            {{0, 0, -1}, 0},
            {{-1, 0, 1}, 3},
            {{1, 0, 1}, 15}})
      .build();
}

inline Building full_house() {  // T16
  ConvexBody house;
  house.add(gable());
  house.add({{{-1, 0, 0}, -3},
             {{1, 0, 0}, 3.4},
             {{0, -1, 0}, -2},
             {{0, 1, 0}, 2.36},
             {{0, 3, -4}, -24},
             {{0, 0, 1}, 10}});
  for (const bool is_front : {true, false}) {
    const double y0 = is_front ? 0 : 7.8, y1 = is_front ? 0.2 : 8;
    for (const double x : {1.0, 5.4, 9.8})
      for (const double z : {1.0, 4.0})
        if (x == 5.4 && z == 1)
          house.remove(box({x, y0, 0}, {x + 1.2, y1, 2.2}));
        else
          house.remove(box({x, y0, z}, {x + 1.2, y1, z + 1.5}));
  }
  for (const double x : {0.0, 11.8})
    for (const double z : {1.0, 4.0}) house.remove(box({x, 3, z}, {x + 0.2, 4.2, z + 1.5}));
  house.add(box({4, 8, 3}, {8, 9.5, 3.2}));
  return house.build();
}

/// A chimney of 0.6 m square on the ridge.
inline Building ridge_chimney() {
  return ConvexBody().add(gable()).add(box({5, 3.7, 5}, {5.6, 4.3, 11})).build();
}

inline Building l_house() {
  return BoxBody().add({0, 0, 0}, {12, 8, 6}).add({0, 8, 0}, {4, 14, 6}).build();
}

/// A gabled dormer on the front slope with a window niche larger than the frame around it.
inline Building dormer_with_window() {
  return ConvexBody()
      .add(gable())
      .add({{{-1, 0, 0}, -4},
            {{1, 0, 0}, 6},
            {{0, -1, 0}, -0.5},
            {{0, 1, 0}, 3},
            {{0, 0, -1}, -6},
            {{-1, 0, 1}, 3.6},
            {{1, 0, 1}, 13.6}})
      .remove(box({4.2, 0.5, 6.6}, {5.8, 0.7, 7.5}))
      .build();
}

/// A flat house with a terrace sunk into its roof and a chimney on the floor of the terrace that
/// stays below the roof.
inline Building terrace_with_chimney() {
  return BoxBody()
      .add({0, 0, 0}, {10, 8, 6})
      .remove({2, 2, 4}, {8, 6, 6})
      .add({4, 3, 4}, {4.5, 3.5, 5.5})
      .build();
}

/// A chimney with a wider head.
inline Building chimney_with_head() {
  return BoxBody()
      .add({0, 0, 0}, {10, 8, 6})
      .add({4, 3, 6}, {4.6, 3.6, 7.5})
      .add({3.9, 2.9, 7.5}, {4.7, 3.7, 7.8})
      .build();
}

/// A door on the ground: a niche of two planes.
inline Building house_with_door() {
  return BoxBody().add({0, 0, 0}, {10, 8, 6}).remove({4, 0, 0}, {5, 0.3, 2.1}).build();
}

/// A balcony slab with a parapet around its hollow.
inline Building balcony() {
  return BoxBody()
      .add({0, 0, 0}, {10, 8, 6})
      .add({3, -1.5, 3}, {7, 0, 4})
      .remove({3.1, -1.4, 3.2}, {6.9, 0, 4})
      .build();
}

/// A terrace sunk into a flat roof, and a block on its floor so large that the terrace is filled
/// before the block is cut off: the block is then a hole of the terrace's air.
inline Building terrace_with_block() {
  return BoxBody()
      .add({0, 0, 0}, {10, 8, 6})
      .remove({2, 2, 4}, {8, 6, 6})
      .add({3, 3, 4}, {6, 5, 5.5})
      .build();
}

/// A window niche with a box on its back wall.
inline Building window_with_box() {
  return BoxBody()
      .add({0, 0, 0}, {10, 8, 6})
      .remove({2, 0, 2}, {4, 0.4, 4})
      .add({2.5, 0.2, 2.5}, {3.5, 0.4, 3.5})
      .build();
}

/// A window niche with a cross of mullions that spans it.
inline Building window_with_mullions() {
  return BoxBody()
      .add({0, 0, 0}, {10, 8, 6})
      .remove({2, 0, 2}, {4, 0.4, 4})
      .add({2.9, 0.2, 2}, {3.1, 0.4, 4})
      .add({2, 0.2, 2.9}, {4, 0.4, 3.1})
      .build();
}

/// A niche in the wall that reaches into a recess of the floor above: a hole out of its facet.
inline Building niche_over_an_edge() {
  return BoxBody()
      .add({0, 0, 0}, {10, 8, 6})
      .add({0, 1, 6}, {10, 8, 9})
      .remove({4, 0, 4}, {6, 0.5, 6})
      .remove({4, 1, 6}, {6, 1.5, 8})
      .build();
}

/// A box with a closed void, in which another box stands free, and a second box beside.
inline Building cavity_and_lumps() {
  return BoxBody()
      .add({0, 0, 0}, {6, 6, 6})
      .remove({1, 1, 1}, {5, 5, 5})
      .add({2, 2, 2}, {4, 4, 4})
      .add({8, 0, 0}, {10, 6, 3})
      .build();
}

/// A slab between two blocks: a cut through it parts the body.
inline Building two_towers() {
  return BoxBody()
      .add({0, 0, 0}, {3, 3, 8})
      .add({7, 0, 0}, {10, 3, 8})
      .add({3, 1, 4}, {7, 2, 5})
      .build();
}

/// A passage right through a block.
inline Building passage() {
  return BoxBody().add({0, 0, 0}, {10, 8, 6}).remove({4, 0, 0}, {6, 8, 3}).build();
}

struct NamedBody {
  const char* name;
  Building (*make)();
};

/// All of them.
inline const std::vector<NamedBody>& bodies() {
  static const std::vector<NamedBody> all{{"two_boxes_on_a_slab", two_boxes_on_a_slab},
                                          {"pocket", pocket},
                                          {"three_notches", three_notches},
                                          {"long_notch", long_notch},
                                          {"corner_notch", corner_notch},
                                          {"six_pockets", six_pockets},
                                          {"l_of_boxes", l_of_boxes},
                                          {"gabled_house", gabled_house},
                                          {"cross_gable", cross_gable},
                                          {"full_house", full_house},
                                          {"ridge_chimney", ridge_chimney},
                                          {"l_house", l_house},
                                          {"dormer_with_window", dormer_with_window},
                                          {"terrace_with_chimney", terrace_with_chimney},
                                          {"chimney_with_head", chimney_with_head},
                                          {"house_with_door", house_with_door},
                                          {"balcony", balcony},
                                          {"terrace_with_block", terrace_with_block},
                                          {"window_with_box", window_with_box},
                                          {"window_with_mullions", window_with_mullions},
                                          {"niche_over_an_edge", niche_over_an_edge},
                                          {"cavity_and_lumps", cavity_and_lumps},
                                          {"two_towers", two_towers},
                                          {"passage", passage}};
  return all;
}

}  // namespace oriel::test
