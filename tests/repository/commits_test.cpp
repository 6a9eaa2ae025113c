#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

namespace {

/// The last commit whose subject had to follow no rule.
const std::string kBase = "5825f2871b44b6f1089e41f1a32ff6e5f1e0faa5";

constexpr int kMostCharacters = 60;

/// Calls git in the sources. Gives nothing if it fails or is not there.
std::optional<std::string> git(const std::string& arguments) {
  const std::string command = "git -C '" ORIEL_SOURCE_DIR "' " + arguments + " 2>/dev/null";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string output;
  std::array<char, 4096> block{};
  for (std::size_t n = 0; (n = std::fread(block.data(), 1, block.size(), pipe)) > 0;)
    output.append(block.data(), n);
  return ::pclose(pipe) == 0 ? std::optional(output) : std::nullopt;
}

/// Recognizes first words that give no order: articles, pronouns and the like, plurals and third
/// persons ("Tests", "Adds"), past tenses and participles ("Added", "Adding").
bool is_no_order(const std::string& word) {
  static const std::set<std::string> others{
      "The", "A",   "An",    "All",   "Each", "Every", "No",   "None", "Not",  "Some",
      "Any", "One", "Two",   "Both",  "It",   "Its",   "We",   "You",  "They", "He",
      "She", "I",   "This",  "That",  "What", "Which", "Who",  "Why",  "How",  "When",
      "Of",  "In",  "On",    "At",    "By",   "For",   "From", "To",   "With", "Without",
      "As",  "If",  "Where", "There", "And",  "Or",    "But",  "Only", "More", "Now"};
  static const std::set<std::string> orders{"Focus", "Bias", "Need",  "Feed",   "Embed", "Seed",
                                            "Speed", "Shed", "Bring", "String", "Exceed"};
  if (orders.contains(word)) return false;
  return others.contains(word) || word.ends_with("ing") || word.ends_with("ed") ||
         (word.ends_with("s") && !word.ends_with("ss"));
}

/// Says what is wrong with the form of a subject, nothing if it is right.
std::string fault_of(const std::string& subject) {
  if (subject.empty() || subject[0] < 'A' || subject[0] > 'Z') return "no upper case letter first";
  if (std::ranges::count_if(subject, [](char c) { return (c & 0xC0) != 0x80; }) > kMostCharacters)
    return "more than 60 characters";
  if (subject.ends_with('.')) return "a full stop at the end";
  if (is_no_order(subject.substr(0, subject.find_first_of(" :,")))) return "no order";
  return "";
}

}  // namespace

TEST_SUITE("repository") {
  TEST_CASE("a subject of a commit is an order of at most 60 characters") {
    for (const char* right :
         {"Reject polygons with an empty outer ring", "Pass borders on", "Embed the page",
          "Say why: the roof", "Address é of 60 characters, all of them are counted as one e"})
      CHECK_MESSAGE(fault_of(right).empty(), right, ": ", fault_of(right));
    CHECK(fault_of("reject polygons") == "no upper case letter first");
    CHECK(fault_of("") == "no upper case letter first");
    CHECK(fault_of("Reject " + std::string(54, 'x')) == "more than 60 characters");
    CHECK(fault_of("Reject polygons.") == "a full stop at the end");
    for (const char* wrong : {"The polygons are rejected", "What is rejected", "Rejects polygons",
                              "Tests: more of them", "Rejected polygons", "Rejecting polygons"})
      CHECK_MESSAGE(fault_of(wrong) == "no order", wrong);
  }

  TEST_CASE("every commit since the rule has such a subject") {
    if (git("rev-parse --is-shallow-repository") != "false\n" ||
        !git("merge-base --is-ancestor " + kBase + " HEAD")) {
      MESSAGE("skipped: no git with the whole history");
      return;
    }
    const auto subjects = git("log --no-merges --format=%s " + kBase + "..HEAD");
    REQUIRE(subjects);
    std::istringstream lines(*subjects);
    for (std::string subject; std::getline(lines, subject);)
      CHECK_MESSAGE(fault_of(subject).empty(), subject, ": ", fault_of(subject));
  }
}
