#pragma once

#include "studio/session/session.h"

#include <functional>
#include <string>

namespace oriel::studio {

/// How a studio is served.
struct ServeOptions {
  /// 0: one that is free.
  int port = 0;
  /// Called once, with the address: requests to it are answered from now on.
  std::function<void(const std::string& address)> begun;
};

/// Serves a session on 127.0.0.1 until SIGINT, SIGTERM or SIGHUP, in a worker that is started again
/// where it crashes (supervise); true then. False if it crashed again and again. Throws
/// std::system_error if the port cannot be had.
bool serve(const SessionOptions& session, const ServeOptions& options);

}  // namespace oriel::studio
