#include "interpret/testing/test_grammar.h"

namespace oriel::rules {

namespace {

constexpr const char* kTestSchema = R"json({
  "$schema": "http://json-schema.org/draft-07/schema#",
  "$id": "urn:oriel:schema:oriel-tests-1",
  "title": "tests of an oriel/1 rule pack",
  "type": "object",
  "required": ["tests_for", "tests"],
  "additionalProperties": false,
  "properties": {
    "tests_for": {"type": "string", "description": "the pack that is tested: a file next to this one, or a built-in pack"},
    "fixtures": {
      "type": ["object", "null"],
      "additionalProperties": {"$ref": "#/definitions/fixture"},
      "description": "features with values, by the name of a facade or a house"
    },
    "tests": {
      "type": "array",
      "minItems": 1,
      "items": {"$ref": "#/definitions/test"},
      "description": "what is expected of which fixture"
    }
  },
  "definitions": {
    "values": {"type": ["object", "null"], "additionalProperties": true},
    "fixture": {
      "type": "object",
      "required": ["features"],
      "additionalProperties": false,
      "properties": {
        "defaults": {"$ref": "#/definitions/values", "description": "values that all features have"},
        "features": {
          "type": ["object", "null"],
          "additionalProperties": {"$ref": "#/definitions/values"},
          "description": "the features by name"
        }
      }
    },
    "repeat": {
      "type": "object",
      "additionalProperties": false,
      "properties": {
        "columns": {"type": "integer", "description": "how many features side by side"},
        "rows": {"type": "integer", "description": "how many rows of them, upwards"},
        "dx": {"type": ["string", "number"], "description": "from one to the next along the wall"},
        "dz": {"type": ["string", "number"], "description": "from one row to the next"}
      }
    },
    "test": {
      "type": "object",
      "required": ["name", "given"],
      "additionalProperties": false,
      "properties": {
        "name": {"type": ["string", "number"], "description": "a sentence"},
        "given": {"type": ["string", "object"], "description": "a fixture, or building: FILE"},
        "expect": {"$ref": "#/definitions/expectation", "description": "the label of each feature"},
        "because": {
          "type": ["object", "null"],
          "additionalProperties": {"type": "string"},
          "description": "which rules hold or fail"
        },
        "property": {"$ref": "#/definitions/property", "description": "values that are perturbed, and how often"}
      }
    },
    "counts": {"type": ["object", "null"], "additionalProperties": {"type": "integer", "minimum": 0}},
    "expectation": {
      "type": ["object", "null"],
      "additionalProperties": {"type": "string"},
      "properties": {
        "counts": {"$ref": "#/definitions/counts", "description": "how many of each class"},
        "groups": {"$ref": "#/definitions/counts", "description": "how many groups of each kind"}
      }
    },
    "property": {
      "type": "object",
      "required": ["perturb"],
      "additionalProperties": false,
      "properties": {
        "perturb": {
          "type": ["object", "null"],
          "additionalProperties": {"type": ["string", "number"]},
          "description": "how much each attribute is moved"
        },
        "times": {"type": "integer", "minimum": 1, "maximum": 1000, "description": "how often"}
      }
    }
  }
}
)json";

}  // namespace

const Grammar& test_grammar() {
  static const Grammar grammar(kTestSchema);
  return grammar;
}

}  // namespace oriel::rules
