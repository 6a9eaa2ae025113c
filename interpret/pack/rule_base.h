#pragma once

#include "kernel/base/issue.h"
#include "model/plan.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel {

namespace rules {
struct Pack;
struct PackValues;
}  // namespace rules

/// A rule pack that was checked and is ready to be run, with values of its params. A handle: copies
/// share the pack, which never changes, so that threads may use one at a time.
class RuleBase {
 public:
  /// At the values that the pack states.
  explicit RuleBase(std::shared_ptr<const rules::Pack> pack);
  RuleBase(std::shared_ptr<const rules::Pack> pack, const rules::PackValues& values,
           std::string sha256);

  /// As the pack states them.
  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] const std::string& version() const;
  /// The name it was loaded under, as places show it.
  [[nodiscard]] const std::string& file() const;
  /// That one and the packs that it extends, the nearest first.
  [[nodiscard]] std::vector<std::string> files() const;
  /// Of the pack's text, 64 hexadecimal digits; of a pack that extends others of theirs, too: with
  /// d the digest so far and t the next text, sha256(d + sha256(t)). With other values as
  /// with_params() says.
  [[nodiscard]] const std::string& sha256() const { return sha256_; }
  /// The labels it may give, in the order of the pack.
  [[nodiscard]] std::vector<std::string> labels() const;
  [[nodiscard]] std::size_t rule_count() const;
  /// The code lists that `emit:` has codes for, sorted.
  [[nodiscard]] std::vector<std::string> codelists() const;

  /// What no operation must change by more than that, at any scale.
  [[nodiscard]] const Limits& limits() const;

  /// By column of feature_schema() and by position in relation_schema(): what interpret() and
  /// annotate() without reasons read of a building's features.
  [[nodiscard]] std::vector<bool> attributes_read() const;
  [[nodiscard]] std::vector<bool> relations_read() const;

  /// The inside, for interpret's own files.
  [[nodiscard]] const rules::Pack& pack() const { return *pack_; }
  [[nodiscard]] const std::shared_ptr<const rules::Pack>& shared_pack() const { return pack_; }
  [[nodiscard]] const rules::PackValues& values() const { return *values_; }

 private:
  std::shared_ptr<const rules::Pack> pack_;
  std::shared_ptr<const rules::PackValues> values_;
  std::string sha256_;
};

/// The pack in `text` (docs/rules.md is the language), called `file` in places. All findings come
/// at once, in the order of the text, each with code (R2xx), file:line:column, source line and
/// caret; with an error among them there is no value. Nothing is read but `text`;
/// it may extend packs that are built in.
Checked<RuleBase> load_pack(std::string text, std::string file);

/// The embedded pack called `path`, else the pack in the file at `path`. R200 if there is neither.
/// It may extend files in its own folder. Nothing else is read.
Checked<RuleBase> load_pack_file(const std::string& path);

/// The pack that load_pack_file would load, in canonical form with its comments: read again it says
/// the same, and in the same form. Findings are those of loading it; with an error among them there
/// is no text.
Checked<std::string> format_pack_file(const std::string& path);
/// The same of `text`, which is to be the file at `path`.
Checked<std::string> format_pack(std::string text, const std::string& path);

/// The same pack with those that it extends put into one, without comments: what comes of
/// overriding and removing.
Checked<std::string> merge_pack_file(const std::string& path);

/// A page in Markdown that says what that pack says: classes, params with their reasons, rules in
/// plain words, what becomes of features at which scale.
Checked<std::string> describe_pack_file(const std::string& path);

/// The text of a pack that was built into the library ("residential"), or nothing.
std::optional<std::string_view> embedded_pack(std::string_view name);

/// The names of the packs that were built in, sorted.
std::vector<std::string> embedded_packs();

}  // namespace oriel
