#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>

#include <doctest/doctest.h>

namespace {

namespace fs = std::filesystem;

/// What is kept between two calls, and why threads may use it all the same.
const std::map<std::string, std::string> kKeepers{
    {"kernel/base/name.cpp", "texts of names, behind a lock"},
    {"kernel/base/log.cpp", "loggers, behind a lock"},
    {"io/gltf/glb_buffers.cpp", "versions of the library, chosen once, behind a lock"},
    {"io/files/leftovers.cpp", "files of killed runs, behind a lock"},
    {"io/files/partial_files.cpp", "open outputs, of the one thread that writes"},
    {"studio/server/shared_work.cpp",
     "what a thread is at, of this thread; where a handler writes"},
};

/// Objects that change though they are constant, and why no two threads have one.
const std::map<std::string, std::string> kChangesWithin{
    {"interpret/learn/learning_set.h", "behind a lock"},
    {"interpret/relabelling/relabelling.cpp", "of one call"},
    {"interpret/yaml/yaml_tree.cpp", "of a library that only reads"},
    {"kernel/describe/features/parallel_polygons.h", "of one building"},
    {"kernel/describe/surfaces/surface_faces.h", "of one building"},
    {"kernel/describe/surfaces/vertical_lines.h", "of one building"},
    {"io/files/gzip.cpp", "of a library that only reads"},
    {"kernel/neighbours/shape_store.h", "behind a lock"},
    {"kernel/segment/boundary/boundary.h", "of one building"},
    {"kernel/segment/cuts/pockets.h", "of one building"},
    {"kernel/solidify/cap_kinds.h", "of one building"},
    {"studio/session/labels/pack_runner.h", "behind a lock"},
    {"studio/session/learning/correction_book.h", "behind a lock"},
    {"studio/session/learning/learning_job.h", "behind a lock"},
    {"studio/session/open_buildings.h", "behind a lock"},
    {"studio/session/pack_file.h", "behind a lock"},
    {"studio/session/verbs/drawing_progress.h", "behind a lock"},
};

/// A variable at namespace scope or of a function, that is not constant and outlives a call. Lines
/// are those of clang-format.
bool declares_state(const std::string& line) {
  static const std::regex of_function(R"(^\s+(static|thread_local) (?!const\b|constexpr\b)[^(]*$)");
  static const std::regex of_namespace(
      R"(^(static |inline |thread_local )?[A-Za-z_][\w:<>,*& ]* \w+(\[.*\])?( =.*|\{.*|;)$)");
  static const std::regex no_variable(
      R"(^(__extension__|using|namespace|struct|class|enum|constexpr|const|inline constexpr|inline const|static constexpr|static const|template|extern|return|friend|union|typedef|case)\b.*)");
  if (std::regex_match(line, of_function)) return true;
  return std::regex_match(line, of_namespace) && !std::regex_match(line, no_variable);
}

/// A member that changes in a constant object, or a cast that lets any do so.
bool changes_constants(const std::string& line) {
  static const std::regex change(R"(^\s+mutable .*|^[^/]*\bconst_cast<.*)");
  return std::regex_match(line, change);
}

bool has_line(const fs::path& path, bool (*is_such)(const std::string&)) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (is_such(line)) return true;
  return false;
}

/// The files of the library's rooms that have such a line, and what is known of each.
std::map<std::string, std::string> files_with(bool (*is_such)(const std::string&),
                                              const std::map<std::string, std::string>& known) {
  std::map<std::string, std::string> found;
  for (const char* room : {"model", "kernel", "io", "interpret", "generalise", "oriel",
                           "experiments", "studio", "python"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(ORIEL_SOURCE_DIR) / room)) {
      const bool is_code = entry.path().extension() == ".cpp" || entry.path().extension() == ".h";
      if (!is_code || !has_line(entry.path(), is_such)) continue;
      const std::string file = fs::relative(entry.path(), ORIEL_SOURCE_DIR).string();
      found[file] = known.contains(file) ? known.at(file) : "not known";
    }
  return found;
}

}  // namespace

TEST_SUITE("repository") {
  // Why -j is one hash, and why the thread sanitizer looks at some rooms only
  // (tests/sanitized_rooms.cmake).
  TEST_CASE("rooms keep nothing between two calls but what is behind a lock") {
    CHECK(declares_state("  static std::map<int, int> seen;"));
    CHECK(declares_state("int calls = 0;"));
    CHECK(!declares_state("  static const std::regex pattern(\"a\");"));
    CHECK(!declares_state("  static int twice(int n) { return 2 * n; }"));
    CHECK((files_with(declares_state, kKeepers) == kKeepers));
  }

  // So rules, which all threads read, need not be looked at by the thread sanitizer.
  TEST_CASE("no two threads have an object that changes though it is constant") {
    CHECK(changes_constants("  mutable int calls_ = 0;"));
    CHECK(changes_constants("  const_cast<Rule&>(rule).uses += 1;"));
    CHECK(!changes_constants("  const auto next = [n = 0]() mutable { return n++; };"));
    const auto found = files_with(changes_constants, kChangesWithin);
    for (const auto& [file, why] : found) {
      CAPTURE(file);
      CHECK(why != "not known");
    }
    CHECK((found == kChangesWithin));
  }
}
