#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// Puts the lines of a CityJSONSeq, as write_cityjson gives them, together as one CityJSON file. It
/// holds the whole file; for files larger than memory write the lines themselves.
class CityJsonCollector {
 public:
  /// The header line comes first, then features whose ids differ. An empty line is passed over.
  void add(std::string_view line);

  [[nodiscard]] bool has_lines() const { return !header_.empty(); }

  /// The file: the header with the features' CityObjects and vertices, in their order. If all
  /// vertices allow it, the scale becomes coarser by powers of ten, up to 0.001.
  [[nodiscard]] std::string text() const;

 private:
  std::string header_;
  /// Members of CityObjects with commas between them.
  std::string objects_;
  std::vector<std::array<std::int64_t, 3>> vertices_;
};

}  // namespace oriel
