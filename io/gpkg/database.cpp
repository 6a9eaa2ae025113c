#include "io/gpkg/database.h"

#include "kernel/base/issue.h"

#include <cstdint>
#include <new>
#include <sqlite3.h>
#include <system_error>
#include <type_traits>
#include <utility>

namespace oriel::detail {

namespace {

std::string quoted(std::string_view text, char quote) {
  std::string result(1, quote);
  for (const char c : text) {
    result += c;
    if (c == quote) result += c;
  }
  return result + quote;
}

}  // namespace

std::string quoted_name(std::string_view name) { return quoted(name, '"'); }
std::string quoted_text(std::string_view text) { return quoted(text, '\''); }

Database::Database(const std::string& folder, std::string about)
    : about_(about), file_(folder, std::move(about)) {
  const int result = sqlite3_open_v2(file_.name().c_str(), &handle_,
                                     SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
  file_.forget_name();
  try {
    check(result);
    // Nothing is there to go back to: the file is kept whole or thrown away.
    run("PRAGMA page_size = 4096; PRAGMA encoding = 'UTF-8'; PRAGMA auto_vacuum = NONE;"
        "PRAGMA locking_mode = EXCLUSIVE; PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF;"
        "PRAGMA cache_size = -16000; PRAGMA temp_store = MEMORY;");
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

Database::~Database() { sqlite3_close(handle_); }

void Database::check(int result) {
  if (result == SQLITE_OK || result == SQLITE_DONE || result == SQLITE_ROW) return;
  if (result == SQLITE_NOMEM || handle_ == nullptr) throw std::bad_alloc();
  const int reason = sqlite3_system_errno(handle_);
  Issue issue;
  issue.code = Code::E601;
  issue.sentence = "cannot be written: ";
  issue.sentence += result == SQLITE_FULL || reason == 0 ? std::string(sqlite3_errmsg(handle_))
                                                         : std::generic_category().message(reason);
  issue.place.file = about_;
  throw OutputError(std::move(issue));
}

void Database::run(const std::string& statements) {
  check(sqlite3_exec(handle_, statements.c_str(), nullptr, nullptr, nullptr));
}

bool Database::may_run(const std::string& statement) {
  const int result = sqlite3_exec(handle_, statement.c_str(), nullptr, nullptr, nullptr);
  if (result == SQLITE_ERROR) return false;
  check(result);
  return true;
}

NamelessFile& Database::finish() {
  run("COMMIT");
  return file_;
}

Database::Statement::Statement(Database& database, const std::string& text) : database_(database) {
  database.check(sqlite3_prepare_v2(database.handle_, text.c_str(), static_cast<int>(text.size()),
                                    &statement_, nullptr));
}

Database::Statement::~Statement() { sqlite3_finalize(statement_); }

void Database::Statement::set(int number, const GpkgValue& value) {
  std::visit(
      [&](const auto& known) {
        using Known = std::decay_t<decltype(known)>;
        if constexpr (std::is_same_v<Known, std::string>)
          database_.check(sqlite3_bind_text64(statement_, number, known.data(), known.size(),
                                              SQLITE_STATIC, SQLITE_UTF8));
        else if constexpr (std::is_same_v<Known, double>)
          database_.check(sqlite3_bind_double(statement_, number, known));
        else if constexpr (!std::is_same_v<Known, std::monostate>)
          database_.check(sqlite3_bind_int64(statement_, number, known));
      },
      value);
}

void Database::Statement::set_blob(int number, std::string_view bytes) {
  if (bytes.empty()) return;
  database_.check(
      sqlite3_bind_blob64(statement_, number, bytes.data(), bytes.size(), SQLITE_STATIC));
}

void Database::Statement::run() {
  database_.check(sqlite3_step(statement_));
  database_.check(sqlite3_reset(statement_));
  database_.check(sqlite3_clear_bindings(statement_));
}

}  // namespace oriel::detail
