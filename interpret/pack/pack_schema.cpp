#include "interpret/pack/pack_schema.h"

#include "interpret/plan/operators.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel {

namespace {

/// All but the operators, which stand at the place of the @.
constexpr const char* kSchema = R"json({
  "$schema": "http://json-schema.org/draft-07/schema#",
  "title": "oriel/1 rule pack",
  "type": "object",
  "required": ["schema", "pack"],
  "anyOf": [{"required": ["rules"]}, {"required": ["extends"]}],
  "additionalProperties": false,
  "properties": {
    "schema": {"const": "oriel/1", "description": "the version of the language"},
    "pack": {"$ref": "#/definitions/header"},
    "extends": {"type": "string", "description": "a pack that is built in, or a file in the same folder"},
    "params": {"$ref": "#/definitions/params"},
    "hosts": {"$ref": "#/definitions/hosts"},
    "classes": {"$ref": "#/definitions/classes"},
    "relations": {"type": ["object", "null"], "additionalProperties": {"$ref": "#/definitions/relation"}},
    "macros": {"type": ["object", "null"], "additionalProperties": {"$ref": "#/definitions/expression"}},
    "rules": {"type": ["array", "null"], "items": {"anyOf": [{"$ref": "#/definitions/rule"}, {"$ref": "#/definitions/removal"}]}},
    "decide": {"$ref": "#/definitions/decide"},
    "iterate": {"$ref": "#/definitions/iterate"},
    "groups": {"type": ["object", "null"], "additionalProperties": {"$ref": "#/definitions/group"}},
    "emit": {"type": ["object", "null"], "additionalProperties": {"$ref": "#/definitions/emission"}},
    "surfaces": {"type": ["array", "null"], "items": {"anyOf": [{"$ref": "#/definitions/surface"}, {"$ref": "#/definitions/removal"}]}},
    "generalise": {"type": ["array", "null"], "items": {"anyOf": [{"$ref": "#/definitions/entry"}, {"$ref": "#/definitions/removal"}]}},
    "invariants": {"$ref": "#/definitions/invariants"}
  },
  "definitions": {
    "expression": {"type": ["string", "number"], "description": "an expression of the rule language"},
    "range": {"type": "string", "pattern": "\\.\\.", "description": "lo .. hi"},
    "conditions": {"anyOf": [{"type": "string"}, {"type": "array", "minItems": 1, "items": {"type": "string"}}]},
    "id": {"type": "string", "description": "names joined by points"},
    "header": {
      "type": "object", "required": ["name", "version"], "additionalProperties": false,
      "properties": {"name": {"type": "string"}, "version": {"type": "string", "pattern": "^[0-9]+\\.[0-9]+\\.[0-9]+$"}}
    },
    "params": {
      "type": ["object", "null"],
      "additionalProperties": {"$ref": "#/definitions/param"}
    },
    "param": {
      "type": "object", "additionalProperties": false,
      "properties": {
        "value": {"$ref": "#/definitions/expression"},
        "range": {"$ref": "#/definitions/range"},
        "why": {"type": ["string", "number"], "description": "the reason or the source"}
      }
    },
    "hosts": {
      "type": "object", "additionalProperties": false,
      "properties": {
        "wall": {"$ref": "#/definitions/range"}, "roof": {"$ref": "#/definitions/range"},
        "ground": {"$ref": "#/definitions/range"}, "ground_reach": {"$ref": "#/definitions/expression"}
      }
    },
    "classes": {
      "type": ["object", "null"],
      "additionalProperties": {"anyOf": [{"type": "null"}, {"$ref": "#/definitions/class"}]}
    },
    "class": {
      "type": "object", "additionalProperties": false,
      "properties": {
        "is": {"type": "string"}, "abstract": {"type": "boolean"}, "typical": {"$ref": "#/definitions/typical"}
      }
    },
    "typical": {
      "type": "object", "additionalProperties": false,
      "properties": {
        "per storey": {"$ref": "#/definitions/range"}, "per facade": {"$ref": "#/definitions/range"},
        "per building": {"$ref": "#/definitions/range"}
      }
    },
    "relation": {
      "type": "object", "required": ["within", "where"], "additionalProperties": false,
      "properties": {"within": {"type": "string"}, "where": {"type": "string"}}
    },
    "rule": {
      "type": "object", "required": ["id", "label", "require"], "additionalProperties": false,
      "properties": {
        "id": {"$ref": "#/definitions/id"}, "label": {"type": "string"}, "priority": {"type": "integer"},
        "require": {"$ref": "#/definitions/conditions"}, "unless": {"$ref": "#/definitions/conditions"},
        "score": {"type": ["array", "null"], "items": {"anyOf": [{"type": "string"}, {"$ref": "#/definitions/term"}]}}
      }
    },
    "removal": {
      "type": "object", "required": ["id", "remove"], "additionalProperties": false,
      "properties": {"id": {"$ref": "#/definitions/id"}, "remove": {"const": true}}
    },
    "term": {
      "type": "object", "minProperties": 1, "maxProperties": 1,
      "additionalProperties": {"$ref": "#/definitions/judgement"}
    },
    "judgement": {
      "type": "object", "additionalProperties": false,
      "properties": {
        "rise": {"$ref": "#/definitions/range"}, "fall": {"$ref": "#/definitions/range"},
        "weight": {"type": "number"}
      }
    },
    "invariants": {
      "type": "object", "additionalProperties": false, "description": "what no operation may change by more than that",
      "properties": {
        "footprint-pct": {"type": "number"}, "volume-pct": {"type": "number"}, "overhang-pct": {"type": "number"},
        "party-walls-pct": {"type": "number"}, "top-m": {"type": "number"}, "ridge-m": {"type": "number"}, "eaves-m": {"type": "number"}
      }
    },
    "decide": {
      "type": "object", "additionalProperties": false,
      "properties": {
        "min_score": {"$ref": "#/definitions/expression"}, "ambiguous_below": {"$ref": "#/definitions/expression"},
        "evidence": {"$ref": "#/definitions/expression", "description": "the most that neighbours move a score by"},
        "company": {"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}], "description": "relations to what is comparable"},
        "otherwise": {"enum": ["unknown"]}
      }
    },
    "iterate": {
      "type": "object", "required": ["rounds"], "additionalProperties": false,
      "properties": {"rounds": {"type": "integer", "minimum": 2, "maximum": 8}}
    },
    "group": {
      "type": "object", "required": ["of", "by"], "additionalProperties": false,
      "properties": {"of": {"type": "string"}, "by": {"type": "string"}, "at_least": {"type": "integer"}}
    },
    "emission": {
      "type": "object", "required": ["type"], "additionalProperties": false,
      "properties": {
        "type": {"enum": ["Window", "Door", "BuildingInstallation"]}, "class": {"type": "string"},
        "function": {"type": ["object", "null"], "additionalProperties": {"type": "string"}},
        "top": {"enum": ["RoofSurface", "OuterFloorSurface"]}
      }
    },
    "surface": {
      "type": "object", "required": ["id", "type", "when"], "additionalProperties": false,
      "properties": {
        "id": {"$ref": "#/definitions/id"},
        "type": {"enum": ["WallSurface", "RoofSurface", "GroundSurface", "ClosureSurface", "OuterCeilingSurface", "OuterFloorSurface"]},
        "when": {"$ref": "#/definitions/conditions"}
      }
    },
    "entry": {
      "type": "object", "required": ["id", "scale", "for", "do"], "additionalProperties": false,
      "properties": {
        "id": {"$ref": "#/definitions/id"},
        "scale": {"type": "string", "pattern": "^ *1:.*\\.\\."},
        "for": {"type": "string"}, "when": {"type": "string"}, "do": {"$ref": "#/definitions/operation"}
      }
    },
    "operation": @
  }
}
)json";

std::string argument_schema(const OperatorArgument& argument) {
  const std::string type =
      argument.words.empty()
          ? std::string(R"("$ref": "#/definitions/expression")")
          : fmt::format(R"("enum": ["{}"])", fmt::join(argument.words, "\", \""));
  return fmt::format(R"("{}": {{{}}})", argument.name, type);
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

std::string pack_schema() {
  std::string schema = kSchema;
  return schema.replace(schema.find('@'), 1, operations_schema());
}

}  // namespace oriel
