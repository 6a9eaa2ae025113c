#include "interpret/language/findings.h"

#include <algorithm>
#include <utility>

namespace oriel::rules {

namespace {
constexpr std::size_t kMostFindings = 200;
/// Nobody reads more, and repetitions must not fill the memory.
constexpr std::size_t kMostKept = 10'000;
}  // namespace

void Findings::error(Code code, SourceSpan where, std::string sentence) {
  ++errors_;
  add(Severity::error, code, where, std::move(sentence));
}

void Findings::warning(Code code, SourceSpan where, std::string sentence) {
  add(Severity::warning, code, where, std::move(sentence));
}

void Findings::note(Code code, SourceSpan where, std::string sentence) {
  add(Severity::note, code, where, std::move(sentence));
}

void Findings::add(Severity severity, Code code, SourceSpan where, std::string sentence) {
  const auto is_around = [&](SourceSpan silenced) {
    return silenced.begin <= where.begin && where.begin <= silenced.end;
  };
  if (std::ranges::any_of(silenced_, is_around)) return;
  if (findings_.size() < kMostKept)
    findings_.push_back({where, severity, code, std::move(sentence)});
}

std::vector<SpannedFinding> Findings::spanned() const {
  auto sorted = findings_;
  std::ranges::sort(sorted);
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted.size() > kMostFindings) {
    // Errors before warnings, so that what makes the pack invalid is not among what is left out.
    std::stable_partition(sorted.begin(), sorted.end(),
                          [](const SpannedFinding& f) { return f.severity == Severity::error; });
    sorted.resize(kMostFindings);
  }
  return sorted;
}

std::vector<Issue> Findings::issues() const {
  std::vector<Issue> issues;
  for (const SpannedFinding& f : spanned())
    issues.push_back(
        {f.severity, f.code, f.sentence, source_->place(f.where.begin), source_->excerpt(f.where)});
  return issues;
}

}  // namespace oriel::rules
