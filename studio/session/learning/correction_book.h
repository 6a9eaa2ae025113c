#pragma once

#include "oriel/corrections.h"
#include "studio/session/labels/building_score.h"
#include "studio/session/request_body.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace oriel::studio {

/// The file of corrections, to which others may write, too. Functions may be called from any
/// thread.
class CorrectionBook {
 public:
  /// `path` need not exist yet.
  explicit CorrectionBook(std::string path);

  [[nodiscard]] const std::string& path() const { return path_; }
  /// What could not be read of it.
  [[nodiscard]] const std::vector<Issue>& issues() const { return issues_; }
  [[nodiscard]] std::shared_ptr<const TruthOfSession> truth() const;
  [[nodiscard]] std::vector<Correction> list() const;

  /// Puts the correction in the place of earlier ones of the same feature; without a label
  /// (nothing) it only takes those away. All other lines of the file stay as they are. Returns how
  /// many it has then. Throws RefusedRequest if it cannot be written, 409 if it has lines that
  /// cannot be read, or, with `disk_text` and `own_text`, if the file says something else of the
  /// feature than list(): then nothing is written, and list() is what the file says.
  std::size_t correct(Correction correction, bool is_withdrawn);

 private:
  void become(std::vector<Correction> corrections);

  const std::string path_;
  std::vector<Issue> issues_;
  mutable std::mutex mutex_;
  std::vector<Correction> corrections_;
  std::shared_ptr<const TruthOfSession> truth_;
};

}  // namespace oriel::studio
