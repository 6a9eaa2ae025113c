#include "cli/streams/common_header.h"

#include "kernel/io/cityjson/stream_header.h"

#include <fmt/format.h>

namespace oriel::cli {

std::optional<Issue> CommonHeader::check(const std::string& header, const std::string& input) {
  const bool is_file = of_ == Of::file;
  const std::string facts = is_file ? file_facts(header) : stream_header_facts(header);
  if (facts_.empty()) {
    facts_ = facts;
    input_ = input;
  }
  if (facts == facts_) return std::nullopt;
  Issue issue;
  issue.code = Code::E116;
  issue.sentence = fmt::format("has the header {}, but that of {} is {}: they share no {}", facts,
                               input_, facts_, is_file ? "file" : "stream");
  issue.place.file = input;
  return issue;
}

}  // namespace oriel::cli
