#pragma once

#include <cstddef>
#include <functional>

namespace oriel::cli {

/// Calls `work`, whose TBB algorithms then have `jobs` threads, also where there are fewer cores.
/// Where memory is used up the program ends with E507 (end_without_memory); other exceptions of
/// `work` are passed on.
void in_arena(int jobs, const std::function<void()>& work);

/// Calls work(0) … work(count - 1), each once, on so many threads; the library's ForEachShare.
using SharesInArena =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;
SharesInArena shares_in_arena(int jobs);

}  // namespace oriel::cli
