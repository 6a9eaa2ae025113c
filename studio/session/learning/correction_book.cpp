#include "studio/session/learning/correction_book.h"

#include "studio/session/saved_file.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

/// The text of a file without the lines of some corrections; with a line end if it is not empty.
std::string without_lines(std::string_view text, const std::vector<Correction>& corrections) {
  std::string rest;
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const auto is_it = [&](const Correction& one) { return one.place.line == number; };
    if (std::ranges::none_of(corrections, is_it)) rest.append(line).append("\n");
  }
  return rest;
}

}  // namespace

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
  const auto lines_of = [&](const std::vector<Correction>& all) {
    std::vector<Correction> lines;
    std::ranges::copy_if(all, std::back_inserter(lines), [&](const Correction& other) {
      return other.building == correction.building && other.feature == correction.feature;
    });
    return lines;
  };
  const std::string own =
      is_withdrawn ? std::string() : corrections_text({&correction, std::size_t{1}});
  const std::string saved = save_file(path_, [&](const std::optional<std::string>& on_disk) {
    const std::string text = on_disk.value_or("");
    auto read = corrections_in(text, path_);
    if (has_errors(read.issues))
      throw RefusedRequest(
          409, fmt::format("'{}' has lines that cannot be read; mend it and try again", path_));
    const std::vector<Correction> replaced = lines_of(*read.value);
    const std::string there = corrections_text(replaced);
    if (there != corrections_text(lines_of(corrections_))) {
      become(std::move(*read.value));
      throw RefusedRequest(409, "someone else has corrected this part meanwhile; nothing was saved",
                           Code::none, {{"disk_text", there}, {"own_text", own}});
    }
    return without_lines(text, replaced) + own;
  });
  become(std::move(*corrections_in(saved, path_).value));
  return corrections_.size();
}

}  // namespace oriel::studio
