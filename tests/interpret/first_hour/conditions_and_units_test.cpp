#include "tests/interpret/first_hour/wrong_pack.h"

using namespace oriel::test;

namespace {

// clang-format off
const std::vector<WrongPack>& packs_with_wrong_conditions() {
  static const std::vector<WrongPack> packs = {
      {"quotes round a word", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: sense = "hole"
)pack",
       R"says(my_town.yaml:7:22: R220 quotes have no meaning in an expression; words are written without them: write 'sense = hole'
    require: sense = "hole"
                     ^
)says"},
      {"a decimal comma", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: depth > 0,1 m
)pack",
       R"says(my_town.yaml:7:23: R220 expected an operator or the end, found ','; decimals are written with a point: 0.1
    require: depth > 0,1 m
                      ^
)says"},
      {"conditions below each other without dashes", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require:
      sense = hole
      depth > 0.1 m
)pack",
       R"says(my_town.yaml:8:7: R221 this continues on the next line: an expression is written on one line, and several conditions are a list, each on a line after '- '
      sense = hole
      ^
)says"},
      {"a number without a unit", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: depth > 0.1
)pack",
       R"says(my_town.yaml:7:22: R231 'depth' is a length: write 0.1 m
    require: depth > 0.1
                     ^~~
)says"},
      {"a param without a unit", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
params: {sill: {value: 0.8, range: 0.3 m .. 1.2 m}}
rules:
  - {id: w, label: window, require: base_height > $sill}
)pack",
       R"says(my_town.yaml:4:24: R231 the range of 'sill' is a length and its value has no unit: write 0.8 m
params: {sill: {value: 0.8, range: 0.3 m .. 1.2 m}}
                       ^~~
)says"},
      {"a param without a unit or range", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
params: {sill: {value: 0.8}}
rules:
  - {id: w, label: window, require: base_height > $sill and top > $sill}
)pack",
       R"says(my_town.yaml:4:24: R231 '$sill' is compared with 'base_height', a length, and has no unit: write 0.8 m
params: {sill: {value: 0.8}}
                       ^~~
)says"},
      {"a range without units", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
params: {sill: {value: 0.8 m, range: 0.3 .. 1.2}}
rules:
  - {id: w, label: window, require: base_height > $sill}
)pack",
       R"says(my_town.yaml:4:38: R231 a length is needed here: write 0.3 m .. 1.2 m
params: {sill: {value: 0.8 m, range: 0.3 .. 1.2}}
                                     ^~~~~~~~~~
)says"},
      {"a unit of another system", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: depth > 0.1 metres
)pack",
       R"says(my_town.yaml:7:26: R233 there is no unit 'metres'; oriel calls it 'm'
    require: depth > 0.1 metres
                         ^~~~~~
)says"},
      {"a range as a list", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: width in [0.4 m, 2 m]
)pack",
       R"says(my_town.yaml:7:14: R232 'width' is a length, which is never exactly one of a list; a range is written 'width in 0.4 m .. 2 m'
    require: width in [0.4 m, 2 m]
             ^~~~~~~~~~~~~~~~~~~~~
)says"},
      {"a range with a dash", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
params: {sill: {value: 0.8 m, range: 0.3 m - 1.2 m}}
rules:
  - {id: w, label: window, require: base_height > $sill}
)pack",
       R"says(my_town.yaml:4:44: R220 '-' subtracts; a range is written with two points: 0.3 m .. 2.2 m
params: {sill: {value: 0.8 m, range: 0.3 m - 1.2 m}}
                                           ^
)says"},
      {"a range as in SQL", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: width between 0.4 m and 2 m
)pack",
       R"says(my_town.yaml:7:20: R220 expected an operator or the end, found 'between'; a range is written 'in lo .. hi', as in 'a in 1 m .. 2 m'
    require: width between 0.4 m and 2 m
                   ^~~~~~~
)says"},
      {"a range as in mathematics", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: 0.4 m < width < 2 m
)pack",
       R"says(my_town.yaml:7:28: R220 comparisons are not chained; write 'x in lo .. hi' or use 'and'
    require: 0.4 m < width < 2 m
                           ^
)says"},
      {"half a comparison", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: width > 0.4 m and < 2 m
)pack",
       R"says(my_town.yaml:7:32: R220 expected a value or a condition, found '<'; write the attribute again, as in 'a > 1 m and a < 2 m', or 'a in 1 m .. 2 m'
    require: width > 0.4 m and < 2 m
                               ^
)says"},
      {"two equals signs", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: sense == hole
)pack",
       R"says(my_town.yaml:7:20: R220 '==': write '='
    require: sense == hole
                   ^~
)says"},
      {"a colon in place of an equals sign", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require:
      - sense: hole
)pack",
       R"says(my_town.yaml:8:9: R211 'require' is an expression, but here is a map; write 'sense = hole'
      - sense: hole
        ^
)says"},
      {"AND in capitals", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: sense = hole AND depth > 0.1 m
)pack",
       R"says(my_town.yaml:7:27: R220 expected an operator or the end, found 'AND'; write 'and'
    require: sense = hole AND depth > 0.1 m
                          ^~~
)says"},
      {"a word that a text never is", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: sense = opening
)pack",
       R"says(my_town.yaml:7:22: R234 'sense' is never 'opening' (it is one of protrusion, hole, cavity, imprint)
    require: sense = opening
                     ^~~~~~~
)says"},
      {"a scale without quotes", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules: []
generalise: [{id: small, scale: 1:5000, for: window, do: omit}]
)pack",
       R"says(my_town.yaml:5:33: R250 a scale is a range: write "1:5000 .." for this scale and all that are smaller
generalise: [{id: small, scale: 1:5000, for: window, do: omit}]
                                ^~~~~~
)says"},
      {"a subclass that does not ask for its class", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {opening: {abstract: true}, window: {is: opening}}
rules:
  - {id: o, label: opening, require: sense = hole}
  - {id: w, label: window, require: width < 2 m}
)pack",
       R"says(my_town.yaml:6:5: R245 'window' is a kind of 'opening', which has rules of its own: require 'self is opening'
  - {id: w, label: window, require: width < 2 m}
    ^
)says"},
  };
  return packs;
}
// clang-format on

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("wrong conditions and units in the first hour have answers with place and remedy") {
    CHECK(packs_with_wrong_conditions().size() >= 19);
    check_answers(packs_with_wrong_conditions());
  }
}
