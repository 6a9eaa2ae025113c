#include "cli/batch/arena.h"

#include "cli/terminal/last_words.h"

#include <cstddef>
#include <new>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace oriel::cli {

void in_arena(int jobs, const std::function<void()>& work) {
  // Else TBB takes no more threads than there are cores, and says so on stderr.
  const tbb::global_control more_than_cores(tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(jobs));
  tbb::task_arena arena(jobs);
  // Where it lacked memory for itself, TBB waits for ever when its arena goes.
  try {
    arena.execute(work);
  } catch (const std::bad_alloc&) {
    end_without_memory();
  }
}

SharesInArena shares_in_arena(int jobs) {
  return [jobs](std::size_t count, const std::function<void(std::size_t)>& work) {
    if (jobs > 1)
      in_arena(jobs, [&] { tbb::parallel_for(std::size_t{0}, count, work); });
    else
      for (std::size_t i = 0; i < count; ++i) work(i);
  };
}

}  // namespace oriel::cli
