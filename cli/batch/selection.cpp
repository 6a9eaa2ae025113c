#include "cli/batch/selection.h"

#include <algorithm>
#include <limits>

namespace oriel::cli {

namespace {

/// FNV-1a over the id, begun with the seed, then mixed (splitmix64) so that all bits count.
std::uint64_t draw(std::uint64_t seed, const std::string& id) {
  std::uint64_t hash = 0xcbf29ce484222325U ^ (seed * 0x9e3779b97f4a7c15U);
  for (const char byte : id) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  hash = (hash ^ (hash >> 30U)) * 0xbf58476d1ce4e5b9U;
  hash = (hash ^ (hash >> 27U)) * 0x94d049bb133111ebU;
  return hash ^ (hash >> 31U);
}

bool is_in(const std::vector<double>& bbox, const Building& building) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 least{kInfinity, kInfinity, kInfinity}, most{-kInfinity, -kInfinity, -kInfinity};
  for (const Vec3 v : building.vertices) {
    least = {std::min(least.x, v.x), std::min(least.y, v.y), std::min(least.z, v.z)};
    most = {std::max(most.x, v.x), std::max(most.y, v.y), std::max(most.z, v.z)};
  }
  const Vec3 middle = building.frame.origin_m + 0.5 * (least + most);
  return middle.x >= bbox[0] && middle.y >= bbox[1] && middle.x <= bbox[2] && middle.y <= bbox[3];
}

}  // namespace

bool Selection::is_all() const {
  return ids.empty() && bbox.empty() && cotype.empty() && one_in == 1 && !is_exclusion;
}

bool Selection::fits(const std::string& id, const std::string& type) const {
  return (cotype.empty() || cotype == type) &&
         (ids.empty() || std::ranges::find(ids, id) != ids.end()) && draw(seed, id) % one_in == 0;
}

bool Selection::takes(const Building& building, const std::string& type) const {
  return (fits(building.id, type) && (bbox.empty() || is_in(bbox, building))) != is_exclusion;
}

bool Selection::takes_feature(const std::string& id, const std::string& type) const {
  return !cotype.empty() && takes(id, type);
}

bool Selection::takes(const std::string& id, const std::string& type) const {
  return (fits(id, type) && bbox.empty()) != is_exclusion;
}

}  // namespace oriel::cli
