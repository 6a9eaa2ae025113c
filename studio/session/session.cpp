#include "studio/session/session.h"

#include "kernel/base/own_fault.h"
#include "studio/lsp/editing_json.h"
#include "studio/session/desk.h"

#include <map>
#include <new>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

using Verb = StudioJson (*)(Desk&, const RequestBody&);

const std::map<std::string_view, Verb>& verbs() {
  static const std::map<std::string_view, Verb> all{
      {"ask", answer_ask},
      {"correct", answer_correct},
      {"corrections", answer_corrections},
      {"curve", answer_curve},
      {"disk", [](Desk& desk, const RequestBody&) { return desk.file.disk(); }},
      {"explain", answer_explain},
      {"features", answer_features},
      {"learn", answer_learn},
      {"pack", [](Desk& desk, const RequestBody& body) { return desk.runner.run(body); }},
      {"samples",
       [](Desk& desk, const RequestBody&) {
         desk.buildings.open_samples();
         return StudioJson{{"folder", desk.options.samples_folder}};
       }},
      {"save", [](Desk& desk, const RequestBody& body) { return desk.file.save(body); }},
      {"scale", answer_scale},
      {"search", answer_search},
      {"state", answer_state},
      {"surfaces", answer_surfaces},
      {"truth", answer_truth},
  };
  return all;
}

Reply reply_of(const RefusedRequest& refused) {
  StudioJson json{{"error", refused.what()}};
  if (refused.code() != Code::none) json["code"] = to_string(refused.code());
  for (const auto& [key, value] : refused.members().items()) json[key] = value;
  return {refused.status(), dump(json)};
}

Reply fault_reply(const std::exception& fault) {
  const Issue issue = own_fault(fault);
  return error_reply(500, issue.sentence, to_string(issue.code));
}

}  // namespace

Reply error_reply(int status, std::string_view sentence, std::string_view code) {
  StudioJson json{{"error", sentence}};
  if (!code.empty()) json["code"] = code;
  return {status, dump(json)};
}

struct Session::Inside {
  explicit Inside(SessionOptions options) : desk(std::move(options)) {}
  Desk desk;
};

Session::Session(SessionOptions options) : inside_(std::make_unique<Inside>(std::move(options))) {}

Session::~Session() = default;

Reply Session::answer(std::string_view verb, std::string_view body) {
  if (verb == "language") return answer_language(body, inside_->desk.file.name());
  const auto found = verbs().find(verb);
  const bool has_bytes = verb == "geometry";
  if (found == verbs().end() && !has_bytes)
    return error_reply(404, fmt::format("there is no verb '{}'", verb));
  try {
    if (has_bytes) return {200, {}, geometry_bytes(inside_->desk, RequestBody(body))};
    return {200, dump(found->second(inside_->desk, RequestBody(body)))};
  } catch (const RefusedRequest& refused) {
    return reply_of(refused);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const InputError& fault) {
    return error_reply(400, fault.issue().sentence, to_string(fault.issue().code));
  } catch (const std::exception& fault) {
    return fault_reply(fault);
  }
}

}  // namespace oriel::studio
