#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace oriel::studio {

/// Messages of the Language Server Protocol: a header with `Content-Length`, an empty line, and a
/// body of that many bytes. Reads and writes file descriptors.
class MessageStream {
 public:
  /// A body that is longer is passed over.
  static constexpr std::size_t kLongestBody = 64U * 1024 * 1024;
  static constexpr std::size_t kLongestHeader = 8192;

  enum class ReadOutcome {
    message,
    unreadable,  ///< a header without a length that can be kept to, or too long a body
    silence,     ///< nothing came in time
    end          ///< nothing will come any more
  };
  struct Read {
    ReadOutcome outcome = ReadOutcome::end;
    std::string body;  ///< of a message; else what was wrong
  };

  MessageStream(int in, int out) : in_(in), out_(out) {}

  /// The next message; waits no longer than `patience` if there is one, else for ever.
  Read read(std::optional<std::chrono::milliseconds> patience);

  /// False if nobody reads any more.
  bool write(std::string_view body);

 private:
  /// What `buffer_` begins with, if it is whole.
  std::optional<Read> take();
  enum class FillResult { more, nothing, end };
  FillResult fill(std::optional<std::chrono::milliseconds> patience);

  int in_;
  int out_;
  std::string buffer_;
  /// Bytes of a body that is passed over.
  std::size_t passed_over_ = 0;
};

}  // namespace oriel::studio
