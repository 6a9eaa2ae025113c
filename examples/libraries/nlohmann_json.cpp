// nlohmann-json: JSON on cold paths (small reports, tests).
// Trap: `json` sorts the keys of objects; `ordered_json` keeps them as they were written.
// Trap: a duplicate key silently replaces the first; operator[] on a missing key of a const object
// is undefined, at() throws.
#include <iostream>
#include <string>

#include <nlohmann/json.hpp>

int main() {
  const std::string text = R"({"type":"CityJSON","version":"2.0","CityObjects":{}})";
  const std::string sorted = nlohmann::json::parse(text).dump();
  const std::string kept = nlohmann::ordered_json::parse(text).dump();
  std::cout << "json:         " << sorted << "\nordered_json: " << kept << '\n';

  const auto twice = nlohmann::json::parse(R"({"id":1,"id":2})");
  bool is_missing_reported = false;
  try {
    twice.at("name");
  } catch (const nlohmann::json::out_of_range& error) {
    std::cout << error.what() << '\n';
    is_missing_reported = true;
  }
  return kept == text && sorted != text && twice["id"] == 2 && is_missing_reported ? 0 : 1;
}
