#pragma once

#include "kernel/segment/cuts/carve.h"
#include "kernel/segment/cuts/lump.h"
#include "kernel/segment/sections/section.h"

#include <optional>
#include <vector>

namespace oriel::detail {

/// The cut by which a feature comes off a body.
struct FeatureCut {
  Section section;
  Lump lump;
  /// Its caps, if nothing has to be split for them (bare_caps); else it is to be imprinted. None of
  /// a lump that is not finite or not sound.
  std::optional<std::vector<CutCap>> caps = {};
};

/// The lump of material, or of air, in front of a plane whose contact with it has `point` inside;
/// `direction` as that of a Section. Nothing if there is no such contact.
std::optional<FeatureCut> find_feature_cut(const Boundary& body, int plane, int direction,
                                           bool is_material, Vec3 point,
                                           const SectionOptions& options);

}  // namespace oriel::detail
