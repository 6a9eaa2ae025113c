#include "tests/studio/session/studio_bench.h"

#include <barrier>

#include <doctest/doctest.h>
#include <fmt/format.h>

namespace oriel::test {

TEST_SUITE("studio/session") {
  TEST_CASE("a pack that is built in is saved to a file that says so") {
    const StudioFolder folder("save");
    studio::SessionOptions options = sample_options();
    options.folders = {folder.path()};
    StudioBench bench(options);
    const std::string text = bench.pack_text();
    json body{{"text", text}, {"hash", ""}};
    CHECK(bench.refusal("save", body.dump()).first == 400);
    body["path"] = folder.file("mine.yaml");
    const json saved = bench.ask("save", body);
    CHECK(saved["path"] == folder.file("mine.yaml"));
    CHECK(folder.read("mine.yaml") == text);
    const json pack = bench.ask("state", json::object())["pack"];
    CHECK(pack["path"] == saved["path"]);
    CHECK(pack["hash"] == saved["hash"]);
    CHECK(pack["is_writable"] == true);
    CHECK(bench.ask("disk", json::object())["is_changed"] == false);
  }

  TEST_CASE("a file that changed on disk is never overwritten silently") {
    const StudioFolder folder("disk");
    folder.write("mine.yaml", "extends: residential\n");
    studio::SessionOptions options = sample_options();
    options.rules = folder.file("mine.yaml");
    StudioBench bench(options);
    const json pack = bench.ask("state", json::object())["pack"];
    folder.write("mine.yaml", "another text\n");
    CHECK(bench.ask("disk", json::object())["is_changed"] == true);
    json body{{"text", "new\n"}, {"hash", pack["hash"]}};
    const studio::Reply refused = bench.reply("save", body.dump());
    CHECK(refused.status == 409);
    const json said = json::parse(refused.json);
    CHECK(said["disk_text"] == "another text\n");
    CHECK(folder.read("mine.yaml") == "another text\n");
    body["hash"] = said["disk_hash"];
    bench.ask("save", body);
    CHECK(folder.read("mine.yaml") == "new\n");
    folder.write("mine.yaml", "a third\n");
    body["force"] = true;
    bench.ask("save", body);
    CHECK(folder.read("mine.yaml") == "new\n");
  }

  TEST_CASE("of two saves at once one is refused and told the other text") {
    const StudioFolder folder("at-once");
    folder.write("mine.yaml", "first\n");
    studio::SessionOptions options = sample_options();
    options.rules = folder.file("mine.yaml");
    StudioBench one(options), two(options);
    std::string known = one.ask("state", json::object())["pack"]["hash"];
    for (int round = 0; round < 20; ++round) {
      CAPTURE(round);
      std::barrier begin(2);
      const auto save = [&](StudioBench& bench, const std::string& text, studio::Reply& reply) {
        begin.arrive_and_wait();
        reply = bench.reply("save", json{{"text", text}, {"hash", known}}.dump());
      };
      const std::string of_one = fmt::format("one {}\n", round),
                        of_two = fmt::format("two {}\n", round);
      studio::Reply first, second;
      std::thread other([&] { save(two, of_two, second); });
      save(one, of_one, first);
      other.join();
      const bool is_first = first.status == 200;
      CHECK((is_first ? first : second).status == 200);
      REQUIRE((is_first ? second : first).status == 409);
      const json refused = json::parse((is_first ? second : first).json);
      CHECK(refused["disk_text"] == (is_first ? of_one : of_two));
      CHECK(folder.read("mine.yaml") == refused["disk_text"]);
      known = refused["disk_hash"];
    }
  }

  TEST_CASE("nothing is saved outside of the folders of the studio") {
    const StudioFolder folder("inside"), other("outside");
    studio::SessionOptions options = sample_options();
    options.folders = {folder.path()};
    StudioBench bench(options);
    std::filesystem::create_directory_symlink(other.path(), folder.file("link"));
    std::filesystem::create_symlink(other.file("x.yaml"), folder.file("x.yaml"));
    for (const std::string& path :
         {other.file("x.yaml"), folder.file("../oriel-studio-outside/x.yaml"),
          folder.file("link/x.yaml"), folder.file("x.yaml"), folder.file("x.txt"),
          folder.file("none/x.yaml")}) {
      CAPTURE(path);
      const json body{{"text", "x"}, {"hash", ""}, {"path", path}};
      const int status = bench.refusal("save", body.dump()).first;
      CHECK((status == 400 || status == 403));
    }
    CHECK(std::filesystem::is_empty(other.path()));
  }
}

}  // namespace oriel::test
