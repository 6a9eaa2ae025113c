#pragma once

#include <string>

namespace oriel::studio {

struct LanguageServerOptions {
  /// Of the program, as clients show it.
  std::string version{};
  /// The pages that messages link to begin with it: `DOCS_URL/rules.md#r204-unknown-attribute`.
  std::string docs_url{};
  /// A folder for copies of built-in packs, to which definitions lead; empty: they lead nowhere.
  std::string copies{};
};

/// Speaks the Language Server Protocol (version 3.17) on two file descriptors until `exit`, or
/// until nothing more comes. Returns what the protocol asks a server to end with: 0 after
/// `shutdown`, else
/// 1. Findings of the whole of a document are published when it is opened, and after changes once
/// the client pauses. Whatever comes in, nothing is thrown but std::bad_alloc: what is no message
/// is answered with the protocol's error codes.
int serve_language(int in, int out, const LanguageServerOptions& options);

/// The folder for copies: $XDG_CACHE_HOME/oriel/packs, else ~/.cache/oriel/packs, else empty.
std::string folder_of_copies();

}  // namespace oriel::studio
