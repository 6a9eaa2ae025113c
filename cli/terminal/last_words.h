#pragma once

#include <string>

namespace oriel::cli {

/// From now on memory that runs out is std::bad_alloc, which main() reports (E507). Before, from
/// the first moment of the process on, it ends the program with exit code 1 and a fixed sentence,
/// for which nothing is allocated. An exception that nobody can catch (in a destructor, a thread, a
/// handler) ends it in the same way; a forked worker that is not out of memory ends by SIGABRT.
void begin_to_throw_without_memory();

/// Says that memory is used up (E507) in a fixed sentence, deletes temporary files of outputs, and
/// ends the program with exit code 1. A forked worker leaves the files to its parent.
[[noreturn]] void end_without_memory() noexcept;

/// Keeps lines ready for say_last_words(), in place of those kept before: what has been found so
/// far and is otherwise reported only at the end of the run.
void keep_last_words(std::string lines);

/// Writes the lines kept to stderr, once. For the moment when the run ends at once, by a signal or
/// without memory: nothing is allocated or locked, so that a handler of signals may call it. A
/// forked worker says nothing.
void say_last_words() noexcept;

}  // namespace oriel::cli
