#include "studio/lsp/message_stream.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <poll.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

bool is_same_word(std::string_view p, std::string_view q) {
  const auto small = [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  return std::ranges::equal(p, q, {}, small, small);
}

/// The length that a header states; lines may end with a line feed alone.
std::optional<std::size_t> length_in(std::string_view header) {
  while (!header.empty()) {
    const std::size_t end = std::min(header.find('\n'), header.size());
    std::string_view line = header.substr(0, end);
    header.remove_prefix(std::min(end + 1, header.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || !is_same_word(line.substr(0, colon), "content-length"))
      continue;
    std::string_view number = line.substr(colon + 1);
    while (number.starts_with(' ')) number.remove_prefix(1);
    while (number.ends_with(' ')) number.remove_suffix(1);
    std::size_t length = 0;
    const auto result = std::from_chars(number.data(), number.data() + number.size(), length);
    const bool is_whole = result.ec == std::errc() && result.ptr == number.data() + number.size();
    return is_whole && !number.empty() ? std::optional(length) : std::nullopt;
  }
  return std::nullopt;
}

/// Where the header ends, and how many bytes the empty line after it has.
std::optional<std::pair<std::size_t, std::size_t>> end_of_header(std::string_view text) {
  const std::size_t strict = text.find("\r\n\r\n");
  const std::size_t loose = text.find("\n\n");
  if (strict == std::string_view::npos && loose == std::string_view::npos) return std::nullopt;
  if (strict < loose) return std::pair(strict, std::size_t{4});
  return std::pair(loose, std::size_t{2});
}

}  // namespace

std::optional<MessageStream::Read> MessageStream::take() {
  const std::size_t passed = std::min(passed_over_, buffer_.size());
  buffer_.erase(0, passed);
  passed_over_ -= passed;
  if (passed_over_ > 0) return std::nullopt;
  const auto header = end_of_header(buffer_);
  if (!header && buffer_.size() <= kLongestHeader) return std::nullopt;
  if (!header) {
    buffer_.clear();
    return Read{ReadOutcome::unreadable, "a header without end"};
  }
  const auto length = length_in(std::string_view(buffer_).substr(0, header->first));
  const std::size_t begin = header->first + header->second;
  if (!length) {
    buffer_.erase(0, begin);
    return Read{ReadOutcome::unreadable, "a header without Content-Length: NUMBER"};
  }
  if (*length > kLongestBody) {
    buffer_.erase(0, begin);
    passed_over_ = *length;
    return Read{ReadOutcome::unreadable, fmt::format("a message of {} bytes is too long", *length)};
  }
  if (buffer_.size() - begin < *length) return std::nullopt;
  Read read{ReadOutcome::message, buffer_.substr(begin, *length)};
  buffer_.erase(0, begin + *length);
  return read;
}

MessageStream::FillResult MessageStream::fill(std::optional<std::chrono::milliseconds> patience) {
  pollfd waiting{in_, POLLIN, 0};
  const int ready = ::poll(&waiting, 1, patience ? static_cast<int>(patience->count()) : -1);
  if (ready == 0) return FillResult::nothing;
  if (ready < 0) return errno == EINTR ? FillResult::more : FillResult::end;
  std::array<char, 65536> bytes{};
  const ssize_t count = ::read(in_, bytes.data(), bytes.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return FillResult::more;
  if (count <= 0) return FillResult::end;
  buffer_.append(bytes.data(), static_cast<std::size_t>(count));
  return FillResult::more;
}

MessageStream::Read MessageStream::read(std::optional<std::chrono::milliseconds> patience) {
  while (true) {
    if (auto read = take()) return std::move(*read);
    const FillResult filling = fill(patience);
    if (filling == FillResult::nothing) return {ReadOutcome::silence, ""};
    if (filling == FillResult::end) return {ReadOutcome::end, ""};
  }
}

bool MessageStream::write(std::string_view body) {
  std::string message = fmt::format("Content-Length: {}\r\n\r\n", body.size());
  message += body;
  for (std::string_view left = message; !left.empty();) {
    const ssize_t count = ::write(out_, left.data(), left.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    left.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace oriel::studio
