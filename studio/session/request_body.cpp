#include "studio/session/request_body.h"

#include <array>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

[[noreturn]] void refuse_body(const std::string& sentence) { throw RefusedRequest(400, sentence); }

constexpr int kMaxLevels = 1000;

/// Stops the parser at a level too many: taking down a value of millions takes seconds.
bool check_level(int above, StudioJson::parse_event_t event, const StudioJson&) {
  using Event = StudioJson::parse_event_t;
  if (above >= kMaxLevels && (event == Event::array_start || event == Event::object_start))
    refuse_body(fmt::format("the body of the request is nested deeper than {} levels", kMaxLevels));
  return true;
}

std::size_t whole_number(const StudioJson& value, const char* key, std::size_t end,
                         const char* what) {
  if (!value.is_number_integer())
    refuse_body(fmt::format("'{}' must be a whole number, the number of a {}", key, what));
  const bool is_negative = !value.is_number_unsigned() && value.get<std::int64_t>() < 0;
  if (is_negative || value.get<std::uint64_t>() >= end)
    refuse_body(fmt::format("there is no {} {}", what, value.dump()));
  return value.get<std::size_t>();
}

}  // namespace

RequestBody::RequestBody(std::string_view text)
    : json_(text.empty() ? StudioJson::object() : StudioJson::parse(text, check_level, false)) {
  if (json_.is_discarded()) refuse_body("the body of the request is not valid JSON");
  if (!json_.is_object()) refuse_body("the body of the request is not a JSON object");
}

bool RequestBody::has(const char* key) const {
  const auto found = json_.find(key);
  return found != json_.end() && !found->is_null();
}

bool RequestBody::is_null(const char* key) const {
  const auto found = json_.find(key);
  return found != json_.end() && found->is_null();
}

const StudioJson& RequestBody::need(const char* key) const {
  const auto found = json_.find(key);
  if (found == json_.end()) refuse_body(fmt::format("'{}' is missing from the request", key));
  return *found;
}

std::string RequestBody::text(const char* key) const {
  const StudioJson& value = need(key);
  if (!value.is_string()) refuse_body(fmt::format("'{}' must be a text", key));
  return value.get<std::string>();
}

std::optional<std::string> RequestBody::optional_text(const char* key) const {
  if (!has(key)) return std::nullopt;
  return text(key);
}

bool RequestBody::flag(const char* key) const {
  if (!has(key)) return false;
  const StudioJson& value = need(key);
  if (!value.is_boolean()) refuse_body(fmt::format("'{}' must be true or false", key));
  return value.get<bool>();
}

std::size_t RequestBody::number(const char* key, std::size_t end, const char* what) const {
  return whole_number(need(key), key, end, what);
}

std::optional<double> RequestBody::optional_real(const char* key) const {
  if (!has(key)) return std::nullopt;
  const StudioJson& value = need(key);
  if (!value.is_number()) refuse_body(fmt::format("'{}' must be a number", key));
  return value.get<double>();
}

std::vector<std::size_t> RequestBody::numbers(const char* key, std::size_t end,
                                              const char* what) const {
  const StudioJson& list = need(key);
  if (!list.is_array())
    refuse_body(fmt::format("'{}' must be a list of numbers, each that of a {}", key, what));
  std::vector<std::size_t> all;
  all.reserve(list.size());
  for (const StudioJson& value : list) all.push_back(whole_number(value, key, end, what));
  return all;
}

std::vector<std::string> RequestBody::texts(const char* key) const {
  if (!has(key)) return {};
  const StudioJson& list = need(key);
  if (!list.is_array()) refuse_body(fmt::format("'{}' must be a list of texts", key));
  std::vector<std::string> all;
  for (const StudioJson& value : list) {
    if (!value.is_string()) refuse_body(fmt::format("'{}' must be a list of texts", key));
    all.push_back(value.get<std::string>());
  }
  return all;
}

std::vector<std::string> RequestBody::assignments(const char* key) const {
  if (!has(key)) return {};
  const StudioJson& object = need(key);
  const auto refuse = [&] {
    refuse_body(fmt::format("'{}' must be an object of names and values as texts", key));
  };
  if (!object.is_object()) refuse();
  std::vector<std::string> all;
  for (const auto& [name, value] : object.items()) {
    if (!value.is_string()) refuse();
    all.push_back(name + "=" + value.get<std::string>());
  }
  return all;
}

std::string dump(const StudioJson& json) {
  return json.dump(-1, ' ', false, StudioJson::error_handler_t::replace);
}

StudioJson number_or_null(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value;
}

double rounded(double value, int decimals) {
  static constexpr std::array<double, 7> kPowers{1, 10, 100, 1e3, 1e4, 1e5, 1e6};
  const double power = kPowers.at(static_cast<std::size_t>(decimals));
  return std::round(value * power) / power;
}

void refuse_superseded(const char* sentence) {
  throw RefusedRequest(409, sentence, Code::none, {{"superseded", true}});
}

}  // namespace oriel::studio
