// simdjson: reads CityJSON, about 14 times as fast as nlohmann-json.
// Trap: its strings and values are views into the parser's buffers: they die with the next
// document. Trap: 17 and 17.0 are different types: get_double takes both, get_int64 refuses the
// second.
#include <cstdio>
#include <string>

#include <simdjson.h>

int main() {
  simdjson::dom::parser parser;
  const auto read = [&](std::string_view text) {
    return simdjson::dom::element(parser.parse(text.data(), text.size()));
  };
  const simdjson::dom::element file =
      read(R"({"transform":{"scale":[0.001,0.001,1]},"vertices":[[17,2,3.0]]})");

  double sum = 0;
  for (const simdjson::dom::element number : file.at_pointer("/vertices/0").get_array())
    sum += number.get_double();
  std::int64_t whole = 0;
  const bool is_17_whole = file.at_pointer("/vertices/0/0").get(whole) == simdjson::SUCCESS;
  const bool is_3_whole = file.at_pointer("/vertices/0/2").get(whole) == simdjson::SUCCESS;

  // Keep a copy of what shall outlive the document, here a name that is read over.
  const std::string kept(read(R"({"name":"house"})")["name"].get_string().value());
  read(R"({"name":"tower"})");
  std::printf("sum %g, 17 is %s, 3.0 is %s, kept: %s\n", sum, is_17_whole ? "whole" : "not",
              is_3_whole ? "whole" : "not", kept.c_str());
  return sum == 22 && is_17_whole && !is_3_whole && kept == "house" ? 0 : 1;
}
