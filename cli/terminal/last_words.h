#pragma once

namespace oriel::cli {

/// From now on memory that runs out is std::bad_alloc, which main() reports (E507). Before, from
/// the first moment of the process on, it ends the program with exit code 1 and a fixed sentence,
/// for which nothing is allocated. An exception that nobody catches ends it in the same way, and
/// takes the temporary files with it.
void begin_to_throw_without_memory();

/// Writes "error: E507 …" to stderr, without allocating anything.
void say_memory_is_used_up() noexcept;

}  // namespace oriel::cli
