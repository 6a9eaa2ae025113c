#include "interpret/plan/profile_grammar.h"

#include "interpret/pack/pack_grammar.h"

namespace oriel::rules {

namespace {

constexpr const char* kProfileSchema = R"json({
  "$schema": "http://json-schema.org/draft-07/schema#",
  "$id": "urn:oriel:schema:oriel-profile-1",
  "title": "oriel-profile/1 profile",
  "type": "object",
  "required": ["schema", "profile", "levels"],
  "additionalProperties": false,
  "properties": {
    "schema": {"const": "oriel-profile/1", "description": "the version of the language"},
    "profile": {"$ref": "#/definitions/header", "description": "the name and the version of the profile"},
    "levels": {
      "type": ["object", "null"],
      "additionalProperties": {"$ref": "#/definitions/level"},
      "description": "what each level of detail or map asks for, by its name in quotes"
    }
  },
  "definitions": {
    "header": {
      "type": "object",
      "required": ["name", "version"],
      "additionalProperties": false,
      "properties": {
        "name": {"type": "string", "description": "what the profile is called"},
        "version": {"type": "string", "description": "three numbers, such as 1.0.0"}
      }
    },
    "classes": {"type": ["array", "null"], "items": {"type": "string"}},
    "size": {"type": "number", "exclusiveMinimum": 0},
    "level": {
      "type": "object",
      "required": ["form"],
      "additionalProperties": false,
      "properties": {
        "form": {
          "enum": ["as-is", "block", "blocks"],
          "description": "the building as it is, one flat block, or one for each main part of the roof"
        },
        "least-piece-m2": {
          "$ref": "#/definitions/size",
          "description": "of blocks: courtyards and separate pieces with less area go"
        },
        "footprint-edge-m": {
          "$ref": "#/definitions/size",
          "description": "of one block: shorter edges of the footprint go, where they can"
        },
        "omit": {"$ref": "#/definitions/classes", "description": "classes of which all goes"},
        "keep": {"$ref": "#/definitions/classes", "description": "classes of which all stays"},
        "imprints": {"enum": ["keep", "omit"], "description": "what becomes of flush panels without label"},
        "on-ground": {
          "$ref": "#/definitions/classes",
          "description": "what reaches the ground goes only if it is of one of these classes"
        },
        "sizes-m": {"$ref": "#/definitions/sizes", "description": "the least extents, with area-m2"},
        "area-m2": {"$ref": "#/definitions/size", "description": "the least area, with sizes-m"},
        "map-mm": {
          "$ref": "#/definitions/size",
          "description": "in place of sizes-m: the least length on the map, in millimetres"
        },
        "verdicts": {
          "$ref": "#/definitions/verdicts",
          "description": "what becomes of features for their size that neither pack nor lists decide of"
        },
        "parts": {"$ref": "#/definitions/parts", "description": "what is a part of the building and does not go for its size"},
        "invariants": %INVARIANTS%,
        "edge-min-m": {
          "$ref": "#/definitions/size",
          "description": "the least edge and gap that the whole result is to have"
        },
        "edge-owner-b-m": {
          "$ref": "#/definitions/size",
          "description": "features with a shorter edge go if their middle extent is below this"
        },
        "stl-solids": {"enum": ["label", "class"], "description": "what the solids of an STL are named by"},
        "buildings": {"$ref": "#/definitions/buildings", "description": "when buildings that adjoin become one"}
      }
    },
    "sizes": {
      "type": "object",
      "required": ["a", "b", "c"],
      "additionalProperties": false,
      "properties": {
        "a": {"$ref": "#/definitions/size", "description": "the longest extent"},
        "b": {"$ref": "#/definitions/size", "description": "the middle extent"},
        "c": {"$ref": "#/definitions/size", "description": "the shortest extent"}
      }
    },
    "verdicts": {
      "type": "object",
      "additionalProperties": false,
      "properties": {
        "point": {"enum": ["keep", "omit"], "description": "small in all extents"},
        "line": {"enum": ["keep", "omit"], "description": "long and thin"},
        "small": {"enum": ["keep", "omit"], "description": "of less than the least area"},
        "sheet": {"enum": ["keep", "omit"], "description": "wide and thin, wherever it is"},
        "lamina": {"enum": ["keep", "omit", "flatten"], "description": "a sheet flat on its facet: a plate, a shallow niche"},
        "cap": {"enum": ["keep", "omit", "flatten"], "description": "a sheet flat on its facet and reaching beyond it: an overhang"},
        "fin": {"enum": ["keep", "omit", "enlarge"], "description": "a sheet on edge: a slab, a canopy, a parapet"},
        "enclosed": {"enum": ["keep", "omit"], "description": "a sheet within the box of what it touches: a slot, an inner wall"}
      }
    },
    "parts": {
      "type": "object",
      "required": ["height-m", "area-m2"],
      "additionalProperties": false,
      "properties": {
        "height-m": {"$ref": "#/definitions/size", "description": "its least height"},
        "area-m2": {"$ref": "#/definitions/size", "description": "its least area seen from above"}
      }
    },
    "buildings": {
      "type": "object",
      "required": ["aggregate"],
      "additionalProperties": false,
      "properties": {
        "aggregate": {"enum": ["touching"], "description": "which become one"},
        "gap-mm": {"$ref": "#/definitions/size", "description": "narrower gaps on the map are closed"},
        "like-height-m": {"$ref": "#/definitions/size", "description": "their roofs differ by no more"},
        "from-scale": {"$ref": "#/definitions/size", "description": "at larger scales each stays by itself"},
        "typify": {"$ref": "#/definitions/typify", "description": "how many stay of a row of detached buildings"}
      }
    },
    "typify": {
      "type": "object",
      "required": ["ratio"],
      "additionalProperties": false,
      "properties": {
        "ratio": {"type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1, "description": "the share that stays"},
        "from-scale": {"$ref": "#/definitions/size", "description": "at larger scales all do"}
      }
    }
  }
}
)json";

}  // namespace

const Grammar& profile_grammar() {
  static const Grammar grammar(with_invariants(kProfileSchema));
  return grammar;
}

}  // namespace oriel::rules
