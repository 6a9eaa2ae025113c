#pragma once

#include "studio/editing/edited_pack.h"
#include "studio/session/labels/labelled_buildings.h"
#include "studio/session/learning/correction_book.h"
#include "studio/session/pack_file.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace oriel::studio {

/// Labels the buildings with the pack that was edited last, and keeps what the last good one said.
/// Functions may be called from any thread; one pack is run at a time, and the newest wins.
class PackRunner {
 public:
  /// All of these must outlive it.
  PackRunner(const SessionOptions& options, const OpenBuildings& buildings,
             const CorrectionBook& corrections, const PackFile& file)
      : options_(options), buildings_(buildings), corrections_(corrections), file_(file) {}

  /// The verb `pack`. Throws RefusedRequest 409 {superseded: true} if another one came while it
  /// waited or ran.
  StudioJson run(const RequestBody& body);
  /// How many requests `pack` there were: another one has come where it is another number.
  [[nodiscard]] std::uint64_t requests() const { return newest_; }

  /// The last good pack with all buildings that are loaded by now; before any pack came, that of
  /// the file. Null: none was good.
  std::shared_ptr<const LabelledBuildings> current();
  /// The same; where there is none throws RefusedRequest 409.
  std::shared_ptr<const LabelledBuildings> need_current();

 private:
  [[nodiscard]] std::shared_ptr<const LabelledBuildings> last() const;
  std::shared_ptr<const LabelledBuildings> label(const RuleBase& rules, const std::string& text,
                                                 const std::vector<std::string>& assignments,
                                                 std::uint64_t ticket);
  [[nodiscard]] EditedPack edited(const std::string& text) const;

  const SessionOptions& options_;
  const OpenBuildings& buildings_;
  const CorrectionBook& corrections_;
  const PackFile& file_;
  /// The request that came last; those before it are given up.
  std::atomic<std::uint64_t> newest_ = 0;
  /// Held while a pack is run.
  std::mutex running_;
  bool has_begun_ = false;
  mutable std::mutex mutex_;
  std::shared_ptr<const LabelledBuildings> last_;
};

}  // namespace oriel::studio
