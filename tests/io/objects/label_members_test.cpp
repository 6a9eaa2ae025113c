#include "io/objects/label_members.h"

#include "kernel/base/text/json_text.h"

#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel {
namespace {

void say(std::string& text) { text = "said"; }
void say(std::optional<double>& number) { number = 0.25; }
void say(std::optional<bool>& truth) { truth = false; }
void say(std::vector<std::string>& ids) { ids = {"g1", "g2", "g3"}; }

std::string text_of(const FeatureLabel& label) {
  std::string text = "{";
  for_each_member(label, [&](std::string_view name, const auto& value) {
    append_json_key(text, name);
    append_json(text, value);
  });
  return text + "}";
}

/// As both readers of files read it.
void check_read(const std::string& text, const FeatureLabel& label) {
  CAPTURE(text);
  CHECK(label_of(RawNode(text), kSurfaceMembers) == label);
  CHECK(label_of(nlohmann::ordered_json::parse(text), kSurfaceMembers) == label);
}

TEST_SUITE("io") {
  TEST_CASE("each thing that a label says is written under a name and read back") {
    FeatureLabel all{.others = {{"slope", std::string("steep")}, {"sure", true}}};
    std::set<std::string_view> names;
    for (const LabelMember& member : kLabelMembers) {
      CAPTURE(member.name);
      CHECK(names.insert(member.name).second);
      FeatureLabel one;
      std::visit([&](const auto of) { say(one.*of), say(all.*of); }, member.of);
      CHECK(one != FeatureLabel());
      CHECK(text_of(one).starts_with("{\"" + std::string(member.name) + "\":"));
      check_read(text_of(one), one);
    }
    CHECK(nlohmann::json::parse(text_of(all)).size() == names.size() + all.others.size());
    check_read(text_of(all), all);
    check_read(text_of({}), {});
  }

  TEST_CASE("what a member cannot mean for a label stays as the file has it") {
    const std::string text =
        R"({"oriel_score":"high","oriel_id":true,"oriel_groups":"","oriel_party_wall":"no","oriel_rule":"","slope":"steep"})";
    const FeatureLabel label = label_of(RawNode(text), kSurfaceMembers);
    CHECK(label.others.size() == 6);
    CHECK(text_of(label) == text);
    check_read(text, label);
  }

  TEST_CASE("members of a surface or an installation itself are none of its label") {
    check_read(R"({"type":"Window","parent":1,"children":2,"oriel_id":"f1"})",
               FeatureLabel{.id = "f1"});
    CHECK(label_of(RawNode(R"({"oriel_geometry":"shared"})"), kInstallationMembers) ==
          FeatureLabel());
  }
}

}  // namespace
}  // namespace oriel
