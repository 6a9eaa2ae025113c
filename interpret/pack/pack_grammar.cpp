#include "interpret/pack/pack_grammar.h"

#include "interpret/plan/operators.h"

#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::rules {

namespace {

/// Where the operators stand in the schema.
constexpr std::string_view kOperators = "%OPERATORS%";
/// All but these.
constexpr const char* kPackSchema = R"json({
  "$schema": "http://json-schema.org/draft-07/schema#",
  "$id": "urn:oriel:schema:oriel-1",
  "title": "oriel/1 rule pack",
  "type": "object",
  "required": ["schema", "pack"],
  "anyOf": [{"required": ["rules"]}, {"required": ["extends"]}],
  "additionalProperties": false,
  "defaultSnippets": [
    {
      "label": "pack",
      "description": "a new pack on top of residential",
      "body": {
        "schema": "oriel/1",
        "pack": {"name": "${1:my_pack}", "version": "1.0.0"},
        "extends": "residential",
        "classes": {"${2:my_class}": {}},
        "rules": [
          {
            "id": "${2:my_class}.${3:on_roof}",
            "label": "${2:my_class}",
            "require": ["${4:sense = protrusion and host is roof}"]
          }
        ],
        "emit": {"${2:my_class}": {"type": "BuildingInstallation"}}
      }
    }
  ],
  "properties": {
    "schema": {"const": "oriel/1", "description": "the version of the language"},
    "pack": {"$ref": "#/definitions/header", "description": "the name and the version of the pack"},
    "extends": {"type": "string", "description": "a pack that is built in, or a file in the same folder"},
    "params": {
      "$ref": "#/definitions/params",
      "description": "numbers with a name, a unit, a range and a reason; expressions write them as $name"
    },
    "hosts": {
      "$ref": "#/definitions/hosts",
      "description": "which facets count as wall, roof and ground, by their inclination"
    },
    "classes": {"$ref": "#/definitions/classes", "description": "what features can be called"},
    "relations": {
      "type": ["object", "null"],
      "additionalProperties": {"$ref": "#/definitions/relation"},
      "description": "pairs of features that rules may ask about, narrowed from built-in ones"
    },
    "macros": {
      "type": ["object", "null"],
      "additionalProperties": {"$ref": "#/definitions/expression"},
      "description": "expressions with a name, which other expressions may use"
    },
    "rules": {
      "type": ["array", "null"],
      "items": {"anyOf": [{"$ref": "#/definitions/rule"}, {"$ref": "#/definitions/removal"}]},
      "description": "when a feature belongs to a class, and how well it fits"
    },
    "decide": {"$ref": "#/definitions/decide", "description": "how scores become labels"},
    "iterate": {
      "$ref": "#/definitions/iterate",
      "description": "run the rules several times, so that scores may ask for labels of the previous round"
    },
    "groups": {
      "type": ["object", "null"],
      "additionalProperties": {"$ref": "#/definitions/group"},
      "description": "features of a class that belong together, such as rows of windows"
    },
    "emit": {
      "type": ["object", "null"],
      "additionalProperties": {"$ref": "#/definitions/emission"},
      "description": "how the features of a class are written to files of buildings"
    },
    "surfaces": {
      "type": ["array", "null"],
      "items": {"anyOf": [{"$ref": "#/definitions/surface"}, {"$ref": "#/definitions/removal"}]},
      "description": "the semantic surface of polygons that belong to no opening; the first entry that holds decides"
    },
    "generalise": {
      "type": ["array", "null"],
      "items": {"anyOf": [{"$ref": "#/definitions/entry"}, {"$ref": "#/definitions/removal"}]},
      "description": "what is done to features at a map scale; the first entry that fits decides"
    },
    "invariants": {"$ref": "#/definitions/invariants", "description": "limits of change that no operation may exceed"}
  },
  "definitions": {
    "expression": {"type": ["string", "number"], "description": "an expression of the rule language"},
    "range": {"type": "string", "pattern": "\\.\\.", "description": "lo .. hi"},
    "conditions": {"anyOf": [{"type": "string"}, {"type": "array", "minItems": 1, "items": {"type": "string"}}]},
    "id": {"type": "string", "description": "names joined by points"},
    "header": {
      "type": "object",
      "required": ["name", "version"],
      "additionalProperties": false,
      "properties": {
        "name": {"type": "string", "description": "what the pack is called"},
        "version": {"type": "string", "pattern": "^[0-9]+\\.[0-9]+\\.[0-9]+$", "description": "three numbers, such as 1.0.0"}
      }
    },
    "params": {"type": ["object", "null"], "additionalProperties": {"$ref": "#/definitions/param"}},
    "param": {
      "type": "object",
      "additionalProperties": false,
      "properties": {
        "value": {"$ref": "#/definitions/expression", "description": "a number with its unit, such as 0.6 m"},
        "range": {
          "$ref": "#/definitions/range",
          "description": "the range that must contain the value: lo .. hi"
        },
        "why": {"type": ["string", "number"], "description": "the reason or the source"}
      },
      "defaultSnippets": [
        {
          "label": "param",
          "description": "a number with its range",
          "body": {"value": "${1:0.6 m}", "range": "${2:0.3 m .. 1 m}", "why": "${3:reason}"}
        }
      ]
    },
    "hosts": {
      "type": "object",
      "additionalProperties": false,
      "properties": {
        "wall": {
          "$ref": "#/definitions/range",
          "description": "inclinations of walls: lo .. hi in degrees, 0 deg looks up, 90 deg is upright"
        },
        "roof": {"$ref": "#/definitions/range", "description": "inclinations of roofs: lo .. hi in degrees"},
        "ground": {
          "$ref": "#/definitions/range",
          "description": "inclinations of ground and ceilings: lo .. hi in degrees, 180 deg looks down"
        },
        "ground_reach": {
          "$ref": "#/definitions/expression",
          "description": "a face that looks down is ground if it is at most this far above the lowest point"
        }
      }
    },
    "classes": {
      "type": ["object", "null"],
      "additionalProperties": {"anyOf": [{"type": "null"}, {"$ref": "#/definitions/class"}]}
    },
    "class": {
      "type": "object",
      "additionalProperties": false,
      "properties": {
        "is": {"type": "string", "description": "its superclass"},
        "abstract": {
          "type": "boolean",
          "description": "true: a predicate, of which a feature may have several; false: a label, of which it has one"
        },
        "typical": {"$ref": "#/definitions/typical", "description": "how many of the class there usually are"}
      },
      "defaultSnippets": [{"label": "class", "description": "a subclass of another class", "body": {"is": "${1:opening}"}}]
    },
    "typical": {
      "type": "object",
      "additionalProperties": false,
      "properties": {
        "per storey": {"$ref": "#/definitions/range", "description": "how many in a storey: lo .. hi, or lo .."},
        "per facade": {"$ref": "#/definitions/range", "description": "how many on a facade: lo .. hi, or lo .."},
        "per building": {"$ref": "#/definitions/range", "description": "how many on a building: lo .. hi, or lo .."}
      }
    },
    "relation": {
      "type": "object",
      "required": ["within", "where"],
      "additionalProperties": false,
      "properties": {
        "within": {"type": "string", "description": "the relation that it narrows, such as same storey"},
        "where": {"type": "string", "description": "a condition on self and other; pairs for which it holds are kept"}
      },
      "defaultSnippets": [
        {
          "label": "relation",
          "description": "a relation",
          "body": {"within": "${1:same storey}", "where": "${2:abs(base_height - other.base_height) <= 0.2 m}"}
        }
      ]
    },
    "rule": {
      "type": "object",
      "required": ["id", "label", "require"],
      "additionalProperties": false,
      "properties": {
        "id": {"$ref": "#/definitions/id", "description": "names joined by points, unique in the pack"},
        "label": {"type": "string", "description": "the class that the rule assigns"},
        "priority": {"type": "integer", "description": "rules of higher priority win; 0 if it is not given"},
        "require": {"$ref": "#/definitions/conditions", "description": "conditions that must all be true"},
        "unless": {"$ref": "#/definitions/conditions", "description": "vetoes: conditions of which none may be true"},
        "score": {
          "type": ["array", "null"],
          "items": {"anyOf": [{"type": "string"}, {"$ref": "#/definitions/term"}]},
          "description": "terms from 0 to 1, whose weighted mean is the score; without terms the score is 1"
        }
      },
      "defaultSnippets": [
        {
          "label": "rule",
          "description": "a rule for a class",
          "body": {"id": "${1:class.name}", "label": "${2:class}", "require": ["${3:sense = hole and host is wall}"]}
        },
        {
          "label": "rule with score",
          "description": "a rule with a score for how well a feature fits",
          "body": {
            "id": "${1:class.name}",
            "label": "${2:class}",
            "require": ["${3:sense = hole}"],
            "score": [{"${4:a}": {"rise": "${5:0.4 m .. 0.9 m}", "fall": "${6:2 m .. 2.8 m}"}}]
          }
        }
      ]
    },
    "removal": {
      "type": "object",
      "required": ["id", "remove"],
      "additionalProperties": false,
      "properties": {
        "id": {"$ref": "#/definitions/id", "description": "the rule or entry of the base pack"},
        "remove": {"const": true, "description": "removes it"}
      },
      "defaultSnippets": [
        {
          "label": "remove",
          "description": "remove a rule of the base pack",
          "body": {"id": "${1:class.name}", "remove": true}
        }
      ]
    },
    "term": {
      "type": "object",
      "minProperties": 1,
      "maxProperties": 1,
      "additionalProperties": {"$ref": "#/definitions/judgement"}
    },
    "judgement": {
      "type": "object",
      "additionalProperties": false,
      "properties": {
        "rise": {"$ref": "#/definitions/range", "description": "the term rises from 0 to 1 over this range: lo .. hi"},
        "fall": {"$ref": "#/definitions/range", "description": "the term falls from 1 to 0 over this range: lo .. hi"},
        "weight": {"type": "number", "description": "how much the term counts; 1 if it is not given"}
      },
      "defaultSnippets": [
        {
          "label": "rise and fall",
          "description": "a term with two ramps",
          "body": {"rise": "${1:0.4 m .. 0.9 m}", "fall": "${2:2 m .. 2.8 m}"}
        }
      ]
    },
    "invariants": %INVARIANTS%,
    "decide": {
      "type": "object",
      "additionalProperties": false,
      "properties": {
        "min_score": {"$ref": "#/definitions/expression", "description": "a rule with a lower score gives no label"},
        "ambiguous_below": {
          "$ref": "#/definitions/expression",
          "description": "a label that leads by less than this is reported as close"
        },
        "evidence": {"$ref": "#/definitions/expression", "description": "the most by which neighbours change a score"},
        "company": {
          "anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}],
          "description": "relations that lead to comparable features"
        },
        "otherwise": {"enum": ["unknown"], "description": "the label of a feature for which no rule holds"}
      }
    },
    "iterate": {
      "type": "object",
      "required": ["rounds"],
      "additionalProperties": false,
      "properties": {"rounds": {"type": "integer", "minimum": 2, "maximum": 8, "description": "the largest number of rounds, 2 to 8"}}
    },
    "group": {
      "type": "object",
      "required": ["of", "by"],
      "additionalProperties": false,
      "properties": {
        "of": {"type": "string", "description": "the class of its members"},
        "by": {"type": "string", "description": "the relation that joins them"},
        "at_least": {"type": "integer", "description": "the fewest members; 2 if it is not given"}
      },
      "defaultSnippets": [
        {
          "label": "group",
          "description": "features in a row",
          "body": {"of": "${1:window}", "by": "${2:in_row}", "at_least": "^${3:2}"}
        }
      ]
    },
    "emission": {
      "type": "object",
      "required": ["type"],
      "additionalProperties": false,
      "properties": {
        "type": {
          "enum": ["Window", "Door", "BuildingInstallation"],
          "description": "the type of object in CityGML and CityJSON"
        },
        "class": {"type": "string", "description": "the code of its class, in quotes"},
        "function": {
          "type": ["object", "null"],
          "additionalProperties": {"type": "string"},
          "description": "the code of its function, by code list"
        },
        "top": {"enum": ["RoofSurface", "OuterFloorSurface"], "description": "the surface type of its faces that look up"}
      },
      "defaultSnippets": [
        {
          "label": "installation",
          "description": "write as BuildingInstallation",
          "body": {"type": "BuildingInstallation"}
        }
      ]
    },
    "surface": {
      "type": "object",
      "required": ["id", "type", "when"],
      "additionalProperties": false,
      "properties": {
        "id": {"$ref": "#/definitions/id", "description": "names joined by points, unique in the section"},
        "type": {
          "enum": [
            "WallSurface",
            "RoofSurface",
            "GroundSurface",
            "ClosureSurface",
            "OuterCeilingSurface",
            "OuterFloorSurface"
          ],
          "description": "the semantic surface"
        },
        "when": {"$ref": "#/definitions/conditions", "description": "conditions on the polygon that must all hold"}
      },
      "defaultSnippets": [
        {
          "label": "surface",
          "description": "an entry of surfaces",
          "body": {"id": "${1:roof.any}", "type": "${2:RoofSurface}", "when": "${3:looks_up}"}
        }
      ]
    },
    "entry": {
      "type": "object",
      "required": ["id", "scale", "for", "do"],
      "additionalProperties": false,
      "properties": {
        "id": {"$ref": "#/definitions/id", "description": "names joined by points, unique in the section"},
        "scale": {
          "type": "string",
          "pattern": "^ *1:.*\\.\\.",
          "description": "the target scales, such as 1:500 .. 1:5000, in quotes"
        },
        "for": {"type": "string", "description": "a class, any, or group NAME"},
        "when": {"type": "string", "description": "a condition that must also be true"},
        "do": {"$ref": "#/definitions/operation", "description": "the operator, with its arguments"},
        "with": {
          "type": "object",
          "required": ["by"],
          "additionalProperties": false,
          "properties": {
            "by": {"type": "string", "description": "the relation that leads to what goes along"},
            "of": {"type": "string", "description": "its class (what has no label)"},
            "as": {
              "enum": ["goes", "moves", "grows"],
              "description": "what becomes of it when the feature is drawn elsewhere or larger (goes)"
            }
          },
          "description": "what belongs to a feature, and goes away, moves or grows with it"
        }
      },
      "defaultSnippets": [
        {
          "label": "omit",
          "description": "omit features that are small on the map",
          "body": {
            "id": "${1:small.omit}",
            "scale": "${2:1:500 .. 1:5000}",
            "for": "${3:any}",
            "when": "${4:a < 0.5 mm@map}",
            "do": "omit"
          }
        }
      ]
    },
    "operation": %OPERATORS%
  }
}
)json";

constexpr std::string_view kInvariants = "%INVARIANTS%";
constexpr const char* kInvariantsSchema = R"json({
      "type": "object",
      "additionalProperties": false,
      "description": "limits of change that no operation may exceed",
      "properties": {
        "footprint-pct": {"type": "number", "description": "area of the footprint, in per cent"},
        "volume-pct": {"type": "number", "description": "volume, in per cent"},
        "overhang-pct": {"type": "number", "description": "overhanging area, in per cent of the footprint"},
        "party-walls-pct": {"type": "number", "description": "area of walls shared with neighbours, in per cent"},
        "top-m": {"type": "number", "description": "height of the highest point, in metres"},
        "ridge-m": {"type": "number", "description": "height of the ridge, in metres"},
        "eaves-m": {"type": "number", "description": "height of the eaves, in metres"}
      }
    })json";

std::string argument_schema(const OperatorArgument& argument) {
  const std::string type =
      argument.words.empty()
          ? std::string(R"("$ref": "#/definitions/expression")")
          : fmt::format(R"("enum": ["{}"])", fmt::join(argument.words, "\", \""));
  return fmt::format(R"("{}": {{{}, "description": "{}"}})", argument.name, type, argument.meaning);
}

/// `omit`, or `enlarge: {to: …}`; without arguments a name alone.
std::string operations_schema() {
  std::string names, calls;
  for (const OperatorKind& kind : operator_table()) {
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", kind.name);
    if (kind.arguments.empty()) continue;
    std::string arguments;
    for (const OperatorArgument& argument : kind.arguments)
      arguments += (arguments.empty() ? "" : ", ") + argument_schema(argument);
    calls += fmt::format(
        "{}\n        \"{}\": {{\"type\": \"object\", \"description\": \"{}\", "
        "\"additionalProperties\": false, \"properties\": {{{}}}}}",
        calls.empty() ? "" : ",", kind.name, kind.meaning, arguments);
  }
  return fmt::format(
      "{{\n      \"anyOf\": [{{\"enum\": [{}]}}, {{\n        \"type\": \"object\", "
      "\"minProperties\": 1, \"maxProperties\": 1, \"additionalProperties\": false, "
      "\"properties\": {{{}\n      }}}}]\n    }}",
      names, calls);
}

}  // namespace

std::string with_invariants(std::string schema) {
  return schema.replace(schema.find(kInvariants), kInvariants.size(), kInvariantsSchema);
}

const Grammar& pack_grammar() {
  static const Grammar grammar([] {
    std::string schema = kPackSchema;
    schema.replace(schema.find(kOperators), kOperators.size(), operations_schema());
    return with_invariants(std::move(schema));
  }());
  return grammar;
}

}  // namespace oriel::rules
