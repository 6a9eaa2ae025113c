#include "model/polygon_owners.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace oriel {

namespace {

std::size_t index(int id) { return static_cast<std::size_t>(id); }

/// What no cut made is as large as what it owns: imprints and uncut features. They stand behind the
/// features of the tree, of each kind inner ones behind outer ones.
std::vector<double> sizes_of(const std::vector<Feature>& features) {
  std::vector<double> size_m3(features.size());
  for (std::size_t f = 0; f < features.size(); ++f) size_m3[f] = features[f].volume_m3;
  const auto pass_on = [&](std::size_t f) {
    const FeatureId host = features[f].host;
    if (host.is_valid() && !features[host.index()].node.is_valid())
      size_m3[host.index()] += size_m3[f];
  };
  for (std::size_t f = 0; f < features.size(); ++f)
    if (features[f].node.is_valid()) pass_on(f);
  for (std::size_t f = features.size(); f-- > 0;)
    if (!features[f].node.is_valid()) pass_on(f);
  return size_m3;
}

}  // namespace

PolygonOwners polygon_owners(const Segmentation& segmentation, std::size_t polygons) {
  const auto& features = segmentation.features;
  const auto size_m3 = sizes_of(features);
  std::vector<int> order(features.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int f) {
    return std::tuple(size_m3[index(f)], features[index(f)].source_polygons.size(), -f);
  });
  std::vector<int> first(polygons + 1, 0);
  for (const Feature& feature : features)
    for (const int polygon : feature.source_polygons) {
      if (polygon < 0 || index(polygon) >= polygons)
        throw std::logic_error("a feature lists a polygon that the building does not have");
      ++first[index(polygon) + 1];
    }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> owners(index(first.back())), next(first);
  for (const int feature : order)
    for (const int polygon : features[index(feature)].source_polygons)
      owners[index(next[index(polygon)]++)] = feature;
  return {std::move(first), std::move(owners)};
}

PolygonOwners polygon_owners(const Segmentation& segmentation, const Building& building) {
  int count = 0;
  for (const Polygon& polygon : building.polygons) count = std::max(count, polygon.source + 1);
  return polygon_owners(segmentation, index(count));
}

}  // namespace oriel
