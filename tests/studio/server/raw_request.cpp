#include "tests/studio/server/raw_request.h"

#include <arpa/inet.h>
#include <array>
#include <cstdlib>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <doctest/doctest.h>

namespace oriel::test {

std::string answer_to(int port, const std::string& bytes, bool ends) {
  const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  REQUIRE(::connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  // The other side may have answered, and closed, before it has read everything.
  ::send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (ends) ::shutdown(descriptor, SHUT_WR);
  std::string answer;
  std::array<char, 4096> part{};
  for (ssize_t count = 0; (count = ::recv(descriptor, part.data(), part.size(), 0)) > 0;)
    answer.append(part.data(), static_cast<std::size_t>(count));
  ::close(descriptor);
  return answer;
}

int status_in(const std::string& answer) {
  return answer.starts_with("HTTP/1.1 ") ? std::atoi(answer.c_str() + 9) : 0;
}

std::string body_in(const std::string& answer) {
  const std::size_t at = answer.find("\r\n\r\n");
  return at == std::string::npos ? std::string() : answer.substr(at + 4);
}

}  // namespace oriel::test
