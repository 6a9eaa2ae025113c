#pragma once

#include "io/document.h"
#include "io/files/format.h"
#include "io/unread_object.h"
#include "kernel/base/issue.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// Which geometries become buildings.
enum class ReadGeometries {
  /// Of each building one: the first solid of its level of detail, else the first surfaces.
  one,
  /// All that the level has, also of objects that are no buildings (of CityJSON; of CityGML those
  /// that belong to a building): each is a Building of its own. Of such objects the level is their
  /// own highest, if none is asked for.
  of_level,
  /// The same at all levels of detail.
  all
};

/// How to read.
struct ReadOptions {
  /// The level of detail to take, exactly as written in the input. Default: of each building with
  /// its parts the highest that occurs.
  std::optional<std::string> lod;
  /// The format. Default: what the file's name says.
  std::optional<Format> format;
  /// Of CityJSON and CityGML: a BuildingInstallation with a geometry at the level that its building
  /// is read at gives its polygons to the building (Building::installations), unless the building
  /// has them all: oriel writes such ones (`oriel_geometry`). They are labelled with the building;
  /// what is generalised, repaired or validated is the building alone.
  bool joins_installations = true;
  /// Of CityJSON: a building whose geometry is part of another one's at this level of a series
  /// (`oriel_member_of`) is read, too: without polygons. Else it is passed over, unless `lod` asks
  /// for another level that it has.
  bool keeps_emptied = false;
  /// What is read is hashed, too.
  bool wants_sha256 = false;
  ReadGeometries geometries = ReadGeometries::one;
};

/// Reads a file record by record, in bounded memory for CityJSONSeq and CityGML.
///
/// CityJSON 1.0, 1.1 and 2.0: every Building and BuildingPart with a geometry of the chosen level
/// of detail becomes a Building; of several such geometries the first solid, else the first
/// surface. CityGML 1.0, 2.0 and 3.0: every Building with its parts, by the same choice of
/// geometry. OBJ, OFF, PLY and STL: one Building, its id the file's stem; a solid if the faces are
/// one closed connected shell.
///
/// What is wrong with the data comes back as issues (docs/errors.md). A fault in one building costs
/// that building (of CityGML with its parts), a fault in a line of a CityJSONSeq that line.
class Reader {
 public:
  /// Opens `path`, or stdin for "-". Throws InputError: E101 the file cannot be opened; E106 the
  /// format is unknown (no known extension and no ReadOptions::format), or is written only.
  explicit Reader(std::string path, ReadOptions options = {});
  ~Reader();
  Reader(Reader&&) noexcept;
  Reader& operator=(Reader&&) noexcept;

  /// The next record, or nothing at the end. Without a value the record cannot be used and its
  /// issues say why. The first record of a CityJSONSeq is its header line; without a header there
  /// are no further records; headers with the same facts among the features are passed over.
  /// CityGML has a header, too, then a record for each Building, without
  /// buildings if it has a fault; a record without a value is the last: there the file is broken.
  /// Throws InputError E101 if reading fails half-way, E505 for a record of more than 4 GB.
  std::optional<Checked<Document>> next();

  [[nodiscard]] Format format() const;

  /// How many bytes of the input were read so far.
  [[nodiscard]] std::uint64_t bytes_read() const;
  /// Of a CityJSONSeq: where the last record stands, counted from 1.
  [[nodiscard]] int line() const;
  /// With ReadOptions::wants_sha256 that of the input up to the last record (of CityGML up to some
  /// place behind it), at the end of all of it; else empty.
  [[nodiscard]] std::string sha256() const;
  /// The last line of a CityJSONSeq that came without a value, as it was read.
  [[nodiscard]] const std::string& refused_line() const;
  /// With ReadOptions::geometries other than `one`: the objects with geometry that were passed over
  /// since it was last asked: those that have templates only, and of CityGML those besides the
  /// buildings up to some place behind the last record, at the end all of the file.
  std::vector<UnreadObject> take_unread();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace oriel
