// oneTBB: buildings are worked on in parallel and written in the order they were read.
// Trap: a sum of doubles by parallel_reduce depends on how the range was split;
// parallel_deterministic_reduce gives the same bits with any number of threads.
#include <cstdio>
#include <functional>
#include <tbb/blocked_range.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/parallel_reduce.h>
#include <vector>

int main() {
  constexpr int count = 1000;
  int next = 0;
  std::vector<int> written;
  const auto read = [&](tbb::flow_control& control) {
    if (next == count) control.stop();
    return next++;
  };
  tbb::parallel_pipeline(
      8, tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, read) &
             tbb::make_filter<int, int>(tbb::filter_mode::parallel, [](int i) { return i * i; }) &
             tbb::make_filter<int, void>(tbb::filter_mode::serial_in_order,
                                         [&](int square) { written.push_back(square); }));
  bool is_in_order = written.size() == count;
  for (int i = 0; i < count && is_in_order; ++i)
    is_in_order = written[static_cast<std::size_t>(i)] == i * i;

  const auto sum = [] {
    const auto add = [](const tbb::blocked_range<int>& range, double value) {
      for (int i = range.begin(); i < range.end(); ++i) value += 1.0 / i;
      return value;
    };
    return tbb::parallel_deterministic_reduce(tbb::blocked_range<int>(1, 1'000'000, 1000), 0.0, add,
                                              std::plus<>());
  };
  std::printf("%zu results %s order\n", written.size(), is_in_order ? "in" : "out of");
  return is_in_order && sum() == sum() ? 0 : 1;
}
