#pragma once

#include "interpret/pack/rule_base.h"
#include "kernel/base/code.h"
#include "kernel/base/issue.h"
#include "studio/editing/completion/completion.h"
#include "studio/editing/pack_outline.h"
#include "studio/editing/quick_fixes.h"
#include "studio/editing/text_places.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// The text of a file that is open in an editor and may differ from that on disk; nothing of
/// others.
using OpenTexts = std::function<std::optional<std::string>(const std::string& path)>;

/// A finding of `rules check` about an edited text.
struct TextFinding {
  Severity severity = Severity::error;
  Code code = Code::none;
  std::string sentence{};
  /// What it is about. A fault in a pack beneath is shown at `extends:`, its place in the sentence.
  TextSpan where{};
  std::vector<QuickFix> fixes{};
};

/// What is known of the word at a place.
struct HoverText {
  std::string text{};  ///< plain, in lines
  TextSpan where{};
};

/// Where a name is stated.
struct DefinitionPlace {
  std::string file{};
  bool is_here = false;      ///< in the edited text
  bool is_built_in = false;  ///< in the embedded pack called `file` without ".yaml"
  TextPlace begin{};
  TextPlace end{};
};

/// The changes of one file; `text` is what it says before.
struct FileEdits {
  std::string file{};
  std::string text{};
  std::vector<TextEdit> edits{};
};

/// What renaming changes: the edited text first, then the tests next to it, then other files; or
/// why it cannot be.
struct Renaming {
  std::vector<FileEdits> files{};
  std::string refusal{};
};

/// The text of a rule pack, of a file of tests or of a profile, while somebody writes it: it may be
/// broken anywhere. All functions work on what can be read of it, and of the packs that it extends;
/// none throws for what stands in the text. Places are byte offsets in text(); places() converts
/// them. What is asked is found when it is asked first: for one thread at a time.
class EditedPack {
 public:
  enum class Kind { pack, tests, profile, other };

  /// `file` is the path that it has or will have: its folder is where packs that it extends are.
  EditedPack(std::string text, std::string file, OpenTexts open = {});
  ~EditedPack();
  EditedPack(EditedPack&&) noexcept;
  EditedPack& operator=(EditedPack&&) noexcept;

  /// What was given, without a byte order mark.
  [[nodiscard]] const std::string& text() const;
  [[nodiscard]] const std::string& file() const;
  [[nodiscard]] const TextPlaces& places() const;
  [[nodiscard]] Kind kind() const;

  /// All findings in the order of the text, as `rules check` has them, or of tests `rules test`.
  /// None for other files.
  [[nodiscard]] const std::vector<TextFinding>& findings() const;
  /// The pack, ready to be run; nothing if it has errors or is no pack.
  [[nodiscard]] std::optional<RuleBase> rules() const;

  /// What can be written at `offset`, the most likely first; what fits the letters before it is not
  /// chosen here.
  [[nodiscard]] std::vector<Completion> complete(std::size_t offset) const;
  [[nodiscard]] std::optional<HoverText> hover(std::size_t offset) const;
  [[nodiscard]] std::optional<DefinitionPlace> definition(std::size_t offset) const;
  /// What the outline is of, without what cannot be read.
  [[nodiscard]] std::vector<OutlineItem> outline() const;

  /// The name at `offset`, if it can be renamed: a param, class, macro, relation, group, fixture or
  /// rule that this pack alone states.
  [[nodiscard]] std::optional<TextSpan> renameable(std::size_t offset) const;
  /// Among the files `others` (paths of packs and tests) those that stand upon this pack say the
  /// new name, too; one that states that name already is a refusal.
  [[nodiscard]] Renaming rename(std::size_t offset, const std::string& name,
                                const std::vector<std::string>& others = {}) const;

  /// The text in canonical form, or nothing and the findings: a pack with errors is not formatted,
  /// nor is another file.
  [[nodiscard]] Checked<std::string> format() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace oriel
