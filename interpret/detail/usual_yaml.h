#pragma once

#include <string_view>

namespace YAML {
class EventHandler;
}

namespace oriel::rules {

/// Tells `events` of the document `text` what yaml-cpp's parser would, with positions but without
/// lines and columns, in a fraction of its time. Only of YAML as packs are nearly always written:
/// maps and lists in lines or in brackets, scalars on one line, plain or in quotes without escapes,
/// comments. Everything else, right or wrong, is left to yaml-cpp: then it is false, and what was
/// told is worth nothing.
bool read_usual_yaml(std::string_view text, YAML::EventHandler& events);

}  // namespace oriel::rules
