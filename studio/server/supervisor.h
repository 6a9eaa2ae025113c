#pragma once

#include "studio/session/work_log.h"

#include <functional>

namespace oriel::studio {

/// What runs in a worker, until the process ends. `is_careful`: one thing after the other, since it
/// is not known which of several ended the last worker.
using StudioWork = std::function<void(WorkLog& log, bool is_careful)>;

enum class Ending {
  /// SIGINT, SIGTERM or SIGHUP.
  asked,
  /// Workers ended several times in a short while, and no building is to blame.
  hopeless,
};

/// Runs `work` in a forked worker, and again where the worker ends. The file or building at which a
/// fault ended it is passed over from then on (WorkLog::why_passed_over), which is a line of the
/// log "studio". Returns when it is asked to end by a signal, or starting again is no use; the
/// worker has ended then. If the supervisor is killed, its worker ends, too. The calling process
/// has one thread. Throws std::system_error if the system gives no process.
Ending supervise(const StudioWork& work);

}  // namespace oriel::studio
