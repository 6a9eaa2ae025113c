#pragma once

#include <functional>

namespace oriel::cli {

/// Calls `work`, whose TBB algorithms then have `jobs` threads, also where there are fewer cores.
/// Where memory is used up the program ends with E507 (end_without_memory); other exceptions of
/// `work` are passed on.
void in_arena(int jobs, const std::function<void()>& work);

}  // namespace oriel::cli
