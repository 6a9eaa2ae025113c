#include "cli/batch/status.h"

#include "cli/batch/result_cache.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/targets.h"

namespace oriel::fuzz {

/// The status of an earlier run, which merge and --resume read, and from which --reuse takes
/// results: what is of no use is a warning there.
void status(std::string_view bytes) {
  static const ScratchFile file("a.status.json"), stem("b");
  const cli::ResultCache cache(file.write(bytes), stem.path(), "recipe");
  promise(cache.fault().has_value(), "nothing is taken from a run of another recipe");
  (void)to_string(*cache.fault());
  try {
    (void)cli::run_sha256(cli::read_status(file.path()), "");
  } catch (const InputError& error) {
    (void)to_string(error.issue());
  }
}

}  // namespace oriel::fuzz
