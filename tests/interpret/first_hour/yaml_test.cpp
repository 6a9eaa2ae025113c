#include "tests/interpret/first_hour/wrong_pack.h"

using namespace oriel::test;

namespace {

// clang-format off
const std::vector<WrongPack>& packs_that_break_yaml() {
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
      {"yes for true", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {opening: {abstract: yes}, window: {is: opening}}
rules: []
)pack",
       R"says(my_town.yaml:3:31: R214 bare 'yes' is a yes or no to some YAML readers and a text to others; write true, false or "yes"
classes: {opening: {abstract: yes}, window: {is: opening}}
                              ^~~
)says"},
  };
  return packs;
}
// clang-format on

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("what breaks YAML in the first hour has answers with place and remedy") {
    CHECK(packs_that_break_yaml().size() >= 22);
    check_answers(packs_that_break_yaml());
  }
}
