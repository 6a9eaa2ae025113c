#include "interpret/plan/profile.h"

#include "interpret/pack/embedded.h"
#include "interpret/pack/loader.h"
#include "interpret/pack/pack.h"
#include "interpret/plan/profile_grammar.h"
#include "interpret/yaml/section.h"
#include "kernel/base/sha256.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using rules::Findings;
using rules::YamlNode;
using rules::YamlSection;

constexpr const char* kProfileSchema = "oriel-profile/1";

class ProfileReader {
 public:
  ProfileReader(Findings& findings, Profile& profile) : findings_(findings), profile_(profile) {}

  void read(const YamlNode& root, const std::string& level) {
    YamlSection top(root, "a profile", rules::profile_grammar().keys(""), findings_);
    if (!top.is_map()) return;
    if (const YamlNode* schema = top.require("schema");
        schema != nullptr && schema->text != kProfileSchema)
      findings_.error(Code::R212, schema->span, fmt::format("the schema is {}", kProfileSchema));
    if (const YamlNode* header = top.require("profile")) {
      YamlSection section(*header, "'profile'", rules::profile_grammar().keys("header"), findings_);
      section.require("version");
      if (const YamlNode* name = section.require("name")) profile_.name = name->text;
    }
    const YamlNode* levels = top.require("levels");
    if (levels == nullptr || !rules::expect_map(*levels, "'levels'", findings_)) return;
    // All levels are checked, so that a profile is right or wrong whatever level is asked for.
    const Profile base = profile_;
    std::optional<Profile> chosen;
    std::vector<std::string> names;
    for (const auto& [key, value] : levels->entries) {
      profile_ = base;
      profile_.level = key.text;
      names.push_back(key.text);
      read_level(value);
      if (key.text == level || (level.empty() && levels->entries.size() == 1)) chosen = profile_;
    }
    if (chosen)
      profile_ = *chosen;
    else
      findings_.error(Code::R275, levels->span,
                      fmt::format("{}; the levels of '{}' are {}",
                                  level.empty() ? "a level is needed"
                                                : fmt::format("there is no level '{}'", level),
                                  base.name, join(names)));
  }

 private:
  void read_level(const YamlNode& node) {
    YamlSection section(node, "a level", rules::profile_grammar().keys("level"), findings_);
    if (!section.is_map()) return;
    if (const YamlNode* form = section.require("form")) read_form(*form);
    if (const YamlNode* piece = section.find("least-piece-m2"))
      profile_.least_piece_m2 = positive(*piece, "'least-piece-m2'").value_or(0);
    if (const YamlNode* edge = section.find("footprint-edge-m")) read_footprint_edge(*edge);
    read_classes(section.find("omit"), profile_.omit);
    read_classes(section.find("keep"), profile_.keep);
    profile_.omits_imprints = word(section.find("imprints"), "keep", "omit");
    if (const YamlNode* on_ground = section.find("on-ground"))
      read_classes(on_ground, profile_.on_ground.emplace());
    if (const YamlNode* edge = section.find("edge-min-m"))
      profile_.edge_min_m = positive(*edge, "'edge-min-m'");
    if (const YamlNode* owner = section.find("edge-owner-b-m"))
      profile_.edge_owner_b_m = positive(*owner, "'edge-owner-b-m'");
    profile_.names_classes = word(section.find("stl-solids"), "label", "class");
    read_sizes(section, node);
    if (const YamlNode* parts = section.find("parts")) read_parts(*parts);
    if (const YamlNode* buildings = section.find("buildings")) read_groups(*buildings);
    if (const YamlNode* invariants = section.find("invariants"))
      profile_.limits = rules::read_limits(*invariants, findings_);
  }

  void read_groups(const YamlNode& node) {
    YamlSection section(node, "'buildings'", rules::profile_grammar().keys("buildings"), findings_);
    if (!section.is_map()) return;
    if (const YamlNode* aggregate = section.require("aggregate");
        aggregate != nullptr && aggregate->text != "touching")
      findings_.error(Code::R211, aggregate->span,
                      "'aggregate' is touching, not '" + aggregate->text + "'");
    Profile::Groups& groups = profile_.groups.emplace();
    if (const YamlNode* gap = section.find("gap-mm"))
      groups.gap_mm = positive(*gap, "'gap-mm'").value_or(0);
    if (const YamlNode* height = section.find("like-height-m"))
      groups.like_height_m = positive(*height, "'like-height-m'").value_or(groups.like_height_m);
    if (const YamlNode* scale = section.find("from-scale"))
      groups.from_scale = positive(*scale, "'from-scale'").value_or(groups.from_scale);
    if (const YamlNode* rows = section.find("typify")) read_rows(*rows, groups);
  }

  void read_rows(const YamlNode& node, Profile::Groups& groups) {
    YamlSection section(node, "'typify' of 'buildings'", rules::profile_grammar().keys("typify"),
                        findings_);
    if (!section.is_map()) return;
    if (const YamlNode* ratio = section.require("ratio")) {
      groups.row_ratio = positive(*ratio, "'ratio'").value_or(0);
      if (groups.row_ratio >= 1)
        findings_.error(Code::R211, ratio->span, "'ratio' is below 1, else all of a row stays");
    }
    if (const YamlNode* scale = section.find("from-scale"))
      groups.rows_from_scale = positive(*scale, "'from-scale'").value_or(groups.rows_from_scale);
  }

  void read_form(const YamlNode& node) {
    if (node.text == "as-is")
      profile_.form = Profile::Form::as_is;
    else if (node.text == "block")
      profile_.form = Profile::Form::block;
    else if (node.text == "blocks")
      profile_.form = Profile::Form::blocks;
    else
      findings_.error(Code::R211, node.span,
                      "'form' is as-is, block or blocks, not '" + node.text + "'");
  }

  void read_footprint_edge(const YamlNode& node) {
    if (profile_.form != Profile::Form::block)
      findings_.error(Code::R211, node.span,
                      "'footprint-edge-m' is for one flat block: write form: block");
    profile_.footprint_edge_m = positive(node, "'footprint-edge-m'").value_or(0);
  }

  void read_classes(const YamlNode* node, std::vector<std::string>& classes) {
    if (node == nullptr || !rules::expect_list(*node, "a list of classes", findings_)) return;
    for (const YamlNode& item : node->items)
      if (const auto text = rules::read_text(item, "a class", findings_)) classes.push_back(*text);
  }

  /// True for the second word.
  bool word(const YamlNode* node, const std::string& first, const std::string& second) {
    if (node == nullptr || node->text == first) return false;
    if (node->text == second) return true;
    findings_.error(Code::R211, node->span,
                    fmt::format("write {} or {}, not '{}'", first, second, node->text));
    return false;
  }

  std::optional<double> positive(const YamlNode& node, const std::string& what) {
    const auto value = rules::read_number(node, what, findings_);
    if (value && !(*value > 0)) {
      findings_.error(Code::R211, node.span, what + " is more than 0");
      return std::nullopt;
    }
    return value;
  }

  void read_sizes(YamlSection& section, const YamlNode& level) {
    const YamlNode* sizes = section.find("sizes-m");
    const YamlNode* map = section.find("map-mm");
    const YamlNode* verdicts = section.find("verdicts");
    if (verdicts != nullptr) read_verdicts(*verdicts);
    if ((sizes != nullptr && map != nullptr) ||
        (sizes == nullptr && map == nullptr && verdicts != nullptr)) {
      findings_.error(Code::R272, level.span,
                      "verdicts of size need either 'sizes-m' with 'area-m2', or 'map-mm'");
      return;
    }
    if (map != nullptr) profile_.map_mm = positive(*map, "'map-mm'");
    if (sizes == nullptr) return;
    YamlSection of_sizes(*sizes, "'sizes-m'", rules::profile_grammar().keys("sizes"), findings_);
    const YamlNode* area = section.require("area-m2");
    std::array<std::optional<double>, 4> numbers;
    std::size_t i = 0;
    for (const char* key : {"a", "b", "c"}) {
      if (const YamlNode* node = of_sizes.require(key))
        numbers.at(i) = positive(*node, fmt::format("'{}'", key));
      ++i;
    }
    if (area != nullptr) numbers[3] = positive(*area, "'area-m2'");
    if (!std::ranges::all_of(numbers, [](const auto& n) { return n.has_value(); })) return;
    profile_.sizes = Thresholds{*numbers[0], *numbers[1], *numbers[2], *numbers[3]};
    const Thresholds& t = *profile_.sizes;
    if (!t.is_chain())
      findings_.error(
          Code::R274, sizes->span,
          fmt::format("the sizes do not form a chain: c <= b < a and a*a > area > a*b must hold; "
                      "here c = {}, b = {}, a = {}, a*a = {}, area = {}, a*b = {}",
                      t.c_m, t.b_m, t.a_m, t.a_m * t.a_m, t.area_m2, t.a_m * t.b_m));
  }

  void read_verdicts(const YamlNode& node) {
    YamlSection section(node, "'verdicts'", rules::profile_grammar().keys("verdicts"), findings_);
    if (!section.is_map()) return;
    for (const Significance verdict :
         {Significance::point, Significance::line, Significance::small})
      if (word(section.find(to_string(verdict)), "keep", "omit")) profile_.omitted.insert(verdict);
    const bool all_go = word(section.find("sheet"), "keep", "omit");
    const std::map<SheetPlace, std::vector<std::string>> operators{
        {SheetPlace::lamina, {"omit", "flatten"}},
        {SheetPlace::cap, {"omit", "flatten"}},
        {SheetPlace::fin, {"omit", "enlarge"}},
        {SheetPlace::enclosed, {"omit"}}};
    for (const auto& [place, words] : operators) {
      const YamlNode* own = section.find(to_string(place));
      const std::string verdict = own == nullptr ? (all_go ? "omit" : "keep") : own->text;
      if (verdict == "keep") continue;
      if (std::ranges::find(words, verdict) != words.end())
        profile_.sheets[place] = verdict;
      else
        findings_.error(Code::R211, own->span,
                        fmt::format("write keep, {}, not '{}'", join(words), verdict));
    }
  }

  void read_parts(const YamlNode& node) {
    YamlSection section(node, "'parts'", rules::profile_grammar().keys("parts"), findings_);
    const YamlNode *height = section.require("height-m"), *area = section.require("area-m2");
    if (height == nullptr || area == nullptr) return;
    const auto height_m = positive(*height, "'height-m'"), area_m2 = positive(*area, "'area-m2'");
    if (height_m && area_m2) profile_.part = Profile::MainPart{*height_m, *area_m2};
  }

  Findings& findings_;
  Profile& profile_;
};

std::optional<std::string> text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::string text(rules::kMostBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad() || file.gcount() == 0) return std::nullopt;
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

}  // namespace

std::optional<Thresholds> Profile::thresholds(std::optional<double> scale) const {
  if (sizes) return sizes;
  if (map_mm && scale) return map_thresholds(*map_mm, *scale);
  return std::nullopt;
}

Profile with_edge_min(Profile profile, double edge_min_m) {
  const double ratio = edge_min_m / profile.edge_min_m.value_or(edge_min_m);
  profile.edge_min_m = edge_min_m;
  if (profile.edge_owner_b_m) *profile.edge_owner_b_m *= ratio;
  if (profile.sizes) {
    const Thresholds& t = *profile.sizes;
    profile.sizes = {ratio * t.a_m, ratio * t.b_m, ratio * t.c_m, ratio * ratio * t.area_m2};
  }
  return profile;
}

Checked<Profile> load_profile(std::string text, std::string file, const std::string& level) {
  Checked<Profile> out;
  Profile profile;
  profile.sha256 = sha256(text);
  const rules::Source source(std::move(file), std::move(text));
  Findings findings(source);
  const std::size_t bad = rules::find_bad_byte(source.text());
  if (bad != std::string_view::npos)
    findings.error(Code::R200, {bad, bad}, "this is not UTF-8 text");
  else if (const auto root = rules::parse_yaml({0, source.text().size()}, findings))
    ProfileReader(findings, profile).read(*root, level);
  out.issues = findings.issues();
  if (!findings.has_errors()) out.value = std::move(profile);
  return out;
}

Checked<Profile> load_profile_file(const std::string& name_and_level) {
  const std::size_t colon = name_and_level.rfind(':');
  const std::string name = name_and_level.substr(0, colon);
  const std::string level = colon == std::string::npos ? "" : name_and_level.substr(colon + 1);
  for (const rules::EmbeddedPack& profile : rules::embedded_profiles())
    if (profile.name == name) return load_profile(std::string(profile.text), name + ".yaml", level);
  if (auto text = text_of_file(name)) return load_profile(std::move(*text), name, level);
  Issue issue;
  issue.code = Code::R200;
  const std::string near = did_you_mean(name, embedded_profiles());
  issue.sentence =
      "there is no profile here that can be read" +
      (near.empty() ? "; the profiles built in are: " + join(embedded_profiles()) : near);
  issue.place.file = name;
  return {std::nullopt, {std::move(issue)}};
}

std::vector<std::string> embedded_profiles() {
  std::vector<std::string> names;
  for (const rules::EmbeddedPack& profile : rules::embedded_profiles())
    names.emplace_back(profile.name);
  return names;
}

namespace {

Issue profile_warning(const Profile& profile, Code code, std::string sentence) {
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = code;
  issue.sentence = std::move(sentence);
  issue.place.file = profile.name;
  return issue;
}

}  // namespace

std::vector<Issue> check_profile(const Profile& profile, const RuleBase& base, ProfileUse use,
                                 bool has_neighbours) {
  std::vector<Issue> issues;
  const auto has_class = [&](const std::string& name) {
    const auto& classes = base.pack().classes;
    return std::ranges::find(classes, name, &rules::Class::name) != classes.end();
  };
  for (const auto* list : {&profile.omit, &profile.keep})
    for (const std::string& name : *list)
      if (!has_class(name))
        issues.push_back(profile_warning(
            profile, Code::R273,
            fmt::format("the profile {} names the class '{}', which the pack {} does not have",
                        profile.title(), name, base.name())));
  if (use != ProfileUse::level && profile.form != Profile::Form::as_is)
    issues.push_back(profile_warning(
        profile, Code::R276,
        fmt::format("the profile {} makes blocks, which are a level of detail: at a scale the "
                    "building keeps its form",
                    profile.title())));
  if (profile.groups && use == ProfileUse::tiles) {
    issues.push_back(profile_warning(
        profile, Code::R278,
        fmt::format("the profile {} makes one of buildings that adjoin, but tiles show some of "
                    "them at another scale than the rest; make levels with --series",
                    profile.title())));
    issues.back().severity = Severity::error;
  } else if (profile.groups && (use == ProfileUse::level || !has_neighbours)) {
    issues.push_back(profile_warning(
        profile, Code::R277,
        fmt::format("the profile {} makes one of buildings that adjoin, which needs --scale and "
                    "--neighbours: each stays by itself",
                    profile.title())));
  }
  return issues;
}

}  // namespace oriel
