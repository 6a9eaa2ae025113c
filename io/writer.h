#pragma once

#include "io/document.h"
#include "model/labelled_building.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// What becomes of semantic surfaces that the chosen geometry has already.
enum class ExistingSemantics {
  /// They stay, and polygons without one get ours. A wall that is there gains the openings we found
  /// in it as `children`.
  fill,
  /// The same, but nothing that is there changes: openings in its walls have no `parent`.
  keep,
  /// Ours take their place.
  replace
};

/// What to write besides the labels.
struct WriteOptions {
  ExistingSemantics existing = ExistingSemantics::fill;
  /// Ids of CityObjects to leave out, such as installations that were generalised away. They also
  /// leave the `children` and `parents` of all other objects.
  std::vector<std::string> removed;
  /// Ids of buildings that leave with all that belongs to them, and with the building that they are
  /// a part of where no other part of it is left (it may have an outline). Of a line of a
  /// CityJSONSeq that has nothing else nothing is written.
  std::vector<std::string> gone{};
  /// Ids of buildings whose installations leave: what was there is part of a new geometry.
  std::vector<std::string> bared{};
  /// Ids of buildings whose chosen geometry leaves; they stay, with their attributes. One that was
  /// read without it (ReadOptions::keeps_emptied) stays so.
  std::vector<std::string> emptied{};
  /// Of CityGML: installations become solids (citygml_text); CityJSON has them as they are.
  bool closes_installations = false;
  /// The scale is finer than the document's by so many powers of ten at least (see WrittenGrid).
  int finer_digits = 0;
};

/// The document as CityJSON with its labels: one file, or of a CityJSONSeq one line with its line
/// end. What the labels do not concern stays byte for byte.
///
/// - Without LabelledBuilding::geometry the chosen geometry keeps its boundaries and gains
///   semantics: polygons that have a semantic surface keep it, the others get ours, appended behind
///   the surfaces that are there. Openings have `parent`, and their wall lists them in `children`.
/// - With it the geometry becomes a Solid (a MultiSolid if it has several lumps) with the facets as
///   polygons; with LabelledBuilding::keeps_semantics they keep the semantic surface that their
///   input polygons share, if they do; its material and texture go, and vertices that nothing uses
///   any more leave the file. New vertices are rounded to the transform's scale; if that is coarser
///   than 1 mm, the file gets one finer by powers of ten that is not. What is written has no say in
///   it, so that a building's numbers are the same whatever else is in the file. Vertices that
///   rounding makes one are one.
///   A line of a CityJSONSeq keeps its header's transform.
/// - With LabelledBuilding::lod that geometry gets this level of detail. Then, and with
///   LabelledBuilding::geometry and without keeps_semantics, other geometries of the object with
///   its level go. Of several labelled buildings with one id the first takes the place of the
///   chosen geometry, the others are appended.
/// - Installations become BuildingInstallation objects, children of their building; one with the
///   same id is replaced. With LabelledBuilding::geometry and without keeps_semantics, those of the
///   file that only share the polygons of the replaced geometry (`oriel_geometry`) leave, if they
///   are not written again. Attributes of the building are added; one with the same name is
///   replaced.
/// - CityGML becomes the lines of a CityJSONSeq (see CityJsonCollector for one file): its header,
///   then a line for each Building; nothing for a Building that could not be read.
/// - A document that was read from OBJ, OFF or PLY becomes a CityJSON 2.0 file: lod "3" where the
///   building has none, scale 0.001, or 1e-6 if the coordinates are no multiples of that.
///
/// Writing what was read back with the same labels gives the same bytes. Throws std::logic_error if
/// a labelled building is not one of the document.
std::string write_cityjson(const Document& document, const std::vector<LabelledBuilding>& labelled,
                           const WriteOptions& options = {});

/// What write_cityjson() writes, of buildings that come one by one and are not kept.
class CityJsonText {
 public:
  /// Both must outlive it; of the options those that say which buildings and objects leave are
  /// looked at in the end, but for `emptied`.
  CityJsonText(const Document& document, const WriteOptions& options);
  ~CityJsonText();
  CityJsonText(CityJsonText&&) noexcept;
  CityJsonText& operator=(CityJsonText&&) noexcept;

  void add(const LabelledBuilding& labelled);

  /// All were added; what is to be done then is done once.
  void finish();
  /// The text, as a whole or piece by piece.
  [[nodiscard]] std::string text();
  void write(const std::function<void(std::string_view)>& sink);

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace oriel
