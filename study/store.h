#pragma once

// The database of a study, as schema.h describes it. Every SQLite error becomes an Error (file). Not
// thread-safe.

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include "design/sqlite.h"
#include "study/plan.h"
#include "study/rows.h"
#include "study/study.h"

namespace remodel {

class StudyStore {
 public:
  // Creates a study, completely or not at all. The directory must exist.
  static void create(const std::filesystem::path& directory, const StudyOptions& options);
  // True if the directory holds a study.
  static bool exists(const std::filesystem::path& directory);
  // Opens a study. Throws Error (format) for anything but a study of this version.
  explicit StudyStore(const std::filesystem::path& directory);

  const StudyOptions& options() const { return options_; }
  // Stores the options of an extended study.
  void extend(const StudyOptions& options);

  std::set<JobKey> finished() const;
  StudyPath path(const JobKey& key) const;
  FreshRows fresh(const JobKey& key) const;
  // Stores the rows of a finished job in one transaction.
  void write(const JobKey& key, const StudyRows& rows);
  // Sums the figures of all finished jobs.
  void add_totals(StudyResult& result) const;

 private:
  void write_path(const JobKey& key, const PathRows& rows);
  void write_fresh(const JobKey& key, const FreshRows& rows);
  void write_replay(const JobKey& key, const ReplayRows& rows);

  Sqlite database_;
  StudyOptions options_;
};

// Decodes a scenario's path from its column. Throws Error (format) naming source.
StudyPath read_study_path(std::string_view blob, const std::string& source);

}  // namespace remodel
