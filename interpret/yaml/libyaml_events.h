#pragma once

#include <string_view>

namespace YAML {
class EventHandler;
}

namespace oriel::rules {

/// Tells `events` of the document `text` what yaml-cpp's parser would, with positions but without
/// lines and columns, by libyaml, in a fraction of its time. Only of YAML as packs are nearly
/// always written: one map, scalars on one line, plain or in quotes without escapes, comments. What
/// is wrong, or what the two may read in different ways, is left to yaml-cpp and its findings: then
/// it is false, and what was told is worth nothing.
bool read_by_libyaml(std::string_view text, YAML::EventHandler& events);

}  // namespace oriel::rules
