#include "io/files/output_file.h"

#include "kernel/base/issue.h"
#include "tests/io/files.h"

#include <filesystem>
#include <sys/stat.h>

#include <doctest/doctest.h>

namespace oriel {
namespace {

Issue failure_of(const std::string& path, const std::string& bytes = "x") {
  try {
    write_file(path, bytes);
  } catch (const OutputError& error) {
    return error.issue();
  }
  return {};
}

TEST_SUITE("io") {
  TEST_CASE("a file appears with its whole content and nothing beside it") {
    const test::TemporaryFolder folder;
    const std::string bytes(3'000'000, 'a');
    write_file(folder.file("a.json"), bytes);
    CHECK(test::text_of(folder.file("a.json")) == bytes);
    write_file(folder.file("a.json"), "short");
    CHECK(test::text_of(folder.file("a.json")) == "short");
    CHECK(folder.file_count() == 1);
  }

  TEST_CASE("pieces of all sizes are in the file in their order") {
    const test::TemporaryFolder folder;
    std::string all;
    OutputFile file(folder.file("a.json"));
    for (const std::size_t size : {10UL, 40'000UL, 20'000UL, 20'000UL, 0UL, 3UL, 100'000UL, 1UL}) {
      const std::string piece(size, static_cast<char>('a' + all.size() % 26));
      file.append(piece);
      all += piece;
      CHECK(file.size() == all.size());
    }
    file.commit();
    CHECK(test::text_of(folder.file("a.json")) == all);
  }

  TEST_CASE("a file that is not committed leaves the old one alone") {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("a.json", "old");
    {
      OutputFile file(path);
      file.append(std::string(3'000'000, 'b'));
      CHECK(folder.file_count() == 2);
    }
    CHECK(test::text_of(path) == "old");
    CHECK(folder.file_count() == 1);
  }

  TEST_CASE("a place that cannot be written is refused with the reason") {
    const test::TemporaryFolder folder;
    const Issue missing = failure_of(folder.file("no/such/a.json"));
    CHECK(missing.code == Code::E601);
    CHECK(missing.sentence.find("No such file") != std::string::npos);
    CHECK(missing.place.file == folder.file("no/such/a.json"));
    std::filesystem::create_directory(folder.file("d"));
    CHECK(failure_of(folder.file("d")).sentence.find("directory") != std::string::npos);
    CHECK(folder.file_count() == 1);
  }

  TEST_CASE("a full device is refused") {
    if (!std::filesystem::exists("/dev/full")) return;
    CHECK(failure_of("/dev/full").sentence.find("No space") != std::string::npos);
    CHECK(failure_of("/dev/null").code == Code::none);
  }

  TEST_CASE("links and permissions stay") {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("a.json", "old");
    ::chmod(path.c_str(), 0640);
    std::filesystem::create_symlink(path, folder.file("link.json"));
    write_file(folder.file("link.json"), "new");
    CHECK(std::filesystem::is_symlink(folder.file("link.json")));
    CHECK(test::text_of(path) == "new");
    CHECK((std::filesystem::status(path).permissions() & std::filesystem::perms::all) ==
          std::filesystem::perms(0640));
  }
}

}  // namespace
}  // namespace oriel
