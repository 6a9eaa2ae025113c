#pragma once

#include "io/gpkg/gpkg_row.h"
#include "kernel/base/nameless_file.h"

#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace oriel::detail {

/// An SQLite database while it is made, in a file without a name. One transaction holds all of it:
/// the same statements give the same bytes. What fails throws OutputError E601 about the output, or
/// std::bad_alloc.
class Database {
 public:
  Database(const std::string& folder, std::string about);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Runs statements that give no rows.
  void run(const std::string& statements);
  /// False if SQLite refuses the statement, as where it was built without a module.
  bool may_run(const std::string& statement);
  /// Closes the transaction; the file has all bytes then.
  NamelessFile& finish();

  /// A statement that is run again and again with other values.
  class Statement {
   public:
    Statement(Database& database, const std::string& text);
    ~Statement();
    Statement(const Statement&) = delete;
    Statement& operator=(const Statement&) = delete;

    /// Values are numbered from 1; those that are not set are NULL.
    void set(int number, const GpkgValue& value);
    void set_blob(int number, std::string_view bytes);
    void run();

   private:
    Database& database_;
    sqlite3_stmt* statement_ = nullptr;
  };

 private:
  void check(int result);

  std::string about_;
  NamelessFile file_;
  sqlite3* handle_ = nullptr;
};

/// A name as it stands in SQL: in double quotes.
std::string quoted_name(std::string_view name);
/// A text as it stands in SQL: in single quotes.
std::string quoted_text(std::string_view text);

}  // namespace oriel::detail
