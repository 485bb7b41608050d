#pragma once

// A study's store, opened to read.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace remodel::report {

class Database {
 public:
  // Throws Error (file, format) where the file is not there or no SQLite database.
  explicit Database(std::filesystem::path file);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  const std::filesystem::path& file() const { return file_; }
  sqlite3* connection() const { return connection_; }
  // Throws what SQLite says as an Error (format).
  [[noreturn]] void fail() const;

 private:
  void open(const std::string& name, int flags);
  std::filesystem::path file_;
  sqlite3* connection_ = nullptr;
};

// One query; columns are visited from left to right.
class Query {
 public:
  Query(const Database& database, const std::string& sql);
  ~Query();
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  bool next();             // true if there is a row
  double real();           // NaN for NULL
  std::int64_t integer();  // 0 for NULL
  std::string text();

 private:
  const Database& database_;
  sqlite3_stmt* statement_ = nullptr;
  int column_ = 0;
};

}  // namespace remodel::report
