#include "kernel/segment/planes/margins.h"

#include "kernel/segment/sections/nearly_sorted.h"

#include <algorithm>
#include <functional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using detail::Margins;

TEST_SUITE("kernel/segment") {
  TEST_CASE("margins are used up at the slots and steps at which a plain list says so") {
    std::mt19937 random(7);
    for (const std::size_t slots : {1U, 2U, 5U, 64U, 77U}) {
      Margins margins(slots);
      std::vector<double> plain(slots, Margins::kNone);
      std::size_t spent = 0;
      for (int step = 0; step < 500; ++step) {
        const std::size_t p = random() % slots, q = random() % (slots + 1);
        if (step % 3 == 0) {
          const double margin = 1 + random() % 40;
          margins.set(p, margin);
          plain[p] = margin;
        } else {
          const double area = 1 + random() % 5;
          margins.take_off(p, q, area);
          for (std::size_t i = p; i < q; ++i) plain[i] -= area;
        }
        std::vector<char> is_spent(slots, 0);
        margins.take_out_spent([&](std::size_t i) { is_spent[i] = 1; });
        for (std::size_t i = 0; i < slots; ++i) {
          CHECK((plain[i] <= 0) == (is_spent[i] != 0));
          if (plain[i] > 0) continue;
          plain[i] = Margins::kNone;
          ++spent;
        }
      }
      CHECK(spent > 10);
    }
  }

  TEST_CASE("what stands in order or backwards or anyhow is sorted") {
    std::mt19937 random(11);
    for (const unsigned swaps : {0U, 3U, 1000U})
      for (const bool is_backwards : {false, true}) {
        std::vector<int> items;
        for (int i = 0; i < 200; ++i) items.push_back(is_backwards ? 200 - i : i);
        for (unsigned i = 0; i < swaps; ++i)
          std::swap(items[random() % items.size()], items[random() % items.size()]);
        detail::sort_nearly_sorted(std::span(items), std::less{});
        CHECK(std::ranges::is_sorted(items));
      }
  }
}

}  // namespace
}  // namespace oriel
