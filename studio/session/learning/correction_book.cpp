#include "studio/session/learning/correction_book.h"

#include "kernel/io/files/output_file.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

CorrectionBook::CorrectionBook(std::string path) : path_(std::move(path)) {
  std::vector<Correction> corrections;
  std::error_code problem;
  if (!path_.empty() && std::filesystem::exists(path_, problem)) {
    try {
      auto read = read_corrections(path_);
      issues_ = std::move(read.issues);
      if (read.value) corrections = std::move(*read.value);
    } catch (const InputError& fault) {
      issues_.push_back(fault.issue());
    }
  }
  become(std::move(corrections));
}

std::shared_ptr<const TruthOfSession> CorrectionBook::truth() const {
  const std::lock_guard lock(mutex_);
  return truth_;
}

std::vector<Correction> CorrectionBook::list() const {
  const std::lock_guard lock(mutex_);
  return corrections_;
}

void CorrectionBook::become(std::vector<Correction> corrections) {
  auto truth = std::make_shared<TruthOfSession>();
  truth->number = truth_ ? truth_->number + 1 : 0;
  truth->corrections = Corrections(corrections);
  corrections_ = std::move(corrections);
  truth_ = std::move(truth);
}

std::size_t CorrectionBook::correct(Correction correction, bool is_withdrawn) {
  const std::lock_guard lock(mutex_);
  if (path_.empty())
    throw RefusedRequest(400, "the studio was opened without a file of corrections");
  if (has_errors(issues_))
    throw RefusedRequest(
        409, fmt::format("'{}' has lines that cannot be read, which writing it would lose; mend it "
                         "and open the studio again",
                         path_));
  std::vector<Correction> corrections = corrections_;
  std::erase_if(corrections, [&](const Correction& other) {
    return other.building == correction.building && other.feature == correction.feature;
  });
  if (!is_withdrawn) corrections.push_back(std::move(correction));
  try {
    write_file(path_, corrections_text(corrections));
  } catch (const OutputError& fault) {
    throw RefusedRequest(500, fault.issue().sentence, fault.issue().code);
  }
  become(std::move(corrections));
  return corrections_.size();
}

}  // namespace oriel::studio
