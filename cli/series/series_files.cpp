#include "cli/series/series_files.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

Format format_of_input(const LabelArguments& arguments, const std::string& input) {
  if (const auto format = arguments.read_options(input).format) return *format;
  return format_of(input).value_or(Format::cityjson);
}

void check_outputs(const LabelArguments& arguments) {
  if (arguments.out == "-" || arguments.out.ends_with('/'))
    refuse_usage("-o", Code::G414, "the files of a series need a name: -o NAME");
  if (!arguments.to.empty())
    refuse_usage("--to", Code::G414,
                 "the levels of a series are CityJSON, those of streams streams");
  if (arguments.is_isolated || !arguments.reuse.empty() || arguments.is_resumable)
    refuse_usage("--series", Code::G414,
                 "does not work with --isolate, --reuse and --resume, which are of one scale");
}

}  // namespace

SeriesFiles::Kind SeriesFiles::kind_of(const LabelArguments& arguments) {
  const auto streams = std::ranges::count_if(arguments.inputs, [&](const std::string& input) {
    return format_of_input(arguments, input) == Format::cityjson_seq;
  });
  if (streams == 0) return arguments.inputs.size() == 1 ? Kind::one_file : Kind::several_files;
  if (std::cmp_not_equal(streams, arguments.inputs.size()))
    refuse_usage("input", Code::G414,
                 "streams and files make no common series: oriel cat turns files into streams");
  return Kind::streams;
}

SeriesFiles::SeriesFiles(const LabelArguments& arguments, const std::vector<double>& scales)
    : arguments_(arguments),
      scales_(scales),
      kind_(kind_of(arguments)),
      levels_(scales.size()),
      headers_(kind_ == Kind::streams ? CommonHeader::Of::stream : CommonHeader::Of::file) {
  check_outputs(arguments);
}

std::string SeriesFiles::path_of(double scale) const {
  return fmt::format("{}.1-{}.city.json{}", arguments_.out, scale,
                     kind_ == Kind::streams ? "l" : "");
}

void SeriesFiles::begin(std::size_t input, bool is_rehearsal) {
  input_ = input;
  is_first_ = true;
  if (input > 0 && log_) {
    for (Level& level : levels_)
      if (level.destination) level.destination->begin(input, is_rehearsal);
    return;
  }
  ids_.clear();
  headers_ =
      CommonHeader(kind_ == Kind::streams ? CommonHeader::Of::stream : CommonHeader::Of::file);
  const auto path = [&](const std::string& name) { return is_rehearsal ? "/dev/null" : name; };
  log_ = std::make_unique<OutputFile>(path(arguments_.out + ".oplog.jsonl"));
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    levels_[i] = {};
    if (kind_ == Kind::one_file) {
      levels_[i].destination = std::make_unique<OutputSink>(
          path_of(scales_[i]), "cityjson", arguments_.inputs, arguments_.read_options().format);
      levels_[i].destination->begin(input, is_rehearsal);
    } else {
      levels_[i].file = std::make_unique<OutputFile>(path(path_of(scales_[i])));
    }
  }
}

std::optional<std::string> SeriesFiles::twin(const Document& document,
                                             const std::vector<std::string>& texts) const {
  for (const Building& building : document.buildings)
    if (ids_.contains(building.id)) return building.id;
  if (kind_ == Kind::streams) return std::nullopt;
  for (std::size_t i = 0; i < texts.size(); ++i)
    if (!texts[i].empty())
      if (auto id = levels_[i].collector.twin_in(texts[i])) return id;
  return std::nullopt;
}

/// The header of an input, or the whole of it.
void SeriesFiles::check_header(const std::string& header, const Document& document) {
  const std::string& input = arguments_.inputs[input_];
  if (const auto issue = headers_.check(header, input)) throw InputError(*issue);
  if (kind_ != Kind::streams || input_ == 0 || document.buildings.empty()) return;
  Issue issue;
  issue.code = Code::G414;
  issue.sentence =
      "has buildings in its header, which is not the first: oriel cat makes lines of it";
  issue.place.file = input;
  throw InputError(std::move(issue));
}

void SeriesFiles::add_text(Level& level, const std::string& text, bool is_header) const {
  if (kind_ == Kind::streams) {
    if (!is_header || input_ == 0) level.file->append(text);
  } else if (is_header) {
    level.collector.add_file(text);
  } else {
    level.collector.add(text);
  }
}

std::optional<std::string> SeriesFiles::add(const Document& document,
                                            const std::vector<OutputRecord>& levels,
                                            const std::string& lines) {
  const bool is_header = std::exchange(is_first_, false);
  std::vector<std::string> texts;
  if (kind_ != Kind::one_file)
    for (const OutputRecord& level : levels) texts.push_back(write(document, level));
  if (is_header && !texts.empty()) check_header(texts[0], document);
  if (auto id = twin(document, texts)) return id;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    if (kind_ == Kind::one_file)
      levels_[i].destination->add(document, levels[i].buildings, levels[i].options);
    else
      add_text(levels_[i], texts[i], is_header);
  }
  if (arguments_.inputs.size() > 1)
    for (const Building& building : document.buildings) ids_.insert(building.id);
  log_->append(lines);
  return std::nullopt;
}

void SeriesFiles::end() {
  has_ended_ = true;
  for (Level& level : levels_)
    if (level.destination) level.destination->end();
}

void SeriesFiles::commit() {
  if (!has_ended_) return;
  for (Level& level : levels_) {
    if (!level.file) continue;
    if (kind_ == Kind::several_files) level.file->append(level.collector.text());
    level.file->commit();
  }
  log_->commit();
}

}  // namespace oriel::cli
