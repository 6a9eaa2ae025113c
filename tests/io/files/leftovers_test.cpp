#include "io/files/leftovers.h"

#include "io/files/output_file.h"
#include "tests/io/files.h"

#include <fcntl.h>
#include <filesystem>
#include <string>
#include <sys/file.h>
#include <unistd.h>

#include <doctest/doctest.h>

namespace oriel {
namespace {

TEST_SUITE("io") {
  TEST_CASE("the temporary files of killed runs go when their output is written again") {
    const test::TemporaryFolder folder;
    const std::string left = folder.write("a.json.tmp-123-0", "half");
    // Nobody's number says anything: that of this process may have been another one's before.
    const std::string own =
        folder.write("a.json.tmp-" + std::to_string(::getpid()) + "-7", "half, too");
    write_file(folder.file("a.json"), "whole");
    CHECK(test::text_of(folder.file("a.json")) == "whole");
    CHECK_FALSE(std::filesystem::exists(left));
    CHECK_FALSE(std::filesystem::exists(own));
    CHECK(folder.file_count() == 1);
  }

  TEST_CASE("files of another name or form are no leftovers") {
    const test::TemporaryFolder folder;
    for (const char* name :
         {"b.json.tmp-123-0", "a.json.tmp-123", "a.json.tmp-123-", "a.json.tmp-x-0", "a.json.tmp-",
          "a.json.tmp-1-0.bak", "aa.json.tmp-1-0", "a.json.tmp-1-0-0", "a.json.tmp-12345678901-0"})
      (void)folder.write(name, name);
    std::filesystem::create_directory(folder.file("a.json.tmp-1-1"));
    std::filesystem::create_symlink(folder.file("b.json.tmp-123-0"), folder.file("a.json.tmp-1-2"));
    write_file(folder.file("a.json"), "whole");
    CHECK(folder.file_count() == 12);
  }

  TEST_CASE("the temporary file of a run at work stays") {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("a.json.tmp-123-0", "at work");
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    REQUIRE(descriptor >= 0);
    REQUIRE(detail::lock_temporary(descriptor));
    detail::remove_leftovers(folder.file("a.json"));
    CHECK(test::text_of(path) == "at work");
    ::close(descriptor);
  }

  TEST_CASE("a file that is written is locked until it has its name") {
    const test::TemporaryFolder folder;
    OutputFile file(folder.file("a.json"));
    file.append("whole");
    const std::string temporary = detail::temporary_name(folder.file("a.json"), 0);
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CLOEXEC);
    REQUIRE(descriptor >= 0);
    CHECK(::flock(descriptor, LOCK_EX | LOCK_NB) != 0);
    file.commit();
    CHECK(::flock(descriptor, LOCK_EX | LOCK_NB) == 0);
    ::close(descriptor);
  }

  TEST_CASE("a temporary file that another run removed before it was locked is of no use") {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("a.json.tmp-123-0", "");
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    std::filesystem::remove(path);
    CHECK_FALSE(detail::lock_temporary(descriptor));
    ::close(descriptor);
  }
}

}  // namespace
}  // namespace oriel
