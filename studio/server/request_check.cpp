#include "studio/server/request_check.h"

#include "studio/server/token.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

constexpr std::string_view kApi = "/api/";

bool is_of_here(const std::optional<std::string>& text, std::string_view scheme, int port) {
  return text && (*text == fmt::format("{}127.0.0.1:{}", scheme, port) ||
                  *text == fmt::format("{}localhost:{}", scheme, port));
}

bool comes_from_elsewhere(const RequestHead& request, const ServedAt& served) {
  if (request.origin && !is_of_here(request.origin, "http://", served.port)) return true;
  return request.fetch_site && *request.fetch_site != "same-origin" &&
         *request.fetch_site != "none";
}

/// Another site may lead here by a link: the token in the address then decides. "none" is an
/// address that was typed.
bool is_link_to_page(const RequestHead& request) {
  return request.path == "/" && request.method == "GET" && !request.origin;
}

bool is_json(const std::optional<std::string>& type) {
  if (!type) return false;
  std::string_view name(*type);
  name = name.substr(0, name.find(';'));
  while (name.ends_with(' ')) name.remove_suffix(1);
  return name == "application/json";
}

std::optional<Reply> refusal_of_length(const std::optional<std::string>& length) {
  if (!length) return error_reply(411, "the request does not say how long it is");
  std::uint64_t bytes = 0;
  const char* end = length->data() + length->size();
  const auto [last, fault] = std::from_chars(length->data(), end, bytes);
  if (fault == std::errc::result_out_of_range || (last == end && bytes > kMostBodyBytes))
    return error_reply(413, fmt::format("the request is longer than {} bytes", kMostBodyBytes));
  if (last != end || length->empty())
    return error_reply(400, "the length of the request is not a number");
  return std::nullopt;
}

std::optional<Reply> refusal_of_verb(const RequestHead& request) {
  if (!is_json(request.content_type))
    return error_reply(415, "a request of the page is application/json");
  return refusal_of_length(request.content_length);
}

}  // namespace

std::optional<std::string_view> verb_of(std::string_view path) {
  if (!path.starts_with(kApi)) return std::nullopt;
  const std::string_view verb = path.substr(kApi.size());
  const bool is_word =
      std::ranges::all_of(verb, [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; });
  if (verb.empty() || verb.size() > 32 || !is_word) return std::nullopt;
  return verb;
}

std::string_view file_of(std::string_view path) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kFiles{
      {{"/", "page.html"},
       {"/studio.js", "studio.js"},
       {"/studio.css", "studio.css"},
       {"/licences.txt", "licences.txt"}}};
  for (const auto& [served, file] : kFiles)
    if (served == path) return file;
  return {};
}

std::optional<Reply> refusal_of(const RequestHead& request, const ServedAt& served) {
  if (!is_of_here(request.host, "", served.port))
    return error_reply(403, "the request is for another host");
  if (comes_from_elsewhere(request, served) && !is_link_to_page(request))
    return error_reply(403, "the request comes from another site");
  const bool is_file = !file_of(request.path).empty();
  if (!is_file && !verb_of(request.path)) return error_reply(404, "there is nothing here");
  const bool is_read = request.method == "GET" || request.method == "HEAD";
  if (is_file ? !is_read : request.method != "POST")
    return error_reply(405,
                       is_file ? "a file of the page is only read" : "a verb is asked by POST");
  const bool is_open = is_file && request.path != "/";
  if (!is_open && (!request.token || !is_same_token(served.token, *request.token)))
    return error_reply(
        403, "the token is missing or wrong: open the address that oriel studio has printed");
  if (request.has_range) return error_reply(400, "parts of an answer cannot be had");
  if (request.has_transfer_encoding) return error_reply(411, "the request comes in pieces");
  if (request.has_content_encoding) return error_reply(415, "the request is compressed");
  return is_file ? std::nullopt : refusal_of_verb(request);
}

}  // namespace oriel::studio
