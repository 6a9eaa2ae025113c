#include "interpret/testing/test_file.h"

#include "interpret/testing/test_grammar.h"
#include "interpret/yaml/section.h"
#include "interpret/yaml/yaml_tree.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

constexpr int kMostTimes = 1000;

/// Reads the tests of one file.
class TestReader {
 public:
  TestReader(const Pack& pack, Loader& loader) : pack_(&pack), loader_(&loader) {}

  std::vector<RuleTest> run(YamlSection& top) {
    if (const YamlNode* fixtures = top.find("fixtures")) read_fixtures(*fixtures);
    const YamlNode* tests = top.require("tests");
    if (tests != nullptr && expect_list(*tests, "'tests'", findings()))
      for (const YamlNode& node : tests->items) read_test(node);
    if (tests != nullptr && tests->items.empty())
      findings().error(Code::R270, tests->span, "there is no test here");
    return std::move(tests_);
  }

 private:
  [[nodiscard]] Findings& findings() const { return loader_->findings; }

  void read_fixtures(const YamlNode& node) {
    if (!expect_map(node, "'fixtures'", findings())) return;
    for (const YamlEntry& entry : node.entries)
      fixtures_[entry.key.text] = read_fixture(entry.value, *loader_);
  }

  void read_test(const YamlNode& node) {
    YamlSection section(node, "a test", test_grammar().keys("test"), findings());
    if (!section.is_map()) return;
    RuleTest test;
    test.place = findings().source().place(node.span.begin);
    if (const YamlNode* name = section.require("name")) read_name(*name, test);
    if (const YamlNode* given = section.require("given")) read_given(*given, test);
    const YamlNode* expect = section.find("expect");
    if (expect != nullptr) read_expect(*expect, test);
    if (const YamlNode* because = section.find("because")) read_because(*because, test);
    const YamlNode* property = section.find("property");
    if (property != nullptr) read_property(*property, test);
    const bool is_empty = test.labels.empty() && test.counts.empty() && test.groups.empty();
    if (is_empty && property == nullptr)
      findings().error(Code::R270, node.span, "this test expects nothing");
    if (!test.because.empty() && test.labels.empty())
      findings().error(Code::R270, node.span,
                       "'because' speaks of the features of 'expect': name one");
    tests_.push_back(std::move(test));
  }

  void read_name(const YamlNode& node, RuleTest& test) {
    test.name = read_text(node, "a test's name", findings()).value_or("");
    if (!names_.insert(test.name).second)
      findings().error(Code::R240, node.span, "there is a test '" + test.name + "' already");
  }

  void use_fixture(const YamlNode& name, RuleTest& test) {
    const auto found = fixtures_.find(name.text);
    if (found != fixtures_.end()) {
      test.fixture = found->second;
      return;
    }
    std::vector<std::string> names;
    for (const auto& [fixture, features] : fixtures_) names.push_back(fixture);
    findings().error(Code::R212, name.span,
                     "there is no fixture '" + name.text + "'" + did_you_mean(name.text, names));
  }

  void read_given(const YamlNode& node, RuleTest& test) {
    if (node.kind == YamlNode::Kind::scalar) return use_fixture(node, test);
    if (node.kind != YamlNode::Kind::map || node.entries.size() != 1) {
      findings().error(Code::R211, node.span,
                       "'given' is a fixture, 'fixture: {feature.attribute: value}' or 'building: "
                       "FILE'");
      return;
    }
    const YamlEntry& entry = node.entries[0];
    if (entry.key.text == "building") {
      test.building = read_text(entry.value, "a building's file", findings()).value_or("");
      return;
    }
    use_fixture(entry.key, test);
    if (!test.fixture.empty()) override_features(entry.value, test.fixture, *loader_);
  }

  void read_counts(const YamlNode& node, const std::vector<std::string>& names,
                   std::vector<std::pair<std::string, std::size_t>>& counts) {
    if (!expect_map(node, "counts", findings())) return;
    for (const YamlEntry& entry : node.entries) {
      check_name(entry.key, entry.key.text, names);
      const auto count = read_integer(entry.value, "a count", findings());
      if (count && *count < 0)
        findings().error(Code::R212, entry.value.span, "a count is not negative");
      counts.emplace_back(entry.key.text, static_cast<std::size_t>(std::max(count.value_or(0), 0)));
    }
  }

  void check_name(const YamlNode& node, const std::string& name,
                  const std::vector<std::string>& names) {
    if (std::ranges::find(names, name) == names.end())
      findings().error(Code::R205, node.span,
                       "the pack has no '" + name + "'" + did_you_mean(name, names));
  }

  [[nodiscard]] std::vector<std::string> labels() const {
    std::vector<std::string> names = names_of(pack_->classes);
    names.emplace_back("unknown");
    return names;
  }

  void read_expect(const YamlNode& node, RuleTest& test) {
    if (!expect_map(node, "'expect'", findings())) return;
    for (const YamlEntry& entry : node.entries) {
      if (entry.key.text == "counts") {
        read_counts(entry.value, labels(), test.counts);
      } else if (entry.key.text == "groups") {
        read_counts(entry.value, names_of(pack_->groups), test.groups);
      } else if (const auto text = read_text(entry.value, "a label", findings())) {
        Expectation expected{entry.key.text, *text, false};
        if (expected.label.starts_with("not ")) {
          expected.label.erase(0, 4);
          expected.is_negated = true;
        }
        check_name(entry.value, expected.label, labels());
        test.labels.push_back(std::move(expected));
      }
    }
  }

  void read_because(const YamlNode& node, RuleTest& test) {
    if (!expect_map(node, "'because'", findings())) return;
    for (const YamlEntry& entry : node.entries) {
      std::vector<std::string> ids;
      for (const Rule& rule : pack_->rules) ids.push_back(rule.id);
      check_name(entry.key, entry.key.text, ids);
      if (const auto text = read_text(entry.value, "a reason", findings()))
        read_reason(entry, *text, test);
    }
  }

  void read_reason(const YamlEntry& entry, std::string text, RuleTest& test) {
    Reason reason;
    reason.rule = entry.key.text;
    const std::size_t at = text.find(" at ");
    if (at != std::string::npos) {
      reason.condition = text.substr(at + 4);
      text.resize(at);
      std::erase(reason.condition, '"');
    }
    const bool is_outcome = text == "holds" || text == "fails" || text == "unknown";
    if (!is_outcome || (at != std::string::npos && text == "holds"))
      findings().error(Code::R212, entry.value.span,
                       "a reason is 'holds', 'fails', 'unknown', or 'fails at \"condition\"'");
    reason.outcome = text == "holds"   ? Outcome::holds
                     : text == "fails" ? Outcome::fails
                                       : Outcome::unknown;
    test.because.push_back(std::move(reason));
  }

  void read_property(const YamlNode& node, RuleTest& test) {
    YamlSection section(node, "a property", test_grammar().keys("property"), findings());
    TablePerturbation perturbation;
    const YamlNode* perturb = section.require("perturb");
    if (perturb != nullptr && expect_map(*perturb, "'perturb'", findings()))
      for (const YamlEntry& entry : perturb->entries) read_amount(entry, perturbation);
    if (const YamlNode* times = section.find("times"))
      perturbation.times = read_integer(*times, "'times'", findings()).value_or(1);
    if (perturbation.times < 1 || perturbation.times > kMostTimes)
      findings().error(Code::R212, node.span, "'times' lies in 1 .. 1000");
    test.perturbation = std::move(perturbation);
  }

  void read_amount(const YamlEntry& entry, TablePerturbation& perturbation) {
    const auto attribute = find_attribute(entry.key.text);
    const bool is_number = attribute && info_of(*attribute).unit != Unit::text &&
                           info_of(*attribute).unit != Unit::yes_no;
    if (!is_number) {
      findings().error(Code::R204, entry.key.span,
                       "'" + entry.key.text + "' is not an attribute that is a number" +
                           did_you_mean(entry.key.text, names_of(feature_schema())));
      return;
    }
    const bool is_relative = entry.value.text.ends_with('%');
    const Dimension own = dimension_of(info_of(*attribute).unit);
    const auto amount = read_quantity(entry.value, is_relative ? Dimension{} : own, *loader_);
    if (amount) perturbation.amounts.push_back({*attribute, std::abs(amount->value), is_relative});
  }

  const Pack* pack_;
  Loader* loader_;
  std::map<std::string, Fixture> fixtures_;
  std::set<std::string> names_;
  std::vector<RuleTest> tests_;
};

/// The pack that the tests are for: a file beside them, or one that is built in.
std::optional<RuleBase> load_tested(const YamlNode& node, const std::string& path,
                                    Findings& findings, std::vector<Issue>& issues) {
  const auto name = read_text(node, "'tests_for'", findings);
  if (!name) return std::nullopt;
  const auto beside = std::filesystem::path(path).parent_path() / *name;
  auto loaded = load_pack_file(embedded_pack(*name) ? *name : beside.string());
  issues = std::move(loaded.issues);
  if (!loaded.value)
    findings.error(Code::R270, node.span,
                   "the pack '" + *name + "' cannot be tested: it has errors");
  return loaded.value;
}

}  // namespace

double Noise::next() {
  state_ += 0x9e3779b97f4a7c15;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111eb;
  z ^= z >> 31U;
  return static_cast<double>(z >> 11U) * 0x1p-52 - 1;
}

FeatureTable perturbed(const FeatureTable& table, const TablePerturbation& perturbation,
                       Noise& noise) {
  FeatureTable moved = table;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const FeatureId id{static_cast<int>(row)};
    for (const TablePerturbation::Amount& amount : perturbation.amounts) {
      const auto value = table.number(id, amount.attribute);
      if (!value) continue;
      const double most = amount.is_relative ? std::abs(*value) * amount.amount : amount.amount;
      moved.set(id, amount.attribute, *value + most * noise.next());
    }
  }
  return moved;
}

std::optional<TestFile> read_test_file(const std::string& path, std::vector<Issue>& issues) {
  auto text = read_file(path);
  if (!text) {
    Issue issue;
    issue.code = Code::R200;
    issue.sentence =
        "there are no tests here that can be read; write them into this file, or start with "
        "'oriel rules new'";
    issue.place.file = path;
    issues.push_back(std::move(issue));
    return std::nullopt;
  }
  ReadTests read = read_tests_text(std::move(*text), path);
  issues = std::move(read.issues);
  return std::move(read.file);
}

ReadTests read_tests_text(std::string text, const std::string& path) {
  // A pack of nothing but params: values of fixtures may name those of the tested pack.
  Pack scratch(Source(path, std::move(text)));
  Findings findings(scratch.source);
  std::vector<Issue> of_pack;
  ReadTests read;
  TestFile& file = read.file.emplace();
  const std::size_t bad = find_bad_byte(scratch.source.text());
  if (bad != std::string_view::npos) {
    findings.error(Code::R200, {bad, bad}, "this is not UTF-8 text");
  } else if (const auto root = parse_yaml({0, scratch.source.text().size()}, findings)) {
    check_traps(*root, findings);
    YamlSection top(*root, "a file of tests", test_grammar().keys(""), findings);
    const YamlNode* pack = top.is_map() ? top.require("tests_for") : nullptr;
    if (pack != nullptr) file.base = load_tested(*pack, path, findings, of_pack);
    if (file.base) {
      scratch.params = file.base->pack().params;
      Loader loader(scratch, findings);
      loader.names.is_param_used.assign(scratch.params.size(), false);
      file.tests = TestReader(file.base->pack(), loader).run(top);
    }
  }
  read.issues = findings.issues();
  read.findings = findings.spanned();
  // Its notes are of files that no test writes.
  std::ranges::copy_if(of_pack, std::back_inserter(read.issues),
                       [](const Issue& issue) { return issue.severity != Severity::note; });
  if (findings.has_errors() || !file.base) read.file.reset();
  return read;
}

}  // namespace oriel::rules
