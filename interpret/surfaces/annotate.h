#pragma once

#include "interpret/pack/rule_base.h"
#include "interpret/surfaces/surfaces.h"
#include "model/building.h"
#include "model/description/feature_graph.h"
#include "model/description/feature_table.h"
#include "model/description/surface_table.h"
#include "model/interpretation.h"
#include "model/labelled_building.h"
#include "model/polygon_owners.h"
#include "model/segmentation.h"

#include <span>
#include <string>
#include <vector>

namespace oriel {

struct AnnotateOptions {
  /// Which codes installations get, one of RuleBase::codelists(); a class without a code in it gets
  /// neither `function` nor `oriel_codelist`.
  std::string codelist = "sig3d";
  /// Written on the building after oriel_version, oriel_pack and oriel_pack_sha256; such as
  /// oriel_config_sha256.
  Members attributes{};
  /// Every surface and installation gets its reason in one line, oriel_why: reason() of its
  /// feature, or that of surface_reasons().
  bool has_reasons = false;
  /// The reason of each feature, if they are known already, as where somebody corrected labels;
  /// else empty.
  std::vector<std::string> feature_reasons{};
  /// What interpret_surfaces says of the rows_to_name(), if it is known already; else empty.
  std::span<const SurfaceVerdict> surfaces{};
  /// polygon_owners of the segmentation and the building, if they are known already; else null.
  const PolygonOwners* owners = nullptr;
};

/// What is to be written about a building whose features were labelled (docs/formats.md).
///
/// Every input polygon gets a semantic surface. A polygon belongs to the smallest feature that
/// lists it; features without a label pass it on to the next larger one. All polygons of a feature
/// whose class the pack emits as Window or Door make one surface, whose parent is the surface of
/// the wall or roof polygon around it (-1 if there is none). Every other polygon is a surface by
/// itself, named by interpret_surfaces.
///
/// Every feature whose class is emitted as BuildingInstallation and that has polygons becomes an
/// Installation with all its polygons but those of installations inside it.
///
/// Labels of classes that the pack does not emit are not lost: a protrusion becomes an Installation
/// without codes; any other feature is named by the surfaces of its polygons, one for each type,
/// which have the members of an opening and keep the type that they would have without it. In an
/// opening that type is the opening's, which keeps its other polygons, or all if there are none.
///
/// `segmentation`, `table`, `graph` and `interpretation` are of `building`, with the same features;
/// without features (all four empty, as for a building that stays open) its surfaces are named all
/// the same. `surfaces` has a row for every polygon. Polygons have different numbers
/// (Polygon::source) of at least 0.
LabelledBuilding annotate(const Building& building, const Segmentation& segmentation,
                          const FeatureTable& table, const FeatureGraph& graph,
                          const SurfaceTable& surfaces, const Interpretation& interpretation,
                          const RuleBase& base, const AnnotateOptions& options = {});

}  // namespace oriel
