#pragma once

namespace oriel::studio {

/// A socket on 127.0.0.1 that takes connections: they wait until somebody accepts them, also while
/// a worker is started again.
class ListeningSocket {
 public:
  /// `port` 0: one that is free. Throws std::system_error if it cannot be had.
  explicit ListeningSocket(int port);
  ~ListeningSocket();
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] int port() const { return port_; }

 private:
  int descriptor_ = -1;
  int port_ = 0;
};

}  // namespace oriel::studio
