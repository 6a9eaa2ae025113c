#include "interpret/compile/counts.h"

#include "interpret/pack/names.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

std::string text_of(const Class& c, const Typical& typical) {
  const std::string high = typical.high == Typical::kNoEnd ? "" : fmt::format(" {}", typical.high);
  return fmt::format("{} ..{} '{}' per {}", typical.low, high, c.name, typical.per);
}

/// True if there can be no more of `part` than of `whole`.
bool is_part(const Typical& part, const Typical& whole) {
  return part.per == whole.per || whole.per == "building";
}

class CountChecker {
 public:
  CountChecker(const Pack& pack, Findings& findings) : pack_(&pack), findings_(&findings) {}

  void run() {
    for (ClassId id = 0; id < static_cast<ClassId>(pack_->classes.size()); ++id)
      for (const Typical& typical : at(id).typical)
        if (!report_impossible(id, typical) && pack_->source.is_in_first(typical.span.begin))
          report_unused(id, typical);
  }

 private:
  [[nodiscard]] const Class& at(ClassId id) const {
    return pack_->classes[static_cast<std::size_t>(id)];
  }

  bool report_impossible(ClassId id, const Typical& typical) {
    for (ClassId above = id; above != kNoClass; above = at(above).parent)
      for (const Typical& whole : at(above).typical) {
        if (!is_part(typical, whole) || typical.low <= whole.high) continue;
        const Place place = pack_->source.place(whole.span.begin);
        findings_->error(
            Code::R212, typical.span,
            fmt::format("{} and {} ({}:{}:{}) exclude each other", text_of(at(id), typical),
                        text_of(at(above), whole), place.file, place.line, place.column));
        return true;
      }
    return false;
  }

  void report_unused(ClassId id, const Typical& typical) {
    if (!pack_->decide.evidence.is_written()) {
      findings_->warning(Code::R257, typical.span,
                         fmt::format("'typical' of '{}' says nothing: 'evidence' under 'decide' "
                                     "says how much it may add",
                                     at(id).name));
      return;
    }
    const bool is_labelled = std::ranges::any_of(pack_->rules, [&](const Rule& rule) {
      return !at(rule.label).is_abstract && is_within(pack_->classes, rule.label, id);
    });
    if (is_labelled) return;
    findings_->warning(Code::R257, typical.span,
                       fmt::format("'typical' of '{}' says nothing: no rule has this label{}",
                                   at(id).name, at(id).is_abstract ? " or one beneath it" : ""));
  }

  const Pack* pack_;
  Findings* findings_;
};

}  // namespace

void relate_counts(Pack& pack) {
  const int storey = relation_number(pack, "same_storey");
  const int facade = relation_number(pack, "same_facade");
  for (Class& c : pack.classes)
    for (Typical& typical : c.typical)
      if (typical.per != "building") typical.relation = typical.per == "storey" ? storey : facade;
}

std::vector<int> evidence_relations(const Pack& pack) {
  if (!pack.decide.evidence.is_written()) return {};
  std::vector<int> relations = pack.decide.evidence.company;
  for (const Class& c : pack.classes)
    for (const Typical& typical : c.typical)
      if (typical.relation >= 0) relations.push_back(typical.relation);
  return relations;
}

void check_counts(const Pack& pack, Findings& findings) { CountChecker(pack, findings).run(); }

}  // namespace oriel::rules
