#include "studio/server/serve.h"

namespace oriel::studio {

bool serve(const SessionOptions& session, const ServeOptions& options) {
  const Session kept(session);
  options.begun("http://127.0.0.1:0/");
  return true;
}

}  // namespace oriel::studio
