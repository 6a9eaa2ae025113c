#pragma once

#include <stdexcept>
#include <string>

namespace oriel::studio {

/// Error codes of JSON-RPC and of the Language Server Protocol.
enum class RpcCode {
  parse_error = -32700,
  invalid_request = -32600,
  method_not_found = -32601,
  invalid_params = -32602,
  internal_error = -32603,
  not_initialized = -32002,
  request_failed = -32803
};

/// Why a request is answered with an error.
class RpcError : public std::runtime_error {
 public:
  RpcError(RpcCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}
  [[nodiscard]] RpcCode code() const { return code_; }

 private:
  RpcCode code_;
};

}  // namespace oriel::studio
