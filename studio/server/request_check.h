#pragma once

#include "studio/session/session.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace oriel::studio {

/// The longest body of a request. Packs have kilobytes; lists of all buildings of a city, some
/// hundred.
inline constexpr std::uint64_t kMostBodyBytes = 8U << 20U;

/// What a request says of itself. A header that it lacks is nothing; one that it has twice is as
/// good as a wrong one.
struct RequestHead {
  std::string method;
  /// As it was sent, without what follows a `?`.
  std::string path;
  std::optional<std::string> host, origin, fetch_site, token, content_type, content_length;
  bool has_range = false;
  bool has_transfer_encoding = false;
  bool has_content_encoding = false;
};

/// What is served and by whom.
struct ServedAt {
  int port = 0;
  std::string token;
};

/// The verb of `/api/VERB`: letters and underscores only; nothing if the path is not of that kind.
std::optional<std::string_view> verb_of(std::string_view path);

/// The name of the built-in file that a path of the page means ("/" is page.html); empty: none.
std::string_view file_of(std::string_view path);

/// Nothing if the request may be answered; else what is said instead. In this order:
///
/// 1. Host is not 127.0.0.1 or localhost with our port: a page of another name that was made to
///    point here (DNS rebinding), 403.
/// 2. Origin is there and not ours, or Sec-Fetch-Site says that another site asks: 403.
/// 3. The path is neither a file of the page nor a verb: 404.
/// 4. The method is not GET or HEAD for a file, POST for a verb: 405.
/// 5. The token is missing or wrong: 403. Scripts and styles are parts of the program and need
/// none.
/// 6. A range of bytes: 400. An encoding: 415.
/// 7. Of a verb: no application/json: 415; no length: 411; longer than kMostBodyBytes: 413.
std::optional<Reply> refusal_of(const RequestHead& request, const ServedAt& served);

}  // namespace oriel::studio
