#pragma once

#include "io/document.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace oriel {

/// Takes a whole file apart into the lines of a CityJSONSeq. A feature is what hangs together by
/// `parents` and `children`; features come in the order of the file, and so do their CityObjects.
///
/// Each line has its own vertices, numbered in the order in which they are used, and its own
/// materials and textures. The header keeps everything else, also the appearance if there are
/// geometry templates, which may use it. Vertices that nothing uses are left out.
class CityJsonSplitter {
 public:
  /// `document` was read from CityJSON, OBJ or OFF.
  explicit CityJsonSplitter(const Document& document);
  ~CityJsonSplitter();
  CityJsonSplitter(const CityJsonSplitter&) = delete;
  CityJsonSplitter& operator=(const CityJsonSplitter&) = delete;

  /// The header line, with its line end.
  [[nodiscard]] std::string header() const;
  /// The number of features.
  [[nodiscard]] std::size_t size() const;
  /// The ids of the CityObjects of feature `i`, its own id first.
  [[nodiscard]] std::vector<std::string> ids(std::size_t i) const;
  /// The type of its first CityObject.
  [[nodiscard]] std::string type(std::size_t i) const;
  /// The line of feature `i`, with its line end.
  [[nodiscard]] std::string feature(std::size_t i) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace oriel
