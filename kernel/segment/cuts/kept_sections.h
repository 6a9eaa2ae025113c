#pragma once

#include "kernel/geometry/boxes.h"
#include "kernel/segment/cuts/carve.h"
#include "kernel/segment/cuts/lump.h"
#include "kernel/segment/sections/section.h"

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace oriel::detail {

/// The cut by which a feature comes off a body.
struct FoundCut {
  const Section* section = nullptr;  ///< until the next call
  Lump lump;
  /// Its caps, if nothing has to be split for them (bare_caps); else it is to be imprinted.
  std::optional<std::vector<CutCap>> caps = {};
};

/// Finds cuts of one body by its sections, which are kept until the body changes.
class KeptSections {
 public:
  explicit KeptSections(const SectionOptions& options) : options_(options) {}

  /// The lump of material, or of air, whose contact with the plane has `point` inside; `direction`
  /// as that of a Section. Nothing if there is no such contact; a lump that is not finite or not
  /// sound has no caps.
  std::optional<FoundCut> find(const Boundary& body, int plane, int direction, bool is_material,
                               Vec3 point);

  /// The body has changed.
  void forget() { sections_.clear(); }

 private:
  struct KeptSection {
    Section section;
    std::vector<Box> boxes;  ///< by region
  };
  void make(const Boundary& body, KeptSection& kept) const;
  [[nodiscard]] std::optional<FoundCut> cut_in(const Boundary& body, const KeptSection& kept,
                                               bool is_material, Vec3 point) const;
  [[nodiscard]] std::optional<int> region_around(const Boundary& body, const KeptSection& kept,
                                                 bool is_material, Vec3 point) const;

  SectionOptions options_;
  std::map<std::pair<int, int>, KeptSection> sections_;  ///< by plane and direction
};

}  // namespace oriel::detail
