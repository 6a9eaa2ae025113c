#pragma once

#include "kernel/geometry/planar.h"

#include <cstddef>
#include <iterator>
#include <vector>

namespace oriel::detail {

/// A set of numbers that is emptied in no time: what was put in before the last start() counts as
/// absent.
class StampSet {
 public:
  void start(int size) {
    make_room(size);
    ++last_;
  }
  /// For numbers below `size`.
  void make_room(int size) {
    if (std::ssize(stamps_) < size) stamps_.resize(static_cast<std::size_t>(size), 0);
  }
  /// True if it was not in.
  bool insert(int i) {
    int& stamp = stamps_[static_cast<std::size_t>(i)];
    if (stamp == last_) return false;
    stamp = last_;
    return true;
  }
  [[nodiscard]] bool contains(int i) const { return stamps_[static_cast<std::size_t>(i)] == last_; }

 private:
  std::vector<int> stamps_;
  int last_ = 0;
};

/// A number for each of some numbers, emptied in no time likewise.
class StampMap {
 public:
  void start(int size) {
    make_room(size);
    ++last_;
  }
  /// For numbers below `size`.
  void make_room(int size) {
    if (std::ssize(entries_) < size) entries_.resize(static_cast<std::size_t>(size));
  }
  void set(int i, int number) { entries_[static_cast<std::size_t>(i)] = {last_, number}; }
  /// -1 if there is none, as for what is out of range.
  [[nodiscard]] int find(int i) const {
    if (i < 0 || i >= std::ssize(entries_)) return -1;
    const StampedNumber& entry = entries_[static_cast<std::size_t>(i)];
    return entry.stamp == last_ ? entry.number : -1;
  }

 private:
  struct StampedNumber {
    int stamp = 0;
    int number = -1;
  };
  std::vector<StampedNumber> entries_;
  int last_ = 1;
};

/// The ends of chords of a section in one facet. An end is twice its crossing, and one more if the
/// chord begins there: the facet's own half-edge leads down.
struct Chords {
  int stamp = 0;
  int ends = 0;                 ///< how many
  int first = -1, second = -1;  ///< ends
  int number = -1;              ///< among facets with more ends
};

/// A crossing as one of its two facets sees it.
struct ChordEnd {
  double along;  ///< place on the line in which the facet meets the plane
  int crossing;
  bool leads_down;  ///< the facet's own half-edge leads down here: a chord begins
};

/// Room that steps use one after the other, numbered by the facets and half-edges of the body at
/// hand. A step owns the members it starts until it ends; the comments say which.
struct Scratch {
  // Sections.
  StampSet crossed_edges;
  std::vector<Chords> chords;  ///< by facet
  int last_chords = 0;
  std::vector<int> facets_with_several;
  std::vector<std::vector<ChordEnd>> chord_ends;  ///< of those facets
  void start_chords(int facets) {
    if (std::ssize(chords) < facets) chords.resize(static_cast<std::size_t>(facets));
    ++last_chords;
    facets_with_several.clear();
  }
  /// An empty list for the ends in one more facet with several chords.
  std::vector<ChordEnd>& add_chord_ends(int facet) {
    facets_with_several.push_back(facet);
    if (chord_ends.size() < facets_with_several.size()) chord_ends.emplace_back();
    auto& ends = chord_ends[facets_with_several.size() - 1];
    ends.clear();
    return ends;
  }
  Chords& chords_in(int facet) {
    Chords& here = chords[static_cast<std::size_t>(facet)];
    if (here.stamp != last_chords) here = {last_chords};
    return here;
  }

  // Chains of edges. By point: how many steps lead from it, and to it; 0 between two uses.
  std::vector<int> leaving, entering;
  std::vector<int> after;  ///< where the step from a point leads to

  // Floods.
  StampSet flooded_edges, flooded_facets;
  StampSet facets_with_chord;
  std::vector<int> last_chord_in;     ///< by facet
  std::vector<int> crossing_of_edge;  ///< by half-edge

  // Pockets.
  StampSet rim_edges;
  StampMap place_in_walk;    ///< by half-edge
  StampMap corner_at_point;  ///< by point
  StampSet met_sources;      ///< by facet of the solid

  // Patches.
  StampMap place_in_rim;  ///< by half-edge

  // Cuts.
  StampSet facets_of_lump, facets_of_piece;
  StampMap copy_of;      ///< by half-edge
  StampMap twin_of_rim;  ///< by half-edge, as they were before the cut
  Outline outline;
  StampSet met_points;

  // Copies of parts.
  StampMap moved_points, moved_planes;
};

}  // namespace oriel::detail
