#include "tests/interpret/support.h"

#include <string_view>
#include <vector>

using namespace oriel;
using namespace oriel::test;

namespace {

/// What the author of a pack may do wrong in the first hour.
struct WrongPack {
  std::string_view fault;
  std::string_view text;
  /// All that is said of it, to the letter: the place, the cause and the remedy.
  std::string_view message;
};

// clang-format off
const std::vector<WrongPack>& wrong_packs() {
  static const std::vector<WrongPack> packs = {
      {"a tab before a key", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
	label: window
    require: sense = hole
)pack",
       R"says(my_town.yaml:6:1: R201 there is a tab before this line; YAML is indented by spaces; write '    label: window'
	label: window
^
)says"},
      {"a tab before a list item", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
	- id: w
	  label: window
)pack",
       R"says(my_town.yaml:5:1: R201 there is a tab before this line; YAML is indented by spaces; write '  - id: w'
	- id: w
^
)says"},
      {"a key that is indented less than the one above it", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
   require: sense = hole
)pack",
       R"says(my_town.yaml:7:4: R201 'require' is indented by 3 spaces, 'label' above it by 4; write '    require: sense = hole'
   require: sense = hole
   ^~~~~~~
)says"},
      {"a key that is indented more than the one above it", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
      require: sense = hole
)pack",
       R"says(my_town.yaml:7:7: R201 'require' is indented by 6 spaces, 'label' above it by 4; write '    require: sense = hole'
      require: sense = hole
      ^~~~~~~
)says"},
      {"a key in the column of the dash", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
  label: window
  require: sense = hole
)pack",
       R"says(my_town.yaml:6:3: R201 'label' is indented by 2 spaces, 'id' above it by 4; write '    label: window'
  label: window
  ^~~~~
)says"},
      {"a list item in another column", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require:
      - sense = hole
     - depth > 0.1 m
)pack",
       R"says(my_town.yaml:9:6: R201 this list item is indented by 5 spaces, the item above it by 6; write '      - depth > 0.1 m'
     - depth > 0.1 m
     ^
)says"},
      {"entries that are not indented", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
params:
sill: {value: 0.8 m}
rules: []
)pack",
       R"says(my_town.yaml:4:1: R209 unknown key 'sill' in a pack; if it belongs to 'params' above it, indent it: write '  sill:'
sill: {value: 0.8 m}
^~~~
)says"},
      {"a condition that is not indented", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require:
    sense = hole
)pack",
       R"says(my_town.yaml:8:5: R209 'sense = hole' is what 'require' asks for, and begins in the same column; write '      sense = hole'
    sense = hole
    ^~~~~~~~~~~~
)says"},
      {"a quote that is not closed", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: "sense = hole
    unless: "depth > 1 m"
)pack",
       R"says(my_town.yaml:7:14: R201 the quote that opens here is not closed on its line; write '    require: "sense = hole"'
    require: "sense = hole
             ^
)says"},
      {"quotes round a part of a condition", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: "sense" = hole
)pack",
       R"says(my_town.yaml:7:22: R201 the quotes end here, but the line goes on; quotes go round all of it or none; write '    require: sense = hole'
    require: "sense" = hole
                     ^~~~~~
)says"},
      {"quotes round a word", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: sense = "hole"
)pack",
       R"says(my_town.yaml:7:22: R220 quotes have no meaning in an expression; words stand without them: write 'sense = hole'
    require: sense = "hole"
                     ^
)says"},
      {"a colon without a space", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label:window
    require: sense = hole
)pack",
       R"says(my_town.yaml:6:10: R201 a space is missing after 'label:'; write '    label: window'
    label:window
         ^
)says"},
      {"a colon that is missing", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label window
    require: sense = hole
)pack",
       R"says(my_town.yaml:6:5: R201 a colon is missing after 'label'; write '    label: window'
    label window
    ^~~~~
)says"},
      {"a colon that is missing after a section", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules
  - id: w
    label: window
    require: sense = hole
)pack",
       R"says(my_town.yaml:4:1: R201 a colon is missing after 'rules'; write 'rules:'
rules
^~~~~
)says"},
      {"a colon that is missing before a brace", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
params:
  sill {value: 0.8 m}
rules: []
)pack",
       R"says(my_town.yaml:5:3: R201 a colon is missing after 'sill'; write '  sill: {value: 0.8 m}'
  sill {value: 0.8 m}
  ^~~~
)says"},
      {"a colon that is missing in braces", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
params:
  sill: {value 0.8 m}
rules: []
)pack",
       R"says(my_town.yaml:5:10: R209 a colon is missing after 'value'; write 'value: 0.8 m'
  sill: {value 0.8 m}
         ^~~~~~~~~~~
)says"},
      {"a colon in a text", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
params:
  sill:
    value: 0.8 m
    why: guidelines: at least 0.8 m
rules: []
)pack",
       R"says(my_town.yaml:7:20: R201 a second colon on one line; a text with a colon needs quotes; write '    why: "guidelines: at least 0.8 m"'
    why: guidelines: at least 0.8 m
                   ^
)says"},
      {"a brace that is not closed", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
params: {sill: {value: 0.8 m}
rules: []
)pack",
       R"says(my_town.yaml:4:9: R201 the '{' that opens here is never closed; write 'params: {sill: {value: 0.8 m}}'
params: {sill: {value: 0.8 m}
        ^
)says"},
      {"a bracket that another one closes", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: [sense = hole, depth > 0.1 m}
)pack",
       R"says(my_town.yaml:7:42: R201 '}' is here, but the '[' before it is still open; write '    require: [sense = hole, depth > 0.1 m]}'
    require: [sense = hole, depth > 0.1 m}
                                         ^
)says"},
      {"a comma that is missing", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - {id: w label: window, require: sense = hole}
)pack",
       R"says(my_town.yaml:5:12: R201 a comma is missing before 'label'; write '  - {id: w, label: window, require: sense = hole}'
  - {id: w label: window, require: sense = hole}
           ^~~~~
)says"},
      {"a comma at the end of a line", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w,
    label: window
    require: sense = hole
)pack",
       R"says(my_town.yaml:5:9: R214 a comma ends no line outside { } and [ ]; write 'id: w'
  - id: w,
        ^~
)says"},
      {"a comma in a text in braces", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - {id: w, label: window, require: min(a, b) > 1 m}
)pack",
       R"says(my_town.yaml:5:44: R209 inside { } a comma ends a text; a text with a comma needs quotes: write 'require: "min(a, b) > 1 m"'
  - {id: w, label: window, require: min(a, b) > 1 m}
                                           ^~~~~~~~
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
      {"a dash without a space", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require:
      -sense = hole
      -depth > 0.1 m
)pack",
       R"says(my_town.yaml:8:7: R221 a space is missing after '-', which begins a list item; write '- sense = hole'
      -sense = hole
      ^
)says"},
      {"words in brackets inside a list", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: [sense in [hole, cavity], depth > 0.1 m]
)pack",
       R"says(my_town.yaml:7:24: R201 '[' in a text without quotes; in [ ] a text with brackets or commas needs quotes; write '    require: ["sense in [hole, cavity]", depth > 0.1 m]'
    require: [sense in [hole, cavity], depth > 0.1 m]
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
       R"says(my_town.yaml:8:7: R221 this goes on on the next line: an expression stands on one line, and several conditions are a list, each on a line after '- '
      sense = hole
      ^
)says"},
      {"a list where a map should be", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: [window, door]
rules:
  - {id: w, label: window, require: sense = hole}
)pack",
       R"says(my_town.yaml:3:10: R211 'classes' is a map, but here is a list; write 'classes: {window: {}, door: {}}'
classes: [window, door]
         ^
)says"},
      {"a map where a list should be", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  w:
    label: window
    require: sense = hole
)pack",
       R"says(my_town.yaml:5:3: R211 'rules' is a list, but here is a map; an entry of it begins with '- ': write '- id: w'
  w:
  ^
)says"},
      {"a value where a map should be", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
params:
  sill: 0.8 m
rules:
  - {id: w, label: window, require: base_height > $sill}
)pack",
       R"says(my_town.yaml:5:9: R211 the param 'sill' is a map, but here is the text '0.8 m'; write 'sill: {value: 0.8 m}'
  sill: 0.8 m
        ^~~~~
)says"},
      {"two labels", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - {id: w, label: [window, door], require: sense = hole}
)pack",
       R"says(my_town.yaml:5:20: R211 a label is a text, but here is a list; write one value, as in 'label: window'
  - {id: w, label: [window, door], require: sense = hole}
                   ^
)says"},
      {"class in place of label", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - {id: w, class: window, require: sense = hole}
)pack",
       R"says(my_town.yaml:5:13: R209 unknown key 'class' in the rule 'w'; did you mean 'label'?
  - {id: w, class: window, require: sense = hole}
            ^~~~~
)says"},
      {"a rule without conditions", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - {id: w, label: window}
)pack",
       R"says(my_town.yaml:5:5: R210 the rule 'w' needs the key 'require'
  - {id: w, label: window}
    ^
)says"},
      {"a section that is misspelt", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
clases: {window: {}}
rules:
  - {id: w, label: window, require: sense = hole}
)pack",
       R"says(my_town.yaml:3:1: R209 unknown key 'clases' in a pack; did you mean 'classes'?
clases: {window: {}}
^~~~~~
)says"},
      {"a class that is not declared", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - {id: c, label: chimney, require: sense = protrusion}
)pack",
       R"says(my_town.yaml:5:20: R205 unknown class 'chimney'; the classes are: window, door; a new one is a line 'chimney: {}' under 'classes'
  - {id: c, label: chimney, require: sense = protrusion}
                   ^~~~~~~
)says"},
      {"a class that is misspelt", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: exists(above where is windw)
)pack",
       R"says(my_town.yaml:7:36: R205 unknown class 'windw'; did you mean 'window'?
    require: exists(above where is windw)
                                   ^~~~~
)says"},
      {"an attribute that is misspelt", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: heigth > 1 m
)pack",
       R"says(my_town.yaml:7:14: R204 unknown attribute 'heigth'; did you mean 'height'?
    require: heigth > 1 m
             ^~~~~~
)says"},
      {"an attribute of another system", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: slope > 80 deg
)pack",
       R"says(my_town.yaml:7:14: R204 there is no attribute 'slope'; oriel calls it 'inclination' (0 deg is level, 90 deg a wall)
    require: slope > 80 deg
             ^~~~~
)says"},
      {"the name of a column in a file", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: base_height_m > 0.8 m
)pack",
       R"says(my_town.yaml:7:14: R204 unknown attribute 'base_height_m'; did you mean 'base_height'?
    require: base_height_m > 0.8 m
             ^~~~~~~~~~~~~
)says"},
      {"a param without its sign", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
params: {sill: {value: 0.8 m}}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: base_height > sill
)pack",
       R"says(my_town.yaml:8:28: R204 'sill' is a param; write '$sill'
    require: base_height > sill
                           ^~~~
)says"},
      {"a param that there is not", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: base_height > $sill
)pack",
       R"says(my_town.yaml:7:28: R206 unknown param 'sill'; the pack has none: write 'params: {sill: {value: ...}}'
    require: base_height > $sill
                           ^~~~~
)says"},
      {"a relation of another system", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: exists(adjacent where is door)
)pack",
       R"says(my_town.yaml:7:21: R207 there is no relation 'adjacent'; oriel calls it 'beside'
    require: exists(adjacent where is door)
                    ^~~~~~~~
)says"},
      {"a class where a relation should be", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: exists(door)
)pack",
       R"says(my_town.yaml:7:21: R207 'door' is a class and no relation; write 'contains where is door', or another relation in place of contains
    require: exists(door)
                    ^~~~
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
      {"a label asked for like an attribute", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: label = door
)pack",
       R"says(my_town.yaml:7:14: R204 there is no attribute 'label'; the label is asked for by 'self is CLASS'
    require: label = door
             ^~~~~
)says"},
      {"a word as a class", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - id: w
    label: window
    require: self is hole
)pack",
       R"says(my_town.yaml:7:22: R205 'hole' is no class but a word of 'sense': write 'sense = hole'
    require: self is hole
                     ^~~~
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
      {"an operator of another system", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules: []
generalise: [{id: small, scale: "1:5000 ..", for: window, do: delete}]
)pack",
       R"says(my_town.yaml:5:63: R251 there is no operator 'delete'; oriel calls it 'omit'
generalise: [{id: small, scale: "1:5000 ..", for: window, do: delete}]
                                                              ^~~~~~
)says"},
      {"a pack that is misspelt after extends", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
extends: residental
rules: []
)pack",
       R"says(my_town.yaml:3:10: R200 there is no pack 'residental' here: neither built in nor a file in the folder of this pack; did you mean 'residential'?
extends: residental
         ^~~~~~~~~~
)says"},
      {"yes for true", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {opening: {abstract: yes}, window: {is: opening}}
rules: []
)pack",
       R"says(my_town.yaml:3:31: R214 bare 'yes' is a yes or no to some YAML readers and a text to others; write true, false or "yes"
classes: {opening: {abstract: yes}, window: {is: opening}}
                              ^~~
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
  TEST_CASE("what goes wrong in the first hour is answered with its place cause and remedy") {
    for (const WrongPack& pack : wrong_packs()) {
      CAPTURE(pack.fault);
      const auto checked = load_pack(std::string(pack.text), "my_town.yaml");
      CHECK_FALSE(checked.value);
      std::string said;
      for (const Issue& issue : checked.issues) said += to_string(issue) + "\n";
      CHECK(said == pack.message);
    }
    CHECK(wrong_packs().size() >= 40);
  }

  TEST_CASE("one fault gets one message") {
    for (const WrongPack& pack : wrong_packs()) {
      CAPTURE(pack.fault);
      CHECK(load_pack(std::string(pack.text), "my_town.yaml").issues.size() == 1);
    }
  }
}
