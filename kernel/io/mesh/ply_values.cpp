#include "kernel/io/mesh/ply_values.h"

#include "kernel/base/text/counted.h"
#include "kernel/io/json/words.h"

#include <bit>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// One line for each element.
class PlyWords final : public PlyValues {
 public:
  PlyWords(std::string_view text, const TextName& name, std::size_t start)
      : name_(name), text_(text), words_(text, start) {}

  bool next_element() override { return words_.next_line(); }

  std::optional<double> number(const PlyProperty& property, Fault& wrong) override {
    const std::string_view text = word();
    const auto number = as_double(text);
    if (!number)
      wrong = {Code::E110, text.empty()
                               ? fmt::format("the line ends before the property {}", property.name)
                               : fmt::format("{} is not a number", in_quotes(text))};
    return number;
  }

  std::optional<long long> length(const PlyProperty& /*property*/, Fault& wrong) override {
    const std::string_view text = word();
    const auto count = as_whole(text);
    if (count && *count >= 0) return count;
    wrong = {Code::E110, fmt::format("{} is not the length of a list", in_quotes(text))};
    return std::nullopt;
  }

  std::optional<long long> whole(const PlyProperty& property, Fault& wrong) override {
    const std::string_view text = word();
    const auto number = as_whole(text);
    if (!number)
      wrong = {Code::E110, text.empty()
                               ? fmt::format("the line ends within the list {}", property.name)
                               : fmt::format("{} is not a whole number", in_quotes(text))};
    return number;
  }

  std::optional<std::string> rest_of_element() override {
    if (const auto more = words_.next_word()) return in_quotes(*more) + " follows";
    return std::nullopt;
  }

  std::optional<std::string> rest_of_file() override {
    if (!words_.next_line()) return std::nullopt;
    return in_quotes(word()) + " follows";
  }

  [[nodiscard]] Issue error(const std::string& /*element*/, Fault fault) const override {
    return error_at(name_, text_, words_.offset(), std::move(fault));
  }

 private:
  /// The next word, or an empty one at the line's end.
  std::string_view word() { return words_.next_word().value_or(std::string_view()); }

  const TextName& name_;
  std::string_view text_;
  WordReader words_;
};

/// Elements without anything between them.
class PlyBytes final : public PlyValues {
 public:
  PlyBytes(std::string_view text, const TextName& name, const PlyHeader& header)
      : name_(name),
        rest_(text.substr(header.end)),
        is_little_endian_(header.encoding == PlyEncoding::little_endian) {}

  bool next_element() override { return !rest_.empty(); }

  std::optional<double> number(const PlyProperty& property, Fault& wrong) override {
    return read(property.type, property, wrong);
  }

  std::optional<long long> length(const PlyProperty& property, Fault& wrong) override {
    const auto count = read(*property.length_type, property, wrong);
    if (!count) return std::nullopt;
    if (*count >= 0) return static_cast<long long>(*count);
    wrong = {Code::E110, fmt::format("{} is not the length of a list", *count)};
    return std::nullopt;
  }

  std::optional<long long> whole(const PlyProperty& property, Fault& wrong) override {
    const auto number = read(property.type, property, wrong);
    if (!number) return std::nullopt;
    // Whole numbers of a PLY file have at most four bytes.
    if (*number == std::floor(*number) && std::abs(*number) < 0x1p32)
      return static_cast<long long>(*number);
    wrong = {Code::E110, fmt::format("{} is not a whole number", *number)};
    return std::nullopt;
  }

  std::optional<std::string> rest_of_element() override { return std::nullopt; }

  std::optional<std::string> rest_of_file() override {
    if (rest_.empty()) return std::nullopt;
    return fmt::format("{} {}", counted(rest_.size(), "byte"),
                       agreeing(rest_.size(), "follows", "follow"));
  }

  [[nodiscard]] Issue error(const std::string& element, Fault fault) const override {
    if (!element.empty()) fault.sentence = fmt::format("{}: {}", element, fault.sentence);
    return error_in(name_, std::move(fault));
  }

 private:
  std::optional<double> read(PlyType type, const PlyProperty& property, Fault& wrong) {
    const std::size_t size = size_of(type);
    if (rest_.size() < size) {
      wrong = {Code::E105, fmt::format("the file ends within the property {}", property.name)};
      return std::nullopt;
    }
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i)
      bits = bits << 8U | static_cast<unsigned char>(rest_[is_little_endian_ ? size - 1 - i : i]);
    rest_.remove_prefix(size);
    return number_of(type, bits);
  }

  static double number_of(PlyType type, std::uint64_t bits) {
    switch (type) {
      case PlyType::int8:
        return static_cast<std::int8_t>(bits);
      case PlyType::int16:
        return static_cast<std::int16_t>(bits);
      case PlyType::int32:
        return static_cast<std::int32_t>(bits);
      case PlyType::float32:
        return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
      case PlyType::float64:
        return std::bit_cast<double>(bits);
      default:
        return static_cast<double>(bits);
    }
  }

  const TextName& name_;
  std::string_view rest_;
  bool is_little_endian_;
};

}  // namespace

std::unique_ptr<PlyValues> ply_values(std::string_view text, const TextName& name,
                                      const PlyHeader& header) {
  if (header.encoding == PlyEncoding::words)
    return std::make_unique<PlyWords>(text, name, header.end);
  return std::make_unique<PlyBytes>(text, name, header);
}

}  // namespace oriel::detail
