#pragma once

#include <cstddef>
#include <functional>

namespace oriel::bench {

/// How many bytes more than before are allocated with `new` at most while `work` runs, as the
/// allocator rounds them. What `malloc` gives to libraries (GMP) is not counted. One thread.
std::size_t peak_bytes_of(const std::function<void()>& work);

}  // namespace oriel::bench
