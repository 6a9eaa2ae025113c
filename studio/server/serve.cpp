#include "studio/server/serve.h"

#include "studio/server/http_server.h"
#include "studio/server/listening_socket.h"
#include "studio/server/supervisor.h"
#include "studio/server/token.h"

#include <fmt/format.h>

namespace oriel::studio {

bool serve(const SessionOptions& session, const ServeOptions& options) {
  const ListeningSocket socket(options.port);
  const ServedAt served{socket.port(), random_token()};
  options.begun(fmt::format("http://127.0.0.1:{}/?token={}", served.port, served.token));
  const auto work = [&](WorkLog& log, bool is_careful) {
    SessionOptions own = session;
    own.work_log = &log;
    if (is_careful) {
      own.jobs = 1;
      own.for_each = for_each_in_turn;
    }
    Session kept(std::move(own));
    HttpServer server(
        socket.descriptor(), served,
        [&](std::string_view verb, std::string_view body) { return kept.answer(verb, body); });
    server.run();
  };
  return supervise(work) == Ending::asked;
}

}  // namespace oriel::studio
