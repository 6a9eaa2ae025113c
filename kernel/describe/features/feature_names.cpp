#include "kernel/describe/features/feature_names.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// 64-bit FNV-1a, gone on with from the hash of what stands before.
constexpr std::uint64_t kHashOfNothing = 0xcbf29ce484222325ULL;
std::uint64_t hash_on(std::uint64_t hash, std::string_view text) {
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

/// A hash in 13 characters of base 32.
std::string written(std::uint64_t hash) {
  std::array<char, 14> digits{'f'};
  for (std::size_t i = 1; i < digits.size(); ++i, hash /= 32)
    digits[i] = "0123456789abcdefghjkmnpqrstvwxyz"[hash % 32];
  return {digits.data(), digits.size()};
}

/// The hash gone on with by "|" and the millimetres of each.
std::uint64_t hash_on_millimetres(std::uint64_t hash, std::initializer_list<double> metres) {
  for (const double m : metres) {
    std::array<char, 24> text{'|'};
    const auto end =
        std::to_chars(text.data() + 1, text.data() + text.size(), std::llround(m * 1000)).ptr;
    hash = hash_on(hash, {text.data(), end});
  }
  return hash;
}

}  // namespace

void name_features(FeatureTable& table, const Building& building,
                   const Segmentation& segmentation) {
  std::unordered_map<std::uint64_t, int> uses;  // by hash
  uses.reserve(segmentation.features.size());
  const std::uint64_t start =
      hash_on(kHashOfNothing, fmt::format("{}|{}|", building.id, building.lod));
  for (std::size_t i = 0; i < segmentation.features.size(); ++i) {
    const Feature& f = segmentation.features[i];
    const Box box = f.box.moved(building.frame.origin_m);
    std::uint64_t hash =
        hash_on_millimetres(hash_on(start, to_string(f.sense)),
                            {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z});
    if (!f.planes.empty()) {
      const Vec3 n = segmentation.planes[f.planes.front().index()].normal;
      hash = hash_on_millimetres(hash, {n.x, n.y, n.z});
    }
    // Features that agree in all this (parts of one box) are told apart by their order.
    const int use = uses[hash]++;
    if (use > 0) hash = hash_on(hash, fmt::format("|{}", use));
    table.set_id(FeatureId{static_cast<int>(i)}, written(hash));
  }
}

}  // namespace oriel::detail
