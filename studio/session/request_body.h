#pragma once

#include "kernel/base/code.h"

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace oriel::studio {

using StudioJson = nlohmann::ordered_json;

/// A request that cannot be answered: its status, one sentence for people, a code or none, and
/// further members of the answer or none.
class RefusedRequest : public std::runtime_error {
 public:
  RefusedRequest(int status, const std::string& sentence, Code code = Code::none,
                 StudioJson members = StudioJson::object())
      : std::runtime_error(sentence), status_(status), code_(code), members_(std::move(members)) {}
  [[nodiscard]] int status() const { return status_; }
  [[nodiscard]] Code code() const { return code_; }
  [[nodiscard]] const StudioJson& members() const { return members_; }

 private:
  int status_;
  Code code_;
  StudioJson members_;
};

/// The members of a request's body. What is missing or of another type than asked for throws
/// RefusedRequest with status 400 and a sentence that names it; members that nobody asks for are
/// passed over.
class RequestBody {
 public:
  explicit RequestBody(std::string_view text);

  [[nodiscard]] bool has(const char* key) const;
  /// True if the member is there and null.
  [[nodiscard]] bool is_null(const char* key) const;

  [[nodiscard]] std::string text(const char* key) const;
  [[nodiscard]] std::optional<std::string> optional_text(const char* key) const;
  /// False where it is missing.
  [[nodiscard]] bool flag(const char* key) const;
  /// A whole number of at least 0, below `end`; a sentence calls it `what`.
  [[nodiscard]] std::size_t number(const char* key, std::size_t end, const char* what) const;
  [[nodiscard]] std::optional<double> optional_real(const char* key) const;
  /// A list of such numbers.
  [[nodiscard]] std::vector<std::size_t> numbers(const char* key, std::size_t end,
                                                 const char* what) const;
  [[nodiscard]] std::vector<std::string> texts(const char* key) const;
  /// An object whose values are texts: "NAME=VALUE" for each.
  [[nodiscard]] std::vector<std::string> assignments(const char* key) const;

 private:
  [[nodiscard]] const StudioJson& need(const char* key) const;

  StudioJson json_;
};

/// As it is sent: one line; bytes that are no UTF-8 are replaced.
std::string dump(const StudioJson& json);

/// Nothing for what is not finite.
StudioJson number_or_null(double value);

/// Rounded to so many decimals, so that answers stay short.
double rounded(double value, int decimals);

/// Throws RefusedRequest 409 {superseded: true}: "a newer pack came".
[[noreturn]] void refuse_superseded(const char* sentence);

}  // namespace oriel::studio
