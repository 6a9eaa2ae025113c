#include "generalise/to_lod.h"

#include "generalise/generalise.h"
#include "kernel/base/text/counted.h"
#include "kernel/blocks/blocks.h"

#include <string>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// Blocks have tops, walls and a ground, and nothing else.
const char* type_of_block_facet(const Plane& plane) {
  if (plane.coefficients[2] > 0) return "RoofSurface";
  return plane.coefficients[2] < 0 ? "GroundSurface" : "WallSurface";
}

Redrawn drawn_blocks(const LabelledBuilding& labelled, Solid solid) {
  Redrawn out;
  out.labelled.building = labelled.building;
  out.labelled.attributes = labelled.attributes;
  for (const Installation& installation : labelled.installations)
    out.removed_ids.push_back(installation.id);
  for (const Facet& facet : solid.facets) {
    out.labelled.surface_of_polygon.push_back(static_cast<int>(out.labelled.surfaces.size()));
    out.labelled.surfaces.push_back(
        {type_of_block_facet(solid.planes[facet.plane.index()]), -1, {}});
  }
  out.labelled.geometry = std::move(solid);
  return out;
}

}  // namespace

Checked<Redrawn> to_lod(const RedrawContext& context, const Profile& profile,
                        Generalised generalised, Work& work,
                        std::function<bool(const Box& gained)> may_cover,
                        std::function<bool(Vec3 from, Vec3 to)> is_shared) {
  Checked<Redrawn> out;
  if (profile.form == Profile::Form::as_is) {
    generalised.is_drawn_anew = true;
    out.value = redraw(context, std::move(generalised));
  } else {
    BlockOptions options;
    options.is_by_roof = profile.form == Profile::Form::blocks;
    options.least_piece_m2 = profile.least_piece_m2;
    options.least_edge_m = profile.footprint_edge_m;
    options.may_cover = std::move(may_cover);
    options.is_shared = std::move(is_shared);
    auto made =
        blocks(generalised.solid, context.building.id, options, context.options.tolerances, work);
    out.issues = std::move(made.issues);
    if (!made.value) return out;
    const auto note = [&](std::string sentence) {
      out.issues.push_back(
          building_issue(Severity::note, Code::G407, context.building.id, std::move(sentence)));
    };
    if (made.value->is_simplified)
      note("parts of its roof meet in a vertical edge: it became one block");
    if (made.value->is_from_above)
      note("its ground is less than half of what is seen from above, which became the footprint");
    if (made.value->keeps_footprint)
      note("a simpler footprint would make no closed solid: it keeps all its edges");
    if (made.value->short_edges > 0)
      note(
          fmt::format("{} of its footprint below {} m cannot go: too much ground would be covered "
                      "or left, or a neighbour may stand there",
                      counted(made.value->short_edges, "edge"), profile.footprint_edge_m));
    out.value = drawn_blocks(context.labelled, std::move(made.value->solid));
    count_removed(generalised.removed, context.segmentation, context.interpretation, *out.value);
  }
  out.value->labelled.lod = profile.level;
  return out;
}

}  // namespace oriel
