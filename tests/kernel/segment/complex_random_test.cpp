#include "kernel/segment/complex/cell_complex.h"
#include "tests/kernel/segment/complex_checks.h"
#include "tests/support/shapes.h"

#include <array>
#include <map>
#include <random>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::Segmented;

constexpr int kMin = -3, kMax = 13;

/// A block with up to six boxes added or taken away, all of whole metres.
Building random_complex_body(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&](int n) {
    return static_cast<double>(random() % static_cast<std::uint64_t>(n));
  };
  test::BoxBody body;
  body.add({0, 0, 0}, {8, 8, 8});
  for (double i = 1 + below(6); i > 0; --i) {
    const double x = below(11) - 2, y = below(11) - 2, z = below(11) - 2;
    const double a = 1 + below(4), b = 1 + below(4), c = 1 + below(4);
    const bool is_added = below(2) == 0;
    const Vec3 min{x, y, z}, max{x + a, y + b, z + c};
    is_added ? body.add(min, max) : body.remove(min, max);
  }
  return body.build("random-" + std::to_string(seed));
}

/// All cuts are in planes of whole metres, so each cube of a metre belongs to one cell, and contact
/// areas are numbers of squares between cubes.
using Contacts = std::map<std::pair<CellId, CellId>, int>;

Contacts counted_contacts(const Segmentation& segmentation) {
  test::SlowOwner owner(segmentation);
  std::map<std::array<int, 3>, CellId> owners;
  for (int x = kMin; x < kMax; ++x)
    for (int y = kMin; y < kMax; ++y)
      for (int z = kMin; z < kMax; ++z) owners[{x, y, z}] = owner({x + 0.5, y + 0.5, z + 0.5});
  Contacts contacts;
  for (const auto& [cube, cell] : owners)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto next = cube;
      ++next[axis];
      const auto other = owners.find(next);
      if (other == owners.end() || other->second == cell) continue;
      ++contacts[std::minmax(cell, other->second)];
    }
  return contacts;
}

Contacts contacts_of(const CellComplex& complex, const Segmentation& segmentation) {
  Contacts contacts;
  for (const CellId cell : cells_of(segmentation, {}))
    for (const auto& [other, area] : complex.neighbours(cell)) {
      CHECK(std::abs(area - std::round(area)) < 1e-9);
      contacts[std::minmax(cell, other)] = static_cast<int>(std::lround(area));
    }
  return contacts;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE(
      "slow: contacts in random bodies of boxes are the squares that a count of cubes finds") {
    int bodies = 0, overlapping = 0;
    for (std::uint64_t seed = 0; seed < 120; ++seed)
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(seed);
        CAPTURE(to_string(order));
        const Building body = random_complex_body(seed);
        if (!solidify(body, {}).value) continue;
        const Segmented s = test::segmented(body, order);
        const CellComplex complex = cell_complex(s.segmentation);
        test::check_complex(s, complex);
        CHECK(contacts_of(complex, s.segmentation) == counted_contacts(s.segmentation));
        ++bodies;
        // Leaves of the same sign that overlap, so that the order of the tree decides.
        for (const CellId cell : cells_of_sign(s.segmentation, -1)) {
          const double left = test::volume_m3(s.segmentation, complex, {&cell, 1});
          overlapping += left < s.segmentation.cells[cell.index()].volume_m3 - 0.5 ? 1 : 0;
        }
      }
    CHECK(bodies > 200);
    CHECK(overlapping > 10);
  }
}

}  // namespace
}  // namespace oriel
