#include "kernel/segment/boundary/body_state.h"

#include <cmath>

namespace oriel::detail {

namespace {

/// The bits of a number stirred, one to one (the finaliser of SplitMix64).
std::uint64_t mixed(std::uint64_t number) {
  number = (number ^ number >> 30U) * 0xbf58476d1ce4e5b9U;
  number = (number ^ number >> 27U) * 0x94d049bb133111ebU;
  return number ^ number >> 31U;
}

}  // namespace

BodyState state_of(const Boundary& body) {
  constexpr double kPerSquareMetre = 1e6;
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15U;  // spreads neighbouring numbers
  BodyState state{};
  for (int f = 0; f < body.facet_count(); ++f) {
    if (!body.is_alive(f)) continue;
    const auto side = static_cast<std::uint64_t>(body.facet(f).side);
    const auto area = static_cast<std::uint64_t>(std::llround(body.area(f) * kPerSquareMetre));
    const std::uint64_t facet = mixed(mixed(side * kOdd) + area);
    state[0] += facet;
    state[1] += mixed(facet + kOdd);
  }
  return state;
}

bool is_mostly_dead(const Boundary& body) {
  constexpr int kTimes = 16;  // so often the body is copied no more than it has lost
  constexpr int kFew = 64;    // half-edges that cost nothing
  const int all = body.half_edge_count(), living = all - body.dead_edge_count();
  return all > kFew && all > kTimes * living;
}

bool is_convex(const Boundary& body, int& bend) {
  const int size = body.half_edge_count(), start = bend;
  for (int i = 0; i < size; ++i) {
    bend = start + i < size ? start + i : start + i - size;
    if (body.is_alive_edge(bend) && bend < body.twin(bend) && body.is_reflex(bend)) return false;
  }
  return true;
}

}  // namespace oriel::detail
