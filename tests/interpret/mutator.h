#pragma once

#include <iterator>
#include <random>
#include <string>
#include <string_view>

namespace oriel::test {

/// Changes a text in one of the ways that people and cats on keyboards do.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string mutated(std::string text) {
    const std::size_t changes = 1 + below(4);
    for (std::size_t i = 0; i < changes && !text.empty(); ++i) change(text);
    return text;
  }

 private:
  std::size_t below(std::size_t bound) { return random_() % bound; }

  void change(std::string& text) {
    static constexpr std::string_view kBytes = "[]{}:,#&*!|>'\"%@`$()~=<>.- \n\tayn019\x7f\xc3\xff";
    static constexpr std::string_view kWords[] = {" not ",  " exists(host where ",
                                                  "(",      " in [",
                                                  "1e9 m",  "mm@map",
                                                  " self.", " is ",
                                                  "1:50",   "\n  - ",
                                                  ": ",     "&a ",
                                                  "*a",     "!!str ",
                                                  "...",    "---\n",
                                                  "? ",     "$",
                                                  "count(", " .. "};
    const std::size_t at = below(text.size());
    switch (below(6)) {
      case 0:
        text[at] = kBytes[below(kBytes.size())];
        break;
      case 1:
        text.erase(at, 1 + below(12));
        break;
      case 2:
        text.insert(at, kWords[below(std::size(kWords))]);
        break;
      case 3:
        text.insert(below(text.size()), text.substr(at, below(200)));
        break;
      case 4:
        text.resize(at);
        break;
      default:
        text.insert(at, std::string(1 + below(80), kBytes[below(kBytes.size())]));
    }
  }

  std::mt19937 random_;
};

}  // namespace oriel::test
