#pragma once

#include <string>
#include <utility>

namespace oriel::test {

/// A connection to a port of 127.0.0.1.
class RawClient {
 public:
  explicit RawClient(int port);
  ~RawClient();
  RawClient(RawClient&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  /// The other side may have answered, and closed, before it has read everything.
  void send(const std::string& bytes);
  /// Says that nothing more is sent.
  void end();
  /// True if the other side has closed, and takes nothing more.
  [[nodiscard]] bool is_refused() const;
  /// All that comes until the other side closes.
  std::string read();

 private:
  int descriptor_;
};

/// The whole answer to bytes that are sent to a port of 127.0.0.1, which is read until the other
/// side closes. With `ends` nothing more is sent after them.
std::string answer_to(int port, const std::string& bytes, bool ends = false);

/// The number in the first line of an answer; 0: there is none.
int status_in(const std::string& answer);

/// What follows the head of an answer.
std::string body_in(const std::string& answer);

}  // namespace oriel::test
