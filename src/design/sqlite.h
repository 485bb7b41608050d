#pragma once

// One SQLite connection and its prepared statements. Every call that can fail throws Error (file) that names
// the file and SQLite's reason; (format) where the file is no database or a damaged one.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace remodel {

class Sqlite {
 public:
  enum class Open {
    existing,
    create,
    // A database whose writer has ended is read as it stands: that leaves no file of SQLite's own beside it,
    // and works where nothing can be written. Beside one that is being written it is a reader like any other.
    to_read
  };

  // what: of messages, as in "cannot write the run's history". A reader that looks into the file of a running
  // process holds a commit up for a moment: it is waited for.
  Sqlite(std::filesystem::path file, std::string what, Open how);
  ~Sqlite();
  Sqlite(const Sqlite&) = delete;
  Sqlite& operator=(const Sqlite&) = delete;

  const std::filesystem::path& file() const { return file_; }
  void execute(const std::string& sql) const;
  [[noreturn]] void fail(const char* action) const;

 private:
  friend class Statement;
  void open(const std::string& name, int flags);

  std::filesystem::path file_;
  std::string what_;
  sqlite3* connection_ = nullptr;
};

// BEGIN IMMEDIATE to COMMIT; taken back where commit() was not reached.
class Transaction {
 public:
  explicit Transaction(const Sqlite& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  const Sqlite& database_;
  bool open_ = true;
};

// One prepared statement; parameters and columns are visited from left to right.
class Statement {
 public:
  Statement(const Sqlite& database, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void bind(double value);  // NaN becomes NULL
  void bind(const std::string& value);
  void bind(std::optional<double> value);
  void bind_integer(std::uint64_t value);
  void bind_integer(std::optional<std::size_t> value);
  void bind_bytes(std::string_view value);
  void bind_null();

  bool step();  // true if there is a row
  void reset();
  // Runs a statement that gives no rows, and is ready for the next one.
  void run() {
    step();
    reset();
  }

  double real();  // NULL gives NaN
  std::uint64_t integer();
  std::optional<double> optional_real();
  std::optional<std::size_t> optional_integer();
  std::string text();  // also of bytes

 private:
  bool null() const;
  std::nullopt_t skip();
  void check(int status) const;

  const Sqlite& database_;
  sqlite3_stmt* statement_ = nullptr;
  int parameter_ = 0;
  int column_ = 0;
};

}  // namespace remodel
