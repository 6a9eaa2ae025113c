#pragma once

#include <cstddef>

#include <boost/container/small_vector.hpp>

namespace oriel::detail {

/// A vector of mostly no more than N, which then takes no memory of its own: a facet has one loop
/// most of the time, a vertex three planes, and allocating them was a third of all the work.
template <class T, std::size_t N>
using Few = boost::container::small_vector<T, N>;

}  // namespace oriel::detail
