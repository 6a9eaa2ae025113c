#include "studio/session/session.h"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::studio {

Reply error_reply(int status, std::string_view sentence, std::string_view code) {
  nlohmann::ordered_json json{{"error", sentence}};
  if (!code.empty()) json["code"] = code;
  return {status, json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)};
}

struct Session::Inside {
  SessionOptions options;
};

Session::Session(SessionOptions options)
    : inside_(std::make_unique<Inside>(Inside{std::move(options)})) {}

Session::~Session() = default;

Reply Session::answer(std::string_view verb, std::string_view body) {
  if (!nlohmann::json::parse(body, nullptr, false).is_object())
    return error_reply(400, "the body of a request is a JSON object");
  return error_reply(404, fmt::format("there is no verb '{}'", verb));
}

}  // namespace oriel::studio
