#include "cli/batch/arena.h"

#include "cli/terminal/last_words.h"

#include <cstddef>
#include <new>
#include <oneapi/tbb/global_control.h>
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

}  // namespace oriel::cli
