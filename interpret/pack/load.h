#pragma once

#include "interpret/pack/extend.h"
#include "interpret/pack/pack.h"
#include "kernel/base/issue.h"

#include <memory>
#include <string>
#include <vector>

namespace oriel::rules {

/// The pack in `text`, put over those that it extends, or null if it has errors; `issues` is set to
/// all findings. `file` names it in places.
std::shared_ptr<const Pack> load(std::string text, std::string file, const PackFinder& find,
                                 std::vector<Issue>& issues);

/// Takes the mark away that some editors put before UTF-8.
void drop_byte_order_mark(std::string& text);

}  // namespace oriel::rules
