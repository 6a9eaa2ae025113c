#include "tests/interpret/first_hour/wrong_pack.h"

using namespace oriel::test;

namespace {

// clang-format off
const std::vector<WrongPack>& packs_with_wrong_names() {
  static const std::vector<WrongPack> packs = {
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
      {"another word for a key that is there", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
classes: {window: {}, door: {}}
rules:
  - {id: w, name: a window, label: window, require: sense = hole}
)pack",
       R"says(my_town.yaml:5:13: R209 unknown key 'name' in the rule 'w' (keys: id, label, priority, require, unless, score)
  - {id: w, name: a window, label: window, require: sense = hole}
            ^~~~
)says"},
      {"the end of a range alone", R"pack(schema: oriel/1
pack: {name: my_town, version: 1.0.0}
params: {sill: {value: 0.8 m, min: 0.3 m}}
classes: {window: {}, door: {}}
rules:
  - {id: w, label: window, require: base_height > $sill}
)pack",
       R"says(my_town.yaml:3:31: R209 unknown key 'min' in the param 'sill'; did you mean 'range: lo .. hi'?
params: {sill: {value: 0.8 m, min: 0.3 m}}
                              ^~~
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
       R"says(my_town.yaml:7:21: R207 'door' is a class and not a relation; write 'contains where is door', or another relation in place of contains
    require: exists(door)
                    ^~~~
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
       R"says(my_town.yaml:7:22: R205 'hole' is not a class but a word of 'sense': write 'sense = hole'
    require: self is hole
                     ^~~~
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
  };
  return packs;
}
// clang-format on

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("wrong sections and names in the first hour have answers with place and remedy") {
    CHECK(packs_with_wrong_names().size() >= 24);
    check_answers(packs_with_wrong_names());
  }
}
