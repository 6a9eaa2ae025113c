#include "io/json/raw_json.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck.h>

namespace oriel::detail {
namespace {

/// Some JSON value of bounded depth, with blanks around its parts.
rc::Gen<std::string> any_value(int depth) {
  const auto blank = rc::gen::element<std::string>("", " ", "\n\t", "\r\n");
  const auto leaf =
      rc::gen::element<std::string>("0", "-1.50e+3", "true", "null", "\"\"", "\"a\\\"]}{,\\\\\"",
                                    "\"\\u00e9\"", "[]", "{}", "[ ]", "{\n}");
  if (depth == 0) return leaf;
  const auto part = rc::gen::apply(
      [](const std::string& a, const std::string& v, const std::string& b) { return a + v + b; },
      blank, any_value(depth - 1), blank);
  const auto parts = rc::gen::resize(4, rc::gen::container<std::vector<std::string>>(part));
  return rc::gen::apply(
      [](const std::vector<std::string>& values, bool is_object) {
        std::string text(1, is_object ? '{' : '[');
        for (std::size_t i = 0; i < values.size(); ++i) {
          if (i > 0) text += ',';
          if (is_object) text += " \"k" + std::to_string(i) + "\" :";
          text += values[i];
        }
        return text + (is_object ? '}' : ']');
      },
      parts, rc::gen::arbitrary<bool>());
}

TEST_SUITE("io") {
  TEST_CASE("slices put together again are the same bytes") {
    CHECK(rc::check([] {
      const std::string text = *any_value(3);
      RC_ASSERT(end_of_value(text + ", 1", 0) == text.size());
      if (!RawNode::is_object(text) && !RawNode::is_array(text)) return;
      const RawNode node(text);
      RC_ASSERT(node.text() == text);
      const auto parsed = nlohmann::json::parse(text);
      RC_ASSERT(node.size() == parsed.size());
      for (std::size_t i = 0; i < node.size(); ++i)
        RC_ASSERT(nlohmann::json::parse(node.value(i)) ==
                  (parsed.is_object() ? parsed.at(node.key(i)) : parsed.at(i)));
    }));
  }

  TEST_CASE("arrays whose ends are known are passed over and nothing else changes") {
    const std::string text =
        R"({"a":[[1,2],[3]] ,"b":{"c":"]","d":[ [4,5,6,7,8,9,10,11,12] ],"e":[]},"f":[13]})";
    std::vector<std::string_view> known;
    for (const std::string_view array : {"[[1,2],[3]]", "[4,5,6,7,8,9,10,11,12]", "[13]"})
      known.push_back(std::string_view(text).substr(text.find(array), array.size()));
    const RawNode node(text, known), plain(text);
    REQUIRE(node.size() == plain.size());
    for (std::size_t i = 0; i < node.size(); ++i) CHECK(node.value(i) == plain.value(i));
    CHECK(node.text() == text);
    const RawNode inner(node.value_of("b"), known);
    CHECK(inner.value_of("d") == "[ [4,5,6,7,8,9,10,11,12] ]");
    CHECK(inner.value_of("e") == "[]");
    // Those of another text do not count.
    const std::string other = text;
    CHECK(RawNode(other, known).value_of("f") == "[13]");
  }

  TEST_CASE("arrays in an array of numbers are its elements wherever they stand") {
    for (const std::string text :
         {"[]", "[ [[1,2,3]] ,[[4,5,6],[7]],\n[[8]]]", "[[1]]",
          "[[[1,2,3,4,5]],[[10,11,12,13],[14,15,16]] , [ ],[[100000,200000,300000,400000]]]"}) {
      std::vector<std::string_view> arrays;
      append_arrays_in(text, arrays);
      CHECK(arrays == elements_of(text));
    }
  }

  TEST_CASE("members are replaced and added and erased without touching the others") {
    RawNode node(R"({ "a" : 1.0 ,"b":[2],"a":3 })");
    CHECK(node.value_of("a") == "1.0");
    node.set("a", "7");
    node.set("c\"", "null");
    CHECK(node.text() == R"({ "a" : 7 ,"b":[2],"a":3 ,"c\"":null})");
    node.erase("b");
    CHECK_FALSE(node.find("b"));
    CHECK(node.text() == R"({ "a" : 7 ,"a":3 ,"c\"":null})");
    CHECK(node.value_of("c\"") == "null");
  }

  TEST_CASE("what became of a member is written in its place as its text would be") {
    RawNode node(R"({ "a" : [1, {"b":2} ] ,"c":3})");
    RawNode array(node.value_of("a")), inner(array.value(1));
    inner.set("b", "4");
    inner.append("d", "5");
    array.set(1, std::move(inner));
    node.set("a", std::move(array));
    CHECK(node.text() == R"({ "a" : [1, {"b":4,"d":5} ] ,"c":3})");
    CHECK(node.value_of("a") == R"([1, {"b":2} ])");
    node.set("a", "6");
    CHECK(node.text() == R"({ "a" : 6 ,"c":3})");
  }

  TEST_CASE("elements are appended to an empty array") {
    RawNode node("[ ]");
    CHECK(node.text() == "[ ]");
    node.push_back("1");
    node.push_back("2");
    CHECK(node.text() == "[1,2]");
    node.erase(0);
    CHECK(node.text() == "[2]");
  }

  TEST_CASE("keys are found by what they mean") {
    const RawNode node(R"({"a\u0062":1})");
    CHECK(node.value_of("ab") == "1");
    CHECK(node.key(0) == "ab");
  }
}

}  // namespace
}  // namespace oriel::detail
