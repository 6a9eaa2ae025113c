#pragma once

#include "kernel/segment/segment.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace oriel::test {

/// A building all the way to its segmentation.
struct Segmented {
  Building building;
  Solid solid;
  Segmentation segmentation;
};

inline Segmented segmented(Building building, const SegmentOptions& options = {}) {
  Solid solid = solid_of(building, options.tolerances);
  Segmentation segmentation = segment(building, solid, options);
  return {std::move(building), std::move(solid), std::move(segmentation)};
}

inline Segmented segmented(Building building, Order order) {
  SegmentOptions options;
  options.order = order;
  return segmented(std::move(building), options);
}

/// Exact bodies have exact values: no tolerance but that of doubles.
inline Segmented in_paper_order(Building building) {
  SegmentOptions options;
  options.order = Order::paper;
  options.tolerances.value_rel = 1e-9;
  return segmented(std::move(building), options);
}

/// The features of one sense, in their order.
inline std::vector<FeatureId> features_of(const Segmentation& segmentation, Sense sense) {
  std::vector<FeatureId> ids;
  for (int i = 0; i < std::ssize(segmentation.features); ++i)
    if (segmentation.features[static_cast<std::size_t>(i)].sense == sense) ids.push_back({i});
  return ids;
}

inline std::vector<FeatureId> all_features(const Segmentation& segmentation) {
  std::vector<FeatureId> ids;
  for (int i = 0; i < std::ssize(segmentation.features); ++i) ids.push_back({i});
  return ids;
}

/// The inner nodes from the root along the rest, as they were split.
inline std::vector<CsgNode> splits_of(const Segmentation& segmentation) {
  std::vector<CsgNode> splits;
  for (NodeId id = segmentation.root;;) {
    const CsgNode& node = segmentation.nodes[id.index()];
    if (node.kind == CsgNode::Kind::leaf) return splits;
    splits.push_back(node);
    if (node.rest.size() != 1) return splits;
    id = node.rest[0];
  }
}

/// The feature whose box is [min, max] to a millimetre, or invalid.
inline FeatureId feature_in(const Segmentation& segmentation, Vec3 min, Vec3 max) {
  for (const FeatureId id : all_features(segmentation)) {
    const Box& box = segmentation.features[id.index()].box;
    if (length(box.min - min) < 1e-3 && length(box.max - max) < 1e-3) return id;
  }
  return {};
}

/// The volume that the solid has without these features (ascending); the volume of each is with
/// what was found in it.
inline double volume_without(const Segmented& s, const std::vector<FeatureId>& gone) {
  double volume = volume_m3(s.solid);
  for (const FeatureId id : gone) {
    const Feature& f = s.segmentation.features[id.index()];
    if (f.parent.is_valid() && std::ranges::binary_search(gone, f.parent)) continue;
    volume += f.sense == Sense::protrusion ? -f.volume_m3 : f.volume_m3;
  }
  return volume;
}

}  // namespace oriel::test
