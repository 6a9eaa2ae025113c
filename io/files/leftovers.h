#pragma once

#include <string>

namespace oriel::detail {

/// What the temporary file of an output is called: NAME.tmp-PID-N beside NAME.
std::string temporary_name(const std::string& target, int number);

/// Locks the temporary file that is open as `descriptor`, so that no other run takes it for a
/// leftover; the lock ends with the last descriptor of the open file, also when the process is
/// killed. False if another run removed the file before it was locked: then it is of no use. File
/// systems without locks: true, and nobody can remove it there.
bool lock_temporary(int descriptor);

/// Removes the temporary files of runs that were killed while they wrote `target`: regular files of
/// exactly that form of name that nobody has locked. The number of the process says nothing: it may
/// be used again, and containers that share a folder have the same ones. What cannot be removed
/// stays. A folder is listed once in a process.
void remove_leftovers(const std::string& target);

}  // namespace oriel::detail
