#pragma once

#include <string>

namespace oriel::test {

/// The whole answer to bytes that are sent to a port of 127.0.0.1, which is read until the other
/// side closes. With `ends` nothing more is sent after them.
std::string answer_to(int port, const std::string& bytes, bool ends = false);

/// The number in the first line of an answer; 0: there is none.
int status_in(const std::string& answer);

/// What follows the head of an answer.
std::string body_in(const std::string& answer);

}  // namespace oriel::test
