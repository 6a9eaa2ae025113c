#include "studio/server/listening_socket.h"

#include <arpa/inet.h>
#include <cerrno>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

namespace oriel::studio {

namespace {

/// Connections that may wait: a worker that is started again takes none for a moment, and one that
/// finds no room here tries again only after a second.
constexpr int kMostWaiting = 4096;

void set_option(int descriptor, int level, int option) {
  const int on = 1;
  ::setsockopt(descriptor, level, option, &on, sizeof on);
}

}  // namespace

ListeningSocket::ListeningSocket(int port) {
  descriptor_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  // A studio may be opened again at once where another was. SO_REUSEPORT would let two share it.
  set_option(descriptor_, SOL_SOCKET, SO_REUSEADDR);
  // Head and body of an answer are two writes; connections that are accepted take this over.
  set_option(descriptor_, IPPROTO_TCP, TCP_NODELAY);
  auto* plain = reinterpret_cast<sockaddr*>(&address);
  if (descriptor_ < 0 || ::bind(descriptor_, plain, size) != 0 ||
      ::listen(descriptor_, kMostWaiting) != 0 || ::getsockname(descriptor_, plain, &size) != 0) {
    const int fault = errno;
    if (descriptor_ >= 0) ::close(descriptor_);
    throw std::system_error(fault, std::generic_category());
  }
  port_ = ntohs(address.sin_port);
}

ListeningSocket::~ListeningSocket() { ::close(descriptor_); }

}  // namespace oriel::studio
