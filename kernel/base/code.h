#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

/// Every code that a finding can have: X(code, the number of val3dity's error that means the same
/// or 0, what the code means), sorted. A code never changes its meaning and is never used again.
/// Each has a section with this title in docs/errors.md, or in docs/rules.md for rule packs; those
/// of profiles, R272 to R279, are in docs/generalisation.md, and those of experiments, R28x, in
/// docs/experiments.md.
///
/// E1xx the text of a file, E2xx the building model, E3xx geometry, E5xx limits, E6xx output, E9xx
/// ours, G4xx operators of generalisation, R2xx rules.
// clang-format off
#define ORIEL_CODES(X) \
  X(E101, 0, "The file cannot be read") \
  X(E102, 0, "The file is empty") \
  X(E103, 0, "Not UTF-8") \
  X(E104, 0, "Not valid JSON") \
  X(E105, 0, "Truncated") \
  X(E106, 0, "Unknown format") \
  X(E107, 0, "Not the format that the name says") \
  X(E108, 0, "CityJSON version") \
  X(E109, 0, "OBJ syntax") \
  X(E110, 0, "OFF syntax") \
  X(E111, 0, "Feature records") \
  X(E112, 0, "Truth file") \
  X(E113, 0, "Not valid XML") \
  X(E114, 0, "A document type declaration") \
  X(E115, 0, "CityGML version") \
  X(E116, 0, "A different header") \
  X(E117, 0, "The run cannot be resumed") \
  X(E118, 0, "Shards do not make up the whole") \
  X(E119, 0, "A line of a series' log that cannot be read") \
  X(E120, 0, "A file that is not a level of a series") \
  X(E121, 0, "A relation to a feature that is not in the table") \
  X(E123, 0, "A worker was ended") \
  X(E124, 0, "An earlier run that cannot be reused") \
  X(E125, 0, "Not a scale") \
  X(E126, 0, "The input is noisy") \
  X(E127, 0, "There is no building to show") \
  X(E128, 0, "No building to show after the change") \
  X(E129, 0, "A building that is in none of the models") \
  X(E130, 0, "The selection matches nothing") \
  X(E131, 0, "Nothing to compare with the truth") \
  X(E132, 0, "A file of a series was changed") \
  X(E133, 0, "A log of a series without checks") \
  X(E134, 0, "Nothing to work on") \
  X(E140, 0, "Something that cannot be added") \
  X(E141, 0, "No room for what is added") \
  X(E150, 0, "Runs of different buildings") \
  X(E151, 0, "A column that the rules read is missing") \
  X(E152, 0, "A correction that cannot be read") \
  X(E153, 0, "A correction of something that is not there") \
  X(E154, 0, "Corrections that contradict each other") \
  X(E155, 0, "A correction with an old feature id") \
  X(E160, 0, "An unknown coordinate reference system") \
  X(E161, 0, "No coordinate reference system") \
  X(E162, 0, "Heights without a reference") \
  X(E163, 0, "Buildings too far apart") \
  X(E164, 0, "The folder is not empty") \
  X(E165, 0, "Attributes of one name that differ in type") \
  X(E166, 0, "An installation that stays open") \
  X(E167, 0, "STL syntax") \
  X(E168, 0, "Objects that a format has no place for") \
  X(E169, 0, "No materials") \
  X(E170, 0, "No facade on that side") \
  X(E171, 0, "No pictures in this build") \
  X(E175, 0, "Buildings that overlap") \
  X(E176, 0, "A building inside another") \
  X(E177, 0, "Neighbours in another reference system") \
  X(E178, 0, "Walls that nearly touch") \
  X(E179, 0, "Two buildings with one id") \
  X(E190, 0, "Ground to be kept free that cannot be read") \
  X(E191, 0, "A building on ground that is kept free") \
  X(E192, 0, "Ground to be kept free in another place") \
  X(E201, 0, "A member is missing") \
  X(E202, 0, "A member has the wrong type") \
  X(E203, 0, "A vertex that does not exist") \
  X(E204, 0, "Unknown geometry type") \
  X(E205, 0, "No geometry at this level of detail") \
  X(E206, 0, "Geometry templates are not read") \
  X(E207, 0, "The id occurs twice") \
  X(E208, 0, "Semantics do not fit the geometry") \
  X(E209, 0, "No building, or a building without geometry") \
  X(E210, 0, "Coordinates that cannot be read") \
  X(E211, 0, "A link that leads out of the building") \
  X(E212, 0, "Links that form a cycle") \
  X(E213, 0, "Coordinates in degrees") \
  X(E214, 0, "Geometry that is not checked") \
  X(E215, 0, "Several geometries at one level of detail") \
  X(E301, 301, "Too few polygons") \
  X(E302, 302, "The shell is not closed") \
  X(E303, 303, "Polygons that do not pair up at an edge") \
  X(E304, 0, "Degenerate polygons were dropped") \
  X(E305, 403, "An interior shell outside its solid") \
  X(E307, 307, "Polygons that cannot be oriented consistently") \
  X(E308, 307, "Polygons were turned round") \
  X(E309, 0, "Facets were absorbed") \
  X(E310, 0, "A shell without volume") \
  X(E311, 101, "A ring of fewer than three distinct points") \
  X(E312, 102, "A vertex twice in a row") \
  X(E313, 902, "A geometry without polygons") \
  X(E314, 103, "A ring that is not closed") \
  X(E315, 0, "Polygons left out of the solid") \
  X(E316, 0, "Holes were closed") \
  X(E317, 0, "Vertices inserted into edges, duplicates dropped") \
  X(E318, 0, "A repaired solid that is not valid") \
  X(E319, 0, "Faces that are assumed") \
  X(E320, 0, "Installations left out of the solid") \
  X(E321, 0, "Passed on unchanged and not valid") \
  X(E341, 104, "A ring that crosses itself") \
  X(E342, 201, "Rings that cross") \
  X(E343, 202, "Rings that are the same") \
  X(E344, 203, "A polygon that is not planar") \
  X(E345, 204, "A polygon that is folded") \
  X(E346, 205, "A polygon in pieces") \
  X(E347, 206, "An inner ring outside the outer one") \
  X(E348, 207, "An inner ring in another one") \
  X(E349, 208, "An inner ring that runs the same way round as the outer one") \
  X(E350, 303, "Polygons that meet only in a point") \
  X(E351, 305, "A shell in pieces") \
  X(E352, 306, "A shell that crosses itself") \
  X(E353, 401, "Shells of a solid that cross") \
  X(E354, 402, "A cavity given twice") \
  X(E355, 404, "A solid in pieces") \
  X(E356, 501, "Solids that overlap") \
  X(E357, 502, "A solid given twice") \
  X(E358, 503, "Solids that are not connected") \
  X(E359, 601, "Building parts that overlap") \
  X(E501, 0, "The building is too large") \
  X(E502, 0, "The work budget is used up") \
  X(E503, 0, "Nested too deep") \
  X(E504, 0, "A number out of range") \
  X(E505, 0, "The record is too large") \
  X(E506, 0, "A coordinate is out of range") \
  X(E507, 0, "Memory is used up") \
  X(E601, 0, "The output cannot be written") \
  X(E602, 0, "A file is named twice") \
  X(E604, 0, "The file exists already") \
  X(E901, 0, "A fault of oriel's own") \
  X(G401, 0, "A feature is not omitted") \
  X(G402, 0, "No closed solid would be left") \
  X(G403, 0, "An operator's result does not fit") \
  X(G404, 0, "An open building is not redrawn") \
  X(G405, 0, "An operation was undone") \
  X(G406, 0, "No block can be made") \
  X(G407, 0, "Simpler blocks than asked for") \
  X(G408, 0, "A change at a smaller scale is left out") \
  X(G409, 0, "A level and the log of its series do not fit") \
  X(G410, 0, "Not valid as it would be written") \
  X(G411, 0, "It carries a part that stays") \
  X(G412, 0, "The building would reach further") \
  X(G413, 0, "Neither input nor output is valid") \
  X(G414, 0, "Options that allow no series") \
  X(G415, 0, "Edges shorter than asked for") \
  X(G416, 0, "Gaps narrower than asked for") \
  X(G417, 0, "A solid that passes through itself is mended first") \
  X(G418, 0, "A piece would be torn off") \
  X(G419, 0, "A building that was not valid is redrawn") \
  X(G420, 0, "An open building is repaired first") \
  X(G421, 0, "Buildings that became one") \
  X(G422, 0, "A group that stays as it was") \
  X(G423, 0, "Neighbours of different heights") \
  X(G424, 0, "Decor that could not follow its opening") \
  X(G440, 0, "A block that would cover ground to be kept free") \
  X(R200, 0, "The pack cannot be read") \
  X(R201, 0, "Not YAML") \
  X(R202, 0, "A key occurs twice") \
  X(R203, 0, "Anchors, aliases, tags, several documents") \
  X(R204, 0, "Unknown attribute") \
  X(R205, 0, "Unknown class") \
  X(R206, 0, "Unknown param") \
  X(R207, 0, "Unknown relation") \
  X(R208, 0, "Unknown macro") \
  X(R209, 0, "Unknown key") \
  X(R210, 0, "A key is missing") \
  X(R211, 0, "Wrong type of value") \
  X(R212, 0, "A value that is not allowed") \
  X(R213, 0, "Beyond the limits") \
  X(R214, 0, "A YAML trap") \
  X(R216, 0, "A name that cannot be used") \
  X(R220, 0, "Syntax of an expression") \
  X(R221, 0, "An expression that no caret can point into") \
  X(R222, 0, "An expression that is too large") \
  X(R230, 0, "Dimensions that differ") \
  X(R231, 0, "A unit is missing") \
  X(R232, 0, "Wrong type in an expression") \
  X(R233, 0, "Unknown unit") \
  X(R234, 0, "A word that a text is never equal to") \
  X(R235, 0, "mm@map or `scale` outside `generalise:`") \
  X(R236, 0, "`self` or `other` out of reach") \
  X(R240, 0, "An id occurs twice") \
  X(R241, 0, "A param that is never used") \
  X(R242, 0, "A macro that is never used") \
  X(R243, 0, "Rules that depend on each other") \
  X(R244, 0, "A cycle in the class tree") \
  X(R245, 0, "A rule for a subclass does not ask for its predicate") \
  X(R246, 0, "`extends` that cannot be resolved") \
  X(R247, 0, "A macro that uses itself") \
  X(R248, 0, "A relation that is never used") \
  X(R249, 0, "A condition that a relation cannot have") \
  X(R250, 0, "Not a scale") \
  X(R251, 0, "Unknown operator") \
  X(R253, 0, "Unknown group") \
  X(R254, 0, "A rule that can never hold") \
  X(R255, 0, "A rule or an entry that never decides") \
  X(R256, 0, "Entries that overlap with different operators") \
  X(R257, 0, "Evidence that is never weighed") \
  X(R258, 0, "A label without `emit`") \
  X(R260, 0, "A verdict that is close") \
  X(R261, 0, "Labels that do not settle") \
  X(R270, 0, "A file of tests that tests nothing") \
  X(R271, 0, "`gap(members)` without members") \
  X(R272, 0, "Sizes of a profile that decide nothing, or twice") \
  X(R273, 0, "A class of a profile that the pack does not have") \
  X(R274, 0, "Sizes of a profile that do not form a chain") \
  X(R275, 0, "No such level of a profile") \
  X(R276, 0, "A form that a scale does not make") \
  X(R277, 0, "Groups without neighbours") \
  X(R278, 0, "Groups in tiles") \
  X(R279, 0, "Ground kept free without groups") \
  X(R280, 0, "A pattern that matches no file") \
  X(R281, 0, "A value beyond the range of its param") \
  X(R282, 0, "A split with nothing on one side") \
  X(R283, 0, "A class that the truth does not have") \
  X(R284, 0, "Truth of another building") \
  X(R285, 0, "A fold without an object of a class") \
  X(R286, 0, "Features older than their input") \
  X(R287, 0, "An experiment that measures nothing") \
  X(R288, 0, "Stored features that cannot be made anew") \
  X(R289, 0, "A building twice in a set")
// clang-format on

namespace oriel {

/// What kind of finding an Issue is. `none` is of an Issue that says something without a code.
enum class Code {
  none,
#define ORIEL_CODE(code, val3dity, meaning) code,
  ORIEL_CODES(ORIEL_CODE)
#undef ORIEL_CODE
};

/// "E101"; nothing for Code::none.
std::string to_string(Code code);

/// The code that has this text.
std::optional<Code> code_of(std::string_view text);

/// What `code` means, in a few words ("The file cannot be read"); nothing for Code::none.
std::string_view meaning_of(Code code);

/// The number of val3dity's error that means the same as `code`, or 0.
int val3dity_number(Code code);

/// All codes but Code::none, in the order of their texts.
std::span<const Code> all_codes();

/// True for E3xx: a finding about geometry.
bool is_about_geometry(Code code);

}  // namespace oriel
