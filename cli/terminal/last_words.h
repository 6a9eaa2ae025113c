#pragma once

namespace oriel::cli {

/// From now on memory that runs out is std::bad_alloc, which main() reports (E507). Before, from
/// the first moment of the process on, it ends the program with exit code 1 and a fixed sentence,
/// for which nothing is allocated. An exception that nobody can catch (in a destructor, a thread, a
/// handler) ends it in the same way; a forked worker that is not out of memory ends by SIGABRT.
void begin_to_throw_without_memory();

/// Says that memory is used up (E507) in a fixed sentence, deletes temporary files of outputs, and
/// ends the program with exit code 1. A forked worker leaves the files to its parent.
[[noreturn]] void end_without_memory() noexcept;

}  // namespace oriel::cli
