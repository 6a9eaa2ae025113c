#include "tests/interpret/support.h"

#include <filesystem>
#include <fstream>

using namespace oriel;
using namespace oriel::test;

namespace {

/// The page about the pack in `text`.
std::string page_about(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / "oriel_pack_page_test.yaml";
  std::ofstream(path) << text;
  const auto page = describe_pack_file(path.string());
  std::filesystem::remove(path);
  for (const Issue& issue : page.issues)
    if (issue.severity == Severity::error) FAIL_CHECK(to_string(issue));
  REQUIRE(page.value);
  return *page.value;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("a page says all that a pack says in words") {
    CHECK(page_about(R"(schema: oriel/1
pack: {name: town, version: 1.2.3}
params:
  sill: {value: 0.8 m, range: 0.3 m .. 1.2 m, why: "rooms | not cellars"}
  few: {value: 0.5}
classes:
  opening: {abstract: true}
  window: {is: opening, typical: {per storey: 1 .. 9, per building: 1 ..}}
  door: {}
macros:
  tall: height > 2 m * $few
relations:
  row: {within: same storey, where: top ~ other.top by 5 %}
rules:
  - {id: opening.any, label: opening, require: sense = hole}
  - id: window.high
    label: window
    require: [self is opening, not tall]
    unless: exists(row where is door)
    priority: 3
    score:
      - base_height: {rise: 0.1 m .. $sill, fall: 3 m .. 9 m, weight: 2}
      - natural
  - {id: door.any, label: door, require: host is wall}
decide: {min_score: 0.3, ambiguous_below: 0.1, evidence: 0.1 * $few, company: [alike, row]}
iterate: {rounds: 2}
groups:
  line: {of: window, by: row, at_least: 3}
emit:
  window: {type: BuildingInstallation, class: "1", function: {sig3d: "1000"}, top: OuterFloorSurface}
surfaces:
  - {id: roof.any, type: RoofSurface, when: inclination < 75 deg}
generalise:
  - {id: small, scale: "1:500 ..", for: any, when: a < 0.5 mm@map, do: omit}
  - {id: lines, scale: "1:1000 .. 1:2000", for: group line, do: {typify: {ratio: $few, gap: 10 cm}}}
invariants: {footprint-pct: 5, party-walls-pct: 10, top-m: 0.5}
)") == R"(# town 1.2.3

A rule pack with 3 rules for 2 labels.

## Classes

A feature gets at most one label. It may be of several shapes; no label comes of a shape by itself.

| class | | a kind of | usual numbers | written as |
|---|---|---|---|---|
| `opening` | shape |  |  |  |
| `window` | label | `opening` | 1 to 9 per storey, 1 or more per building | `BuildingInstallation` (class 1, sig3d 1000, top `OuterFloorSurface`) |
| `door` | label |  |  | `Door` |

## Params

| param | value | unit | range | reason |
|---|---|---|---|---|
| `sill` | 0.8 m | m | 0.3 m .. 1.2 m | rooms \| not cellars |
| `few` | 0.5 | none |  |  |

## Macros

Names that stand for a condition or a value in what follows.

- **tall**: `height` is more than 2 m × `$few` (0.5)

## Relations

- **row**: pairs of `same storey` for which `top` and the other's `top` differ by at most 5 %

## Rules

### opening.any

A feature is an **opening** if this holds:

- `sense` is hole

### window.high

A feature is a **window** if all of this holds:

- it is an `opening`
- `tall` does not hold

unless one of these holds:

- there is a feature related by `row` for which it is a `door`

Priority 3: the highest that holds decides.

Its score is the mean of

- `base_height`: 0 up to 0.1 m, 1 from `$sill` (0.8 m); 1 up to 3 m, 0 from 9 m (weight 2)
- 1 if `natural` holds, else 0

### door.any

A feature is a **door** if this holds:

- it lies in a wall

## Decisions

- A label needs a score of at least 0.3; what gets none is unknown.
- A lead of less than 0.1 over another label is reported.
- The labels of others (`alike`, `row`) and usual numbers move a close score by at most 0.1 × `$few` (0.5).
- The pack is run up to 2 times; scores read the labels of the time before.

## Groups

- **line**: at least 3 features of class `window` that hang together by `row`

## Surfaces

The first that holds decides what a polygon is.

- **roof.any**: `RoofSurface` if `inclination` is less than 75 deg

## Generalisation

For each feature the first entry that fits decides.

- **small** (1:500 and smaller): any feature if `a` is less than 0.5 mm on the map: `omit`
- **lines** (1:1000 to 1:2000): each `line`: `typify` ratio `$few` (0.5), gap 10 cm

`omit` removes the feature and closes its host again.  
`typify` replaces the recesses of a row with fewer ones.  

## Facets

A facet is by its inclination (0 deg looks up, 90 deg is a wall, 180 deg looks down):

- a wall from 75 deg to 105 deg
- a roof from 0 deg to 75 deg
- ground from 105 deg to 180 deg

What looks down is ground up to 0.5 m over the lowest point of the building.

## Invariants

No operation changes more than this.

- Footprint: 5 %
- Party walls: 10 %
- Top: 0.5 m
)");
  }

  TEST_CASE("every pack that is built in has a page with each of its rules") {
    for (const std::string& name : embedded_packs()) {
      CAPTURE(name);
      const auto page = describe_pack_file(name);
      REQUIRE(page.value);
      CHECK(page.value->starts_with("# "));
      const auto base = load_pack_file(name);
      std::size_t rules = 0;
      for (std::size_t at = page.value->find("\nA feature is a"); at != std::string::npos;
           at = page.value->find("\nA feature is a", at + 1))
        ++rules;
      CHECK(rules == base.value->rule_count());
      CHECK(page.value->find("an `window") == std::string::npos);
      CHECK(page.value->find("a `opening") == std::string::npos);
    }
  }

  TEST_CASE("a pack with errors has no page") {
    const auto page = describe_pack_file("no-such-pack.yaml");
    CHECK_FALSE(page.value);
    CHECK(page.issues.size() == 1);
  }
}
