#include "kernel/base/issue.h"
#include "oriel/series.h"
#include "tests/cli/command.h"

#include <array>
#include <cstddef>
#include <map>
#include <random>
#include <string>

#include <doctest/doctest.h>

namespace {

/// The text with a byte changed, a line less, its end cut off, or a line twice.
std::string damaged(const std::string& text, std::size_t how, std::mt19937& random) {
  std::string out = text;
  const std::size_t at = random() % (text.size() - 1);
  const std::size_t line = text.rfind('\n', at) + 1, after = text.find('\n', at);
  if (how % 4 == 0) out[at] = static_cast<char>(out[at] ^ (1 << random() % 7));
  if (how % 4 == 1) out.erase(line, after - line + 1);
  if (how % 4 == 2) out.erase(at);
  if (how % 4 == 3) out.insert(line, text.substr(line, after - line + 1));
  return out;
}

}  // namespace

TEST_SUITE("oriel") {
  TEST_CASE("a thousand damaged series are refused with a place") {
    using oriel::check_series;
    using oriel::test::bytes_of;
    using oriel::test::run;
    const oriel::test::Folder folder;
    REQUIRE(run({"generalise", oriel::test::sample("block"), "--series", "1:500,1:2500,1:10000",
                 "-o", folder / "s"})
                .exit == 0);
    const std::string name = folder / "s";
    REQUIRE(check_series(name).holds);
    const std::array<std::string, 4> files{"s.oplog.jsonl", "s.1-500.city.json",
                                           "s.1-2500.city.json", "s.1-10000.city.json"};
    std::map<std::string, std::string> whole;
    for (const std::string& file : files) whole[file] = bytes_of(folder / file);
    std::mt19937 random(1);
    for (std::size_t i = 0; i < 1000; ++i) {
      const std::string& file = files[i % 4];
      // Every fiftieth is another level of the same series.
      const std::string text =
          i % 50 == 49 ? whole[files[1 + (i / 50) % 3]] : damaged(whole[file], i / 4, random);
      if (text == whole[file]) continue;
      folder.write(file, text);
      CAPTURE(i);
      CAPTURE(file);
      try {
        CHECK_FALSE(check_series(name).holds);
      } catch (const oriel::InputError& refused) {
        // A first line that is cut has no check, and is no operation either.
        const oriel::Code code = refused.issue().code;
        CHECK((code == oriel::Code::E132 || code == oriel::Code::E119));
        CHECK(refused.issue().place.file == folder / file);
      }
      folder.write(file, whole[file]);
    }
    CHECK(check_series(name).holds);
  }
}
