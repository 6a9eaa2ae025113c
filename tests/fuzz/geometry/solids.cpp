#include "kernel/solidify/solidify.h"
#include "tests/fuzz/support/bodies.h"
#include "tests/fuzz/support/promises.h"
#include "tests/fuzz/support/retold.h"
#include "tests/fuzz/targets.h"
#include "tests/support/changed.h"

#include <algorithm>
#include <cmath>

namespace oriel::fuzz {

namespace {

RepairOptions repair_options(ByteSource& bytes) {
  RepairOptions options;
  options.close = static_cast<Closing>(bytes.below(3));
  options.crossings = static_cast<Crossings>(bytes.below(3));
  return options;
}

Solidified solid_of(const Building& building, const RepairOptions& options) {
  Solidified solid = solidify(building, {}, options);
  promise_no_fault(solid.issues);
  promise(solid.value.has_value() != has_errors(solid.issues), "a solid or an error");
  if (!solid.value) return solid;
  promise(is_closed(*solid.value), "a solid is closed");
  promise(volume_m3(*solid.value) > 0, "a solid has a volume");
  for (const Facet& facet : solid.value->facets)
    for (const Loop& loop : facet.loops)
      promise(loop.size() >= 3, "a loop has three corners or more");
  return solid;
}

/// All that shuffling must leave alone (solidify.h).
bool is_same(const Solid& p, const Solid& q) {
  const auto facet = [](const Facet& a, const Facet& b) {
    return a.plane == b.plane && a.loops == b.loops && a.polygons.size() == b.polygons.size();
  };
  const auto plane = [](const Plane& a, const Plane& b) {
    return a.coefficients == b.coefficients && a.offset == b.offset;
  };
  const auto vertex = [](const Vertex& a, const Vertex& b) { return a.point == b.point; };
  return std::ranges::equal(p.planes, q.planes, plane) &&
         std::ranges::equal(p.vertices, q.vertices, vertex) &&
         std::ranges::equal(p.facets, q.facets, facet);
}

void check_shuffled(const Building& building, const RepairOptions& options,
                    const Solidified& solid) {
  const Solidified other = solid_of(test::in_order(test::shuffled(building, 1)), options);
  promise(solid.value.has_value() == other.value.has_value(),
          "shuffling decides nothing about whether there is a solid",
          joined(error_codes(solid.issues)) + " / " + joined(error_codes(other.issues)));
  if (solid.value) promise(is_same(*solid.value, *other.value), "shuffling changes no solid");
}

/// Of bodies that are exact: told differently they have as many planes and facets, and the volume.
void check_retold(const Solid& solid, const Building& other, const char* how) {
  const Solidified again = solid_of(other, {});
  promise(again.value.has_value(), "a valid body told differently is a solid", how);
  promise(again.value->planes.size() == solid.planes.size() &&
              again.value->facets.size() == solid.facets.size(),
          "a valid body told differently has the same facets", how);
  constexpr double kRounding = 1e-6;
  promise(std::abs(volume_m3(*again.value) - volume_m3(solid)) <= kRounding * volume_m3(solid),
          "a valid body told differently has the same volume", how);
}

}  // namespace

/// solidify with all options of repair. Turning, moving and cutting into triangles must change
/// nothing on bodies that are valid and exact; shuffling must not on any.
void solids(std::string_view input) {
  ByteSource bytes(input);
  const RepairOptions options = repair_options(bytes);
  const Body body = changed_body(bytes);
  const Solidified solid = solid_of(test::in_order(body.building), options);
  check_shuffled(body.building, options, solid);
  if (!body.is_valid) return;
  promise(solid.value.has_value(), "a valid body is a solid", joined(error_codes(solid.issues)));
  check_retold(*solid.value, turned_by_right_angle(body.building), "turned");
  check_retold(*solid.value, moved_by_metres(body.building), "moved");
  check_retold(*solid.value, cut_into_triangles(body.building), "in triangles");
}

}  // namespace oriel::fuzz
