#include "kernel/base/text/json_text.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck.h>

namespace oriel::detail {
namespace {

TEST_SUITE("kernel/base") {
  TEST_CASE("any bytes make a JSON string and UTF-8 survives") {
    CHECK(rc::check([](const std::string& bytes) {
      std::string text;
      append_json(text, std::string_view(bytes));
      RC_ASSERT(nlohmann::json::accept(text));
    }));
    std::string text;
    append_json(text, std::string_view("caf\u00e9 \"\\\n"));
    CHECK(text == "\"caf\u00e9 \\\"\\\\\\u000a\"");
    text.clear();
    append_json(text, std::string_view("a\xE9z"));
    CHECK(text == "\"a\xEF\xBF\xBDz\"");
  }

  TEST_CASE("a byte that is escaped is found at every place of a text of any length") {
    for (std::size_t size = 1; size < 20; ++size)
      for (std::size_t place = 0; place < size; ++place)
        for (const char c : {'"', '\\', '\n', '\0', '\x1f', '\x7f', ' ', '\x80', '\xff'}) {
          std::string bytes(size, 'a');
          bytes[place] = c;
          std::string text;
          append_json(text, std::string_view(bytes));
          const auto parsed = nlohmann::json::parse(text).get<std::string>();
          CHECK((parsed == bytes) == (static_cast<unsigned char>(c) < 0x80U));
        }
  }

  TEST_CASE("numbers read back to the same double and what is not finite is null") {
    CHECK(rc::check([](double number) {
      std::string text;
      append_json(text, number);
      if (std::isfinite(number)) RC_ASSERT(nlohmann::json::parse(text).get<double>() == number);
    }));
    CHECK(shortest(5403766.115) == "5403766.115");
    std::string text;
    append_json_array(text, std::vector<double>{0.1, std::numeric_limits<double>::infinity()});
    CHECK(text == "[0.1,null]");
  }
}

}  // namespace
}  // namespace oriel::detail
