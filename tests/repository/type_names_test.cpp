#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

// One word, one type: a reader who meets a name in one room and looks it up finds one thing.

namespace {

namespace fs = std::filesystem;

/// C++ cut into words, numbers and single characters; comments, strings and lines of the
/// preprocessor are left out.
class CppWords {
 public:
  explicit CppWords(std::string_view text) : text_(text) {}

  std::vector<std::string> all() {
    std::vector<std::string> words;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#')
        skip_preprocessor_line();
      else if (text_.substr(at_, 2) == "//")
        skip_to("\n");
      else if (text_.substr(at_, 2) == "/*")
        skip_to("*/");
      else if (text_.substr(at_, 2) == "R\"")
        skip_raw_string();
      else if (c == '"' || c == '\'')
        skip_quoted(c);
      else if (is_word(c))
        words.push_back(word());
      else if (std::isspace(static_cast<unsigned char>(text_[at_++])) == 0)
        words.emplace_back(1, c);
    }
    return words;
  }

 private:
  static bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  }

  std::string word() {
    const std::size_t begin = at_;
    // 1'000 is one number.
    const auto separates = [&] {
      return text_[at_] == '\'' && std::isdigit(static_cast<unsigned char>(text_[begin])) != 0;
    };
    while (at_ < text_.size() && (is_word(text_[at_]) || separates())) ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }

  void skip_to(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    at_ = found == text_.npos ? text_.size() : found + end.size();
  }

  void skip_preprocessor_line() {
    do skip_to("\n");
    while (at_ >= 2 && at_ < text_.size() && text_[at_ - 2] == '\\');
  }

  void skip_raw_string() {
    const std::size_t open = text_.find('(', at_);
    const std::string end = ")" + std::string(text_.substr(at_ + 2, open - at_ - 2)) + "\"";
    skip_to(end);
  }

  void skip_quoted(char quote) {
    for (++at_; at_ < text_.size() && text_[at_] != quote; ++at_)
      if (text_[at_] == '\\') ++at_;
    ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// The types that a text defines and the aliases that it gives, apart by where they stand; those of
/// functions are theirs.
struct TypeNames {
  std::vector<std::string> of_namespaces, of_types;
};

class TypeNameFinder {
 public:
  TypeNames found;

  explicit TypeNameFinder(const std::vector<std::string>& words) {
    for (const std::string& word : words) {
      if (word == "{")
        open();
      else if (word == "}")
        close();
      else if (word == ";")
        end_statement();
      else
        statement_.push_back(word);
    }
  }

 private:
  enum class Scope { name_space, type, code };

  /// Without a name: none.
  struct DefinedType {
    std::string name;
    bool is_inner = false;
  };

  static bool is_type_key(const std::string& word) {
    return word == "class" || word == "struct" || word == "enum" || word == "union";
  }

  bool says(std::string_view word) const {
    return std::ranges::find(statement_, word) != statement_.end();
  }

  void open() {
    Scope scope = Scope::code;
    if (says("namespace"))
      scope = Scope::name_space;
    else if (const DefinedType type = defined_type(); !type.name.empty()) {
      scope = Scope::type;
      add(type.name, type.is_inner);
    }
    scopes_.push_back(scope);
    statement_.clear();
  }

  void close() {
    if (!scopes_.empty()) scopes_.pop_back();
    statement_.clear();
  }

  void end_statement() {
    const auto alias = std::ranges::find(statement_, "=");
    if (statement_.size() > 3 && alias != statement_.end() && alias - statement_.begin() >= 2 &&
        *(alias - 2) == "using")
      add(*(alias - 1));
    statement_.clear();
  }

  /// `class NAME` or `class OUTER::NAME` at the beginning of what stands before a brace, after
  /// template parameters; a specialisation has no name of its own.
  DefinedType defined_type() const {
    auto at = after_template_parameters();
    while (at != statement_.end() && !is_type_key(*at)) {
      if (*at == "(" || *at == "=") return {};
      ++at;
    }
    while (at != statement_.end() && is_type_key(*at)) ++at;
    at = after_attributes(at);
    if (at == statement_.end() || !is_name(*at)) return {};
    DefinedType type{*at, false};
    for (; statement_.end() - at > 3 && at[1] == ":" && at[2] == ":"; at += 3) type = {at[3], true};
    if (at + 1 == statement_.end()) return type;
    const std::string& next = at[1];
    const bool is_special = next == "<" || next == "(" || is_name_but_final(next);
    return is_special ? DefinedType{} : type;
  }

  static bool is_name(const std::string& word) {
    return std::isalpha(static_cast<unsigned char>(word[0])) != 0 || word[0] == '_';
  }
  static bool is_name_but_final(const std::string& word) {
    return is_name(word) && word != "final";
  }

  std::vector<std::string>::const_iterator after_template_parameters() const {
    auto at = statement_.begin();
    while (at != statement_.end() && *at != "template") ++at;
    if (at == statement_.end()) return statement_.begin();
    int depth = 0;
    for (++at; at != statement_.end(); ++at) {
      if (*at == "<") ++depth;
      if (*at == ">" && --depth == 0) return at + 1;
    }
    return at;
  }

  std::vector<std::string>::const_iterator after_attributes(
      std::vector<std::string>::const_iterator at) const {
    while (at != statement_.end() && *at == "[") at = std::find(at, statement_.end(), "]") + 2;
    return at;
  }

  void add(const std::string& name, bool is_qualified = false) {
    const bool is_inner = is_qualified || std::ranges::find(scopes_, Scope::type) != scopes_.end();
    if (std::ranges::find(scopes_, Scope::code) != scopes_.end()) return;
    (is_inner ? found.of_types : found.of_namespaces).push_back(name);
  }

  std::vector<Scope> scopes_;
  std::vector<std::string> statement_;
};

TypeNames type_names(std::string_view text) { return TypeNameFinder(CppWords(text).all()).found; }

std::string file_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

using Places = std::map<std::string, std::vector<std::string>>;

/// Every name with the files in which it stands for a type, those of namespaces and those within
/// types.
std::pair<Places, Places> places_of_names() {
  std::pair<Places, Places> places;
  const fs::path root = ORIEL_SOURCE_DIR;
  for (const char* room : {"model", "kernel", "io", "interpret", "generalise", "oriel",
                           "experiments", "studio", "cli", "python"})
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
      const fs::path& path = entry.path();
      if (path.extension() != ".h" && path.extension() != ".cpp") continue;
      const TypeNames names = type_names(file_text(path));
      const std::string place = fs::relative(path, root).string();
      for (const std::string& name : names.of_namespaces) places.first[name].push_back(place);
      for (const std::string& name : names.of_types) places.second[name].push_back(place);
    }
  return places;
}

}  // namespace

TEST_SUITE("repository") {
  TEST_CASE("types are found where they are defined") {
    const TypeNames names = type_names(R"cpp(
#define IGNORED \
        struct Macro {}
      // struct Comment {};
      namespace oriel {
      namespace {
      const char* text = "struct Text {";
      class Later;
      template <class T, class U = std::vector<T>>
      struct Template : Base<T> {
        enum class Kind { a, b };
        using Id = int;
      };
      template <>
      struct Template<int> {};
      struct [[nodiscard]] Marked final {
        int x = 1'000;
        struct Inner {
          int y;
        } inner;
      };
      using Alias = std::vector<int>;
      struct Function make(struct Later& later) {
        struct Local {};
        using Mine = int;
        return {};
      }
      enum class Colour : int { red };
      struct Colour::Part : Base {};
      }  // namespace
      }  // namespace oriel
    )cpp");
    CHECK(names.of_namespaces == std::vector<std::string>{"Template", "Marked", "Alias", "Colour"});
    CHECK(names.of_types == std::vector<std::string>{"Kind", "Id", "Inner", "Part"});
  }

  TEST_CASE("a name of a type means one thing in the whole product") {
    const auto [outer, inner] = places_of_names();
    REQUIRE(outer.size() > 500);
    for (const auto& [name, places] : outer) {
      CAPTURE(name);
      CHECK_MESSAGE(places.size() == 1, name, " is defined in ",
                    fmt::format("{}", fmt::join(places, ", ")));
      if (const auto nested = inner.find(name); nested != inner.end())
        CHECK_MESSAGE(false, name, " of ", places[0], " is also a name within a type of ",
                      fmt::format("{}", fmt::join(nested->second, ", ")));
    }
  }
}
