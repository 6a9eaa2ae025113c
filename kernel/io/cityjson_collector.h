#pragma once

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
  /// write_cityjson gave. An empty line is passed over. Returns the id of a CityObject that an
  /// earlier line had: then nothing is added.
  std::optional<std::string> add(std::string_view line);

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

  void begin(std::string_view header);
  [[nodiscard]] std::string object_text(std::string_view object, std::int64_t first_vertex,
                                        std::string_view appearance);
  [[nodiscard]] std::string appearance_text(std::string_view header) const;

  std::string header_;
  /// Members of CityObjects with commas between them.
  std::string objects_;
  std::unordered_set<std::string> ids_;
  std::vector<std::array<std::int64_t, 3>> vertices_;
  Parts materials_, textures_;
  std::vector<std::string> places_;  ///< "vertices-texture"
};

}  // namespace oriel
