#include "report/database.h"

#include <sqlite3.h>

#include <limits>
#include <utility>

#include "remodel/error.h"

namespace remodel::report {

namespace {

std::string uri_of(const std::filesystem::path& file) {
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

bool there(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

}  // namespace

// A store whose writer has ended has no write-ahead log beside it. It is read as it stands, which leaves no
// file of SQLite's own in the directory and works where nothing can be written.
Database::Database(std::filesystem::path file) : file_(std::move(file)) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file_, ignored))
    throw Error(ErrorCode::file, file_.string(),
                "found no such file, expected the store of a study (remodel study)");
  const bool quiet = !there(file_.string() + "-wal") && !there(file_.string() + "-journal");
  if (quiet) {
    open(uri_of(file_), SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
  } else {
    open(file_.string(), SQLITE_OPEN_READWRITE);
  }
}

Database::~Database() {
  sqlite3_close(connection_);
}

void Database::fail() const {
  const std::string reason = connection_ ? sqlite3_errmsg(connection_) : "out of memory";
  throw Error(ErrorCode::format, file_.string(),
              "found a database that cannot be read (" + reason + "), expected the store of a study");
}

void Database::open(const std::string& name, int flags) {
  if (sqlite3_open_v2(name.c_str(), &connection_, flags, nullptr) != SQLITE_OK) {
    const std::string reason = connection_ ? sqlite3_errmsg(connection_) : "out of memory";
    sqlite3_close(connection_);
    throw Error(ErrorCode::file, file_.string(), "cannot be opened: " + reason);
  }
  sqlite3_busy_timeout(connection_, 30'000);  // a study that runs commits for a moment
}

Query::Query(const Database& database, const std::string& sql) : database_(database) {
  if (sqlite3_prepare_v2(database_.connection(), sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK)
    database_.fail();
}

Query::~Query() {
  sqlite3_finalize(statement_);
}

bool Query::next() {
  column_ = 0;
  const int status = sqlite3_step(statement_);
  if (status != SQLITE_ROW && status != SQLITE_DONE) database_.fail();
  return status == SQLITE_ROW;
}

double Query::real() {
  const int column = column_++;
  if (sqlite3_column_type(statement_, column) == SQLITE_NULL) return std::numeric_limits<double>::quiet_NaN();
  return sqlite3_column_double(statement_, column);
}

std::int64_t Query::integer() {
  return sqlite3_column_int64(statement_, column_++);
}

std::string Query::text() {
  const int column = column_++;
  const auto* characters = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  const int size = sqlite3_column_bytes(statement_, column);
  return characters ? std::string(characters, static_cast<std::size_t>(size)) : std::string();
}

}  // namespace remodel::report
