#pragma once

#include "studio/editing/edited_pack.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace oriel::test {

/// A text in which `|` marks a place.
struct MarkedText {
  explicit MarkedText(std::string marked) : text(std::move(marked)), offset(text.find('|')) {
    REQUIRE(offset != std::string::npos);
    text.erase(offset, 1);
  }
  [[nodiscard]] EditedPack pack(const std::string& file = "town.yaml") const {
    return {text, file};
  }

  std::string text;
  std::size_t offset;
};

inline std::vector<std::string> labels_of(const std::vector<Completion>& completions) {
  std::vector<std::string> labels;
  for (const Completion& completion : completions) labels.push_back(completion.label);
  return labels;
}

inline std::vector<std::string> completed(const std::string& marked) {
  const MarkedText at(marked);
  return labels_of(at.pack().complete(at.offset));
}

inline bool has(const std::vector<std::string>& labels, const std::string& label) {
  return std::ranges::find(labels, label) != labels.end();
}

/// A pack with a name of each kind.
inline const std::string kTown = R"(schema: oriel/1
pack: {name: town, version: 1.0.0}
params:
  sill: {value: 0.9 m, range: 0.6 m .. 1.1 m, why: as high as a table}
  wide: {value: 2 m, why: two leaves}
classes:
  opening: {abstract: true}
  window: {is: opening, typical: {per storey: 1 .. 13}}
  door: {is: opening}
macros:
  cut_in: sense in [hole, imprint]
relations:
  close: {within: same storey, where: abs(along - other.along) < 1 m}
rules:
  - id: opening.any
    label: opening
    require: [cut_in and host is wall]
  - id: window.high
    label: window
    require:
      - self is opening and base_height >= $sill
      - exists(close where is opening)
    unless: [width > $wide]
  - id: door.low
    label: door
    require: self is opening and base_height < $sill
groups:
  row: {of: window, by: close, at_least: 3}
emit:
  opening: {type: Window}
generalise:
  - {id: small.omit, scale: "1:500 .. 1:5000", for: window, when: a < 0.5 mm@map, do: omit}
)";

}  // namespace oriel::test
