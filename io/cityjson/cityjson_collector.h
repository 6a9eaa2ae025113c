#pragma once

#include "model/vec3.h"
#include "model/whole_point.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace oriel {

/// Puts the lines of a CityJSONSeq together as one CityJSON file. It holds the whole file; for
/// files larger than memory write the lines themselves.
class CityJsonCollector {
 public:
  /// The header line comes first, then features. They are lines that Reader has read, or that
  /// write_cityjson gave; a building that names a vertex which is not there names none in the file
  /// either. An empty line is passed over. Returns the id of a CityObject that an
  /// earlier line had: then nothing is added.
  std::optional<std::string> add(std::string_view line);

  /// The same with a whole CityJSON file, or with the header of the lines that follow. Its
  /// transform need not be that of the first: if it is another, all vertices go on a grid of
  /// micrometres. What else it has beside CityObjects, vertices and appearance is left out (see
  /// file_facts), and so is the extent in the metadata of the first.
  std::optional<std::string> add_file(std::string_view text);

  /// The id of a CityObject of a line or file that an earlier one had: adding it would add nothing.
  [[nodiscard]] std::optional<std::string> twin_in(std::string_view text) const;

  [[nodiscard]] bool has_lines() const { return !header_.empty(); }

  /// The file: the header with the features' CityObjects and vertices, in their order; materials
  /// and textures that are the same text are one. If all vertices allow it, a scale below 0.001
  /// becomes coarser by powers of ten.
  [[nodiscard]] std::string text() const;

 private:
  /// A list of "appearance", first that of the header.
  struct Parts {
    std::vector<std::string> texts;
    std::unordered_map<std::string, std::int64_t> number_of;
    std::int64_t add(std::string_view text);
  };

  /// Where an input has its vertices.
  struct Grid {
    Vec3 scale{1, 1, 1}, translate;
    friend bool operator==(const Grid&, const Grid&) = default;
  };
  using Triple = std::array<std::int64_t, 3>;

  static Grid grid_of(std::string_view file);
  void begin(std::string_view header);
  std::optional<std::string> add_objects(std::string_view line, std::string_view appearance);
  void drop_extent();
  void go_to_micrometres();
  [[nodiscard]] Triple placed(const Triple& vertex) const;
  [[nodiscard]] std::string object_text(std::string_view object, std::size_t vertex_count,
                                        std::string_view appearance);
  [[nodiscard]] std::string appearance_text(std::string_view header) const;

  std::string header_;
  /// Members of CityObjects with commas between them.
  std::string objects_;
  std::unordered_set<std::string> ids_;
  std::vector<Triple> vertices_;
  bool is_of_several_ = false;             ///< files
  Grid grid_;                              ///< of the lines at hand
  std::optional<MicrometrePoint> origin_;  ///< of a grid of micrometres, in which it is
  Parts materials_, textures_;
  std::vector<std::string> places_;  ///< "vertices-texture"
};

}  // namespace oriel
