#include "cli/batch/resume.h"
#include "cli/batch/status.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/targets.h"

#include <nlohmann/json.hpp>

namespace oriel::fuzz {

/// The journal of a run that goes on, as far as it is only read: what it names is left alone. The
/// command makes an E117 of an exception of JSON.
void journal(std::string_view bytes) {
  static const ScratchFile file("a.journal");
  try {
    cli::Journal journal(file.write(bytes));
    const auto state = journal.load();
    (void)cli::to_json(journal.done());
    (void)cli::to_json(journal.read());
    if (!state) return;
    (void)cli::journal_state_of(*state);
    const cli::RunState run = cli::run_state_of(*state);
    const auto json = cli::to_json(run);
    promise(cli::to_json(cli::run_state_of(json)) == json, "a state there and back is the same");
  } catch (const InputError& error) {
    (void)to_string(error.issue());
  } catch (const nlohmann::ordered_json::exception&) {
  }
}

}  // namespace oriel::fuzz
