#include "kernel/base/indexed_vector.h"

#include <string>
#include <type_traits>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using Names = IndexedVector<PointId, std::string>;

TEST_SUITE("kernel/base") {
  TEST_CASE("a list gives each element the id by which it is found again") {
    Names names;
    const PointId first = names.push_back("a");
    const PointId second = names.emplace_back(2, 'b');
    CHECK(first == PointId{0});
    CHECK(names.next_id() == PointId{2});
    CHECK(names[second] == "bb");
    names[first] = "c";
    CHECK(names.items() == std::vector<std::string>{"c", "bb"});
  }

  TEST_CASE("the ids of a list are those of its elements in their order") {
    const IndexedVector<PointId, int> numbers{7, 8, 9};
    int sum = 0;
    for (const PointId id : numbers.ids()) sum = 10 * sum + numbers[id];
    CHECK(sum == 789);
    CHECK(numbers.contains(PointId{2}));
    CHECK_FALSE(numbers.contains(PointId{3}));
    CHECK_FALSE(numbers.contains(PointId{}));
  }

  TEST_CASE("ids between two leave out the second, and elements that go let others move up") {
    IndexedVector<PointId, int> numbers{7, 8, 9, 10};
    int sum = 0;
    for (const PointId id : ids_between(PointId{1}, PointId{3})) sum = 10 * sum + numbers[id];
    CHECK(sum == 89);
    for (const PointId id : ids_between(PointId{2}, PointId{2})) sum = id.value;
    CHECK(sum == 89);
    numbers.erase_if([](int number) { return number % 2 == 0; });
    CHECK(numbers.items() == std::vector<int>{7, 9});
  }

  TEST_CASE("a list is addressed by ids of its own kind only") {
    CHECK(std::is_invocable_v<decltype([](Names& n, auto i) -> decltype(n[i]) { return n[i]; }),
                              Names&, PointId>);
    CHECK_FALSE(
        std::is_invocable_v<decltype([](Names& n, auto i) -> decltype(n[i]) { return n[i]; }),
                            Names&, EdgeId>);
  }
}

}  // namespace
}  // namespace oriel
