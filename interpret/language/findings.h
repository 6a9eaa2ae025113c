#pragma once

#include "interpret/language/source.h"
#include "kernel/base/issue.h"

#include <string>
#include <vector>

namespace oriel::rules {

/// One of them with the whole piece of text that it is about.
struct SpannedFinding {
  SourceSpan where;
  Severity severity = Severity::error;
  Code code = Code::none;
  std::string sentence;
  friend auto operator<=>(const SpannedFinding&, const SpannedFinding&) = default;
};

/// Collects what is wrong with a pack, each finding with its place and excerpt.
class Findings {
 public:
  explicit Findings(const Source& source) : source_(&source) {}

  void error(Code code, SourceSpan where, std::string sentence);
  void warning(Code code, SourceSpan where, std::string sentence);
  void note(Code code, SourceSpan where, std::string sentence);
  /// What is wrong at `where` has been said: what is found there from now on is not reported, but
  /// counts as an error all the same.
  void silence(SourceSpan where) { silenced_.push_back(where); }

  [[nodiscard]] bool has_errors() const { return errors_ > 0; }
  [[nodiscard]] std::size_t error_count() const { return errors_; }
  [[nodiscard]] const Source& source() const { return *source_; }

  /// All findings in the order of the text, without repetition; of a great many the first 200.
  [[nodiscard]] std::vector<Issue> issues() const;
  /// The same findings in the same order.
  [[nodiscard]] std::vector<SpannedFinding> spanned() const;

 private:
  void add(Severity severity, Code code, SourceSpan where, std::string sentence);

  const Source* source_;
  std::vector<SpannedFinding> findings_;
  std::vector<SourceSpan> silenced_;
  std::size_t errors_ = 0;
};

}  // namespace oriel::rules
