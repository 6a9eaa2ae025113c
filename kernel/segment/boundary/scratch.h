#pragma once

#include "kernel/base/assert.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/planar.h"

#include <cstddef>
#include <iterator>
#include <vector>

namespace oriel::detail {

/// A facet of a body that is being cut: Boundary::facet. Not one of the solid, which is a FacetId.
using BodyFacetId = Id<struct BodyFacetTag>;
/// A crossing of a section: Section::crossings.
using CrossingId = Id<struct CrossingTag>;

constexpr std::size_t index_of(int i) { return static_cast<std::size_t>(i); }
template <class Tag>
constexpr std::size_t index_of(Id<Tag> id) {
  return id.index();
}

/// A set of numbers or ids that is emptied in no time: what was put in before the last start()
/// counts as absent.
template <class Key>
class StampSet {
 public:
  void start(int size) {
    make_room(size);
    ++last_;
  }
  /// For keys below `size`.
  void make_room(int size) {
    if (std::ssize(stamps_) < size) stamps_.resize(static_cast<std::size_t>(size), 0);
  }
  /// True if it was not in.
  bool insert(Key key) {
    ORIEL_ASSERT(index_of(key) < stamps_.size(), "start() was told of fewer");
    int& stamp = stamps_[index_of(key)];
    if (stamp == last_) return false;
    stamp = last_;
    return true;
  }
  [[nodiscard]] bool contains(Key key) const {
    ORIEL_ASSERT(index_of(key) < stamps_.size(), "start() was told of fewer");
    return stamps_[index_of(key)] == last_;
  }

 private:
  std::vector<int> stamps_;
  int last_ = 0;
};

/// A number or id for each of some keys, emptied in no time likewise.
template <class Key, class Value = int>
class StampMap {
 public:
  void start(int size) {
    make_room(size);
    ++last_;
  }
  /// For keys below `size`.
  void make_room(int size) {
    if (std::ssize(entries_) < size) entries_.resize(static_cast<std::size_t>(size));
  }
  void set(Key key, Value value) {
    ORIEL_ASSERT(index_of(key) < entries_.size(), "start() was told of fewer");
    entries_[index_of(key)] = {last_, value};
  }
  /// -1, or an invalid id, if there is none, as for what is out of range.
  [[nodiscard]] Value find(Key key) const {
    if (index_of(key) >= entries_.size()) return Value{-1};
    const StampedValue& entry = entries_[index_of(key)];
    return entry.stamp == last_ ? entry.value : Value{-1};
  }

 private:
  struct StampedValue {
    int stamp = 0;
    Value value{-1};
  };
  std::vector<StampedValue> entries_;
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
  CrossingId crossing;
  bool leads_down;  ///< the facet's own half-edge leads down here: a chord begins
};

/// Room that steps use one after the other, numbered by the facets and half-edges of the body at
/// hand. A step owns the members it starts until it ends; the comments say which.
struct Scratch {
  // Sections.
  StampSet<EdgeId> crossed_edges;
  IndexedVector<BodyFacetId, Chords> chords;
  int last_chords = 0;
  std::vector<BodyFacetId> facets_with_several;
  std::vector<std::vector<ChordEnd>> chord_ends;  ///< of those facets
  void start_chords(int facets) {
    if (chords.size() < index_of(facets)) chords.resize(index_of(facets));
    ++last_chords;
    facets_with_several.clear();
  }
  /// An empty list for the ends in one more facet with several chords.
  std::vector<ChordEnd>& add_chord_ends(BodyFacetId facet) {
    facets_with_several.push_back(facet);
    if (chord_ends.size() < facets_with_several.size()) chord_ends.emplace_back();
    auto& ends = chord_ends[facets_with_several.size() - 1];
    ends.clear();
    return ends;
  }
  Chords& chords_in(BodyFacetId facet) {
    Chords& here = chords[facet];
    if (here.stamp != last_chords) here = {last_chords};
    return here;
  }

  // Chains of edges. By point: how many steps lead from it, and to it; 0 between two uses.
  IndexedVector<PointId, int> leaving, entering;
  IndexedVector<PointId, PointId> after;  ///< where the step from a point leads to
  StampSet<PointId> neck_points;          ///< in the plane at hand

  // Floods.
  StampSet<EdgeId> flooded_edges;
  StampSet<BodyFacetId> flooded_facets, facets_with_chord;
  IndexedVector<BodyFacetId, CrossingId> last_chord_in;
  IndexedVector<EdgeId, CrossingId> crossing_of_edge;

  // Pockets.
  StampSet<EdgeId> rim_edges;
  StampMap<EdgeId> place_in_walk;
  StampMap<PointId> corner_at_point;
  StampSet<FacetId> met_sources;

  // Patches.
  StampMap<EdgeId> place_in_rim;

  // Cuts.
  StampSet<BodyFacetId> facets_of_lump, facets_of_piece;
  StampMap<EdgeId, EdgeId> copy_of;
  StampMap<EdgeId, EdgeId> twin_of_rim;  ///< as they were before the cut
  Outline outline;
  StampSet<PointId> met_points;

  // Copies of parts.
  StampMap<PointId, PointId> moved_points;
  StampMap<int> moved_planes;
};

}  // namespace oriel::detail
