#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// An argument that an operator takes in a pack: `do: {enlarge: {to: 0.5 mm@map, anchor: sill}}`.
struct OperatorArgument {
  std::string name;
  /// "length", "ratio" or "word".
  std::string kind;
  std::string meaning;
  /// The words that it may be.
  std::vector<std::string> words{};
};

/// What a pack may ask for under `do:`.
struct OperatorKind {
  std::string name;
  std::string meaning;
  std::vector<OperatorArgument> arguments;

  [[nodiscard]] bool takes(std::string_view argument) const;
};

/// All operators by name.
const std::vector<OperatorKind>& operator_table();

/// What an operator redraws together:
/// - feature: one feature after the other, so what was drawn before may be in the way already. For
///   what stays where it is.
/// - row: those of one storey and wall plane, or group of the pack, all of them or none, unless the
///   step makes them blocks.
/// - wall: those of one wall plane. For what moves: all places can be found before any is drawn.
///   Those that stay as they are come back as Placed::left, and the others are tried again.
enum class OperatorScope { feature, row, wall };

/// What is carried out first: what puts features back, what moves a facet after what is put onto
/// it, outlines last.
enum class OperatorTurn { features, facets, outlines };

}  // namespace oriel

/// The table of all operators but `omit`, which draws nothing: name, scope, turn, meaning, and the
/// arguments. `interpret` reads packs by it, `generalise` finds the function of that name
/// (generalise/operators/operators.h). To add an operator: its function in a file of its own in
/// generalise/operators, a row here, a section in docs/generalisation.md.
#define ORIEL_OPERATORS(ROW)                                                                       \
  ROW(aggregate, row, features,                                                                    \
      "merges the recesses of a row into one strip, or a feature and the features on it into one " \
      "block",                                                                                     \
      {"into", "word", "the result", {"strip", "block"}},                                          \
      {"gap", "length", "the least distance to neighbours"})                                       \
  ROW(collapse, feature, outlines, "leaves an outline without depth")                              \
  ROW(displace, wall, features, "moves the openings of a wall apart until gaps are wide enough",   \
      {"to", "length", "the least width"}, {"gap", "length", "the least distance to neighbours"})  \
  ROW(enlarge, feature, features, "makes the feature large enough to be seen",                     \
      {"to", "length", "the least width and height"},                                              \
      {"anchor", "word", "what stays in place", {"centre", "sill"}},                               \
      {"gap", "length", "the least distance to neighbours"})                                       \
  ROW(flatten, feature, facets,                                                                    \
      "absorbs a thin feature into its facet, which moves if the feature covers most of it")       \
  ROW(merge, feature, features, "makes the feature part of its host")                              \
  ROW(symbolise, feature, features, "replaces the feature with a template",                        \
      {"with", "word", "the template", {"chimney_block", "dormer_box", "balcony_box"}},            \
      {"to", "length", "the least length of its sides"},                                           \
      {"gap", "length", "the least distance to neighbours"})                                       \
  ROW(typify, row, features, "replaces the recesses of a row with fewer ones",                     \
      {"ratio", "ratio", "the share that stays"},                                                  \
      {"gap", "length", "the least distance to neighbours"})
