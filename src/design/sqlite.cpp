#include "design/sqlite.h"

#include <sqlite3.h>

#include <limits>
#include <utility>

#include "remodel/error.h"

namespace remodel {

namespace {

// The URI by which SQLite reads the file as it stands, whoever else may have it open.
std::string immutable_uri(const std::filesystem::path& file) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(file).string()) {
    if (c == '%' || c == '?' || c == '#') {
      static constexpr char digits[] = "0123456789abcdef";
      uri += {'%', digits[static_cast<unsigned char>(c) >> 4], digits[static_cast<unsigned char>(c) & 15]};
    } else {
      uri += c;
    }
  }
  return uri + "?immutable=1";
}

// Whether there is a log of a transaction beside the file.
bool has_log(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(file.string() + "-wal", ignored) ||
         std::filesystem::exists(file.string() + "-journal", ignored);
}

}  // namespace

Sqlite::Sqlite(std::filesystem::path file, std::string what, Open how)
    : file_(std::move(file)), what_(std::move(what)) {
  // A FIFO would be waited for without end, and nothing but a file can hold a database.
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file_, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw Error(ErrorCode::file, file_.string(), "is no regular file, expected " + what_);
  if (how == Open::to_read && !has_log(file_)) {
    open(immutable_uri(file_), SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
  } else {
    open(file_.string(), SQLITE_OPEN_READWRITE | (how == Open::create ? SQLITE_OPEN_CREATE : 0));
  }
}

void Sqlite::open(const std::string& name, int flags) {
  try {
    if (sqlite3_open_v2(name.c_str(), &connection_, flags, nullptr) != SQLITE_OK) fail("open");
  } catch (...) {
    sqlite3_close(connection_);
    throw;
  }
  sqlite3_busy_timeout(connection_, 30'000);
}

Sqlite::~Sqlite() {
  sqlite3_close(connection_);
}

void Sqlite::fail(const char* action) const {
  const char* reason = connection_ ? sqlite3_errmsg(connection_) : "out of memory";
  const int code = connection_ ? sqlite3_errcode(connection_) : SQLITE_NOMEM;
  const bool damaged = code == SQLITE_NOTADB || code == SQLITE_CORRUPT;
  throw Error(damaged ? ErrorCode::format : ErrorCode::file, file_.string(),
              std::string("cannot ") + action + " " + what_ + ": " + reason);
}

void Sqlite::execute(const std::string& sql) const {
  if (sqlite3_exec(connection_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail("write");
}

Transaction::Transaction(const Sqlite& database) : database_(database) {
  database_.execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (!open_) return;
  try {
    database_.execute("ROLLBACK");
  } catch (const Error&) {  // SQLite has taken it back already
  }
}

void Transaction::commit() {
  database_.execute("COMMIT");
  open_ = false;
}

Statement::Statement(const Sqlite& database, const std::string& sql) : database_(database) {
  check(sqlite3_prepare_v2(database_.connection_, sql.c_str(), -1, &statement_, nullptr));
}

Statement::~Statement() {
  sqlite3_finalize(statement_);
}

void Statement::bind(double value) {
  check(sqlite3_bind_double(statement_, ++parameter_, value));
}

void Statement::bind_integer(std::uint64_t value) {
  check(sqlite3_bind_int64(statement_, ++parameter_, static_cast<sqlite3_int64>(value)));
}

void Statement::bind(const std::string& value) {
  check(sqlite3_bind_text(statement_, ++parameter_, value.data(), static_cast<int>(value.size()),
                          SQLITE_TRANSIENT));
}

void Statement::bind_bytes(std::string_view value) {
  check(sqlite3_bind_blob64(statement_, ++parameter_, value.data(), value.size(), SQLITE_TRANSIENT));
}

void Statement::bind_null() {
  check(sqlite3_bind_null(statement_, ++parameter_));
}

void Statement::bind(std::optional<double> value) {
  if (value) return bind(*value);
  bind_null();
}

void Statement::bind_integer(std::optional<std::size_t> value) {
  if (value) return bind_integer(std::uint64_t{*value});
  bind_null();
}

bool Statement::step() {
  column_ = 0;
  const int status = sqlite3_step(statement_);
  if (status != SQLITE_ROW && status != SQLITE_DONE) database_.fail("use");
  return status == SQLITE_ROW;
}

void Statement::reset() {
  check(sqlite3_reset(statement_));
  parameter_ = 0;
}

double Statement::real() {
  if (null()) {
    ++column_;
    return std::numeric_limits<double>::quiet_NaN();
  }
  return sqlite3_column_double(statement_, column_++);
}

std::uint64_t Statement::integer() {
  return static_cast<std::uint64_t>(sqlite3_column_int64(statement_, column_++));
}

std::optional<double> Statement::optional_real() {
  return null() ? skip() : std::optional(real());
}

std::optional<std::size_t> Statement::optional_integer() {
  return null() ? skip() : std::optional<std::size_t>(integer());
}

std::string Statement::text() {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column_));
  const int size = sqlite3_column_bytes(statement_, column_++);
  return bytes ? std::string(bytes, static_cast<std::size_t>(size)) : std::string();
}

bool Statement::null() const {
  return sqlite3_column_type(statement_, column_) == SQLITE_NULL;
}

std::nullopt_t Statement::skip() {
  ++column_;
  return std::nullopt;
}

void Statement::check(int status) const {
  if (status != SQLITE_OK) database_.fail("use");
}

}  // namespace remodel
