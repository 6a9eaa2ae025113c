#include "tests/studio/server/raw_request.h"

#include <arpa/inet.h>
#include <array>
#include <cstdlib>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <doctest/doctest.h>

namespace oriel::test {

RawClient::RawClient(int port) : descriptor_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  REQUIRE(::connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
}

RawClient::~RawClient() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void RawClient::send(const std::string& bytes) {
  ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
}

void RawClient::end() { ::shutdown(descriptor_, SHUT_WR); }

bool RawClient::is_refused() const { return ::send(descriptor_, "a", 1, MSG_NOSIGNAL) < 0; }

std::string RawClient::read() {
  std::string answer;
  std::array<char, 4096> part{};
  for (ssize_t count = 0; (count = ::recv(descriptor_, part.data(), part.size(), 0)) > 0;)
    answer.append(part.data(), static_cast<std::size_t>(count));
  return answer;
}

std::string answer_to(int port, const std::string& bytes, bool ends) {
  RawClient client(port);
  client.send(bytes);
  if (ends) client.end();
  return client.read();
}

int status_in(const std::string& answer) {
  return answer.starts_with("HTTP/1.1 ") ? std::atoi(answer.c_str() + 9) : 0;
}

std::string body_in(const std::string& answer) {
  const std::size_t at = answer.find("\r\n\r\n");
  return at == std::string::npos ? std::string() : answer.substr(at + 4);
}

}  // namespace oriel::test
