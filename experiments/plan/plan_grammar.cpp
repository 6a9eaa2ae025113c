#include "experiments/plan/plan_grammar.h"

namespace oriel {

namespace {

constexpr const char* kExperimentJsonSchema = R"json({
  "$schema": "http://json-schema.org/draft-07/schema#",
  "$id": "urn:oriel:schema:oriel-experiment-1",
  "title": "oriel-experiment/1 experiment on rules",
  "type": "object",
  "required": ["schema", "name"],
  "anyOf": [{"required": ["sets", "rules"]}, {"required": ["count_as_paper"]}],
  "additionalProperties": false,
  "defaultSnippets": [
    {
      "label": "experiment",
      "description": "a sweep over the params of residential",
      "body": {
        "schema": "oriel-experiment/1",
        "name": "${1:my_experiment}",
        "sets": {"${2:houses}": {"models": "${3:houses/*.city.json}", "truth": "${4:houses/*.truth.json}"}},
        "rules": "${5:residential}",
        "sweep": {"params": "all", "values": 5}
      }
    }
  ],
  "properties": {
    "schema": {"const": "oriel-experiment/1", "description": "the version of the language"},
    "name": {"type": ["string", "number"], "description": "the title of the report"},
    "about": {"type": ["string", "number"], "description": "a text below the title"},
    "seed": {"type": "integer", "minimum": 0, "description": "of all that is drawn at random"},
    "bootstrap": {"type": "integer", "minimum": 1, "description": "samples of the buildings for the intervals"},
    "sets": {
      "type": "object",
      "minProperties": 1,
      "additionalProperties": {"$ref": "#/definitions/set"},
      "description": "the buildings, set by set, and what is known of them"
    },
    "rules": {
      "anyOf": [{"type": "string"}, {"$ref": "#/definitions/rules"}],
      "description": "the pack: one that is built in, or a file beside this one"
    },
    "options": {
      "type": "object",
      "additionalProperties": false,
      "properties": {
        "order": {"$ref": "#/definitions/order"},
        "coplanar": {"$ref": "#/definitions/coplanar"},
        "plane_offset": {"$ref": "#/definitions/plane_offset"},
        "weld": {"$ref": "#/definitions/weld"},
        "value_rel": {"$ref": "#/definitions/value_rel"},
        "close": {"$ref": "#/definitions/close"},
        "close_area": {"$ref": "#/definitions/close_area"},
        "crossings": {"$ref": "#/definitions/crossings"},
        "budget": {"$ref": "#/definitions/budget"},
        "lod": {"$ref": "#/definitions/lod"}
      },
      "description": "how buildings are segmented, if not as the command does by default"
    },
    "sweep": {"$ref": "#/definitions/sweep", "description": "params take other values"},
    "ablate": {
      "anyOf": [{"$ref": "#/definitions/piece"}, {"type": "array", "minItems": 1, "items": {"$ref": "#/definitions/piece"}}],
      "description": "parts of the pack are taken out, each on its own"
    },
    "compare": {
      "type": "object",
      "minProperties": 1,
      "additionalProperties": {"anyOf": [{"type": "string"}, {"$ref": "#/definitions/compared"}]},
      "description": "what differs from the experiment's own rules and options, by the name of the run"
    },
    "stability": {"$ref": "#/definitions/stability", "description": "the buildings are disturbed"},
    "learning_curve": {"$ref": "#/definitions/learning_curve", "description": "params are learnt from growing numbers of buildings"},
    "learn": {"$ref": "#/definitions/learn", "description": "params are learnt, and measured on other buildings"},
    "count_as_paper": {"$ref": "#/definitions/texts", "description": "patterns of models of which the tests of the paper's algorithm are counted"}
  },
  "definitions": {
    "quantity": {"type": ["string", "number"], "description": "a number with its unit, such as 0.6 m"},
    "quantities": {
      "anyOf": [
        {"$ref": "#/definitions/quantity"},
        {"type": "array", "minItems": 1, "items": {"$ref": "#/definitions/quantity"}}
      ]
    },
    "texts": {
      "anyOf": [
        {"type": ["string", "number"]},
        {"type": "array", "minItems": 1, "items": {"type": ["string", "number"]}}
      ]
    },
    "piece": {"enum": ["rules", "conditions", "evidence"]},
    "set": {
      "type": "object",
      "required": ["truth"],
      "additionalProperties": false,
      "properties": {
        "models": {"$ref": "#/definitions/texts", "description": "patterns of the buildings' files"},
        "features": {"$ref": "#/definitions/texts", "description": "patterns of stored features"},
        "truth": {"$ref": "#/definitions/texts", "description": "patterns of the true objects"},
        "semantics": {"enum": ["ignored", "kept"], "description": "whether what models call their polygons is looked at"},
        "split": {
          "anyOf": [{"const": "leave_one_out"}, {"$ref": "#/definitions/split"}],
          "description": "which buildings are learnt from, and which are measured"
        }
      }
    },
    "split": {
      "type": "object",
      "minProperties": 1,
      "maxProperties": 1,
      "additionalProperties": false,
      "properties": {
        "folds": {"type": "integer", "minimum": 2, "description": "so many parts: each is measured once, and the others are learnt from"},
        "held_out": {"$ref": "#/definitions/texts", "description": "ids of the buildings that are measured"}
      }
    },
    "param_values": {
      "type": ["object", "null"],
      "additionalProperties": {"$ref": "#/definitions/quantity"},
      "description": "params at other values than in the pack"
    },
    "rules": {
      "type": "object",
      "required": ["pack"],
      "additionalProperties": false,
      "properties": {
        "pack": {"type": "string", "description": "one that is built in, or a file beside this one"},
        "params": {"$ref": "#/definitions/param_values", "description": "params at other values than in the pack"}
      }
    },
    "order": {"enum": ["natural", "paper"], "description": "the order of cuts"},
    "coplanar": {"$ref": "#/definitions/quantity", "description": "polygons share a plane if their tilt differs by no more than this angle"},
    "plane_offset": {"$ref": "#/definitions/quantity", "description": "and their offset by no more than this length"},
    "weld": {"$ref": "#/definitions/quantity", "description": "vertices closer than this are one"},
    "value_rel": {"$ref": "#/definitions/quantity", "description": "values of features that differ by no more than this share count as equal"},
    "close": {"enum": ["none", "planar", "ground", "any"], "description": "which holes of a shell are closed"},
    "close_area": {"$ref": "#/definitions/quantity", "description": "the largest plane hole to close"},
    "crossings": {"enum": ["leave", "cut"], "description": "what becomes of polygons that cross"},
    "budget": {"type": "integer", "minimum": 1, "description": "most steps of each stage on one building"},
    "lod": {"type": ["string", "number"], "description": "the level of detail to read"},
    "compared": {
      "type": "object",
      "minProperties": 1,
      "additionalProperties": false,
      "properties": {
        "pack": {"type": "string", "description": "another pack"},
        "params": {"$ref": "#/definitions/param_values", "description": "params at other values"},
        "order": {"$ref": "#/definitions/order"},
        "coplanar": {"$ref": "#/definitions/coplanar"},
        "plane_offset": {"$ref": "#/definitions/plane_offset"},
        "weld": {"$ref": "#/definitions/weld"},
        "value_rel": {"$ref": "#/definitions/value_rel"},
        "close": {"$ref": "#/definitions/close"},
        "close_area": {"$ref": "#/definitions/close_area"},
        "crossings": {"$ref": "#/definitions/crossings"},
        "budget": {"$ref": "#/definitions/budget"},
        "lod": {"$ref": "#/definitions/lod"}
      }
    },
    "sweep": {
      "type": "object",
      "required": ["params"],
      "additionalProperties": false,
      "properties": {
        "params": {
          "anyOf": [
            {"$ref": "#/definitions/texts"},
            {"type": "object", "minProperties": 1, "additionalProperties": {"$ref": "#/definitions/quantities"}}
          ],
          "description": "all, names, or a map of names and ranges or values"
        },
        "values": {"type": "integer", "minimum": 1, "description": "how many from end to end of a range"},
        "design": {"enum": ["one_at_a_time", "grid", "random"], "description": "which values go together"},
        "samples": {"type": "integer", "minimum": 1, "description": "of a random design: how many draws"}
      }
    },
    "stability": {
      "type": "object",
      "minProperties": 1,
      "additionalProperties": false,
      "properties": {
        "noise": {"$ref": "#/definitions/quantities", "description": "vertices are moved by up to this length"},
        "triangulation": {"type": "boolean", "description": "polygons are cut into triangles"},
        "rotation": {"$ref": "#/definitions/quantities", "description": "buildings are turned about the upright axis"},
        "missing_faces": {"$ref": "#/definitions/quantities", "description": "the share of polygons that is taken out"},
        "tolerances": {
          "type": "object",
          "minProperties": 1,
          "additionalProperties": false,
          "properties": {
            "coplanar": {"$ref": "#/definitions/quantities", "description": "angles"},
            "plane_offset": {"$ref": "#/definitions/quantities", "description": "lengths"},
            "weld": {"$ref": "#/definitions/quantities", "description": "lengths"},
            "value_rel": {"$ref": "#/definitions/quantities", "description": "shares"}
          },
          "description": "buildings are segmented with other tolerances"
        },
        "times": {"type": "integer", "minimum": 1, "description": "how often what is random is drawn"}
      }
    },
    "learn": {
      "type": "object",
      "additionalProperties": false,
      "properties": {
        "params": {"$ref": "#/definitions/texts", "description": "all, or the names of those that may change"},
        "objective": {"type": "string", "description": "macro_f1, or the class whose F1 counts"}
      }
    },
    "learning_curve": {
      "type": "object",
      "required": ["buildings"],
      "additionalProperties": false,
      "properties": {
        "params": {"$ref": "#/definitions/texts", "description": "all, or the names of those that may change"},
        "objective": {"type": "string", "description": "macro_f1, or the class whose F1 counts"},
        "buildings": {
          "anyOf": [{"type": "integer", "minimum": 2}, {"type": "array", "minItems": 1, "items": {"type": "integer", "minimum": 2}}],
          "description": "how many are learnt from"
        },
        "times": {"type": "integer", "minimum": 1, "description": "how often these are drawn"}
      }
    }
  }
}
)json";

}  // namespace

const rules::Grammar& plan_grammar() {
  static const rules::Grammar grammar(kExperimentJsonSchema);
  return grammar;
}

}  // namespace oriel
