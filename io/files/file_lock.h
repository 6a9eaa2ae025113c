#pragma once

#include <string>

namespace oriel {

/// Opens a file or folder with `flags` and locks it until the descriptor, and
/// those made of it, are closed, or the process ends. Waits for a short while if another process
/// has the lock; -1 and errno EWOULDBLOCK if that process goes on. The file has this name when it
/// is locked. File systems without locks: it is only opened.
int open_locked(const std::string& path, int flags);

}  // namespace oriel
