#pragma once

// The database of a study: schema.h. Every SQLite error is an Error (file). For one thread at a time.

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include "optimise/sqlite.h"
#include "remodel/study.h"
#include "study/plan.h"
#include "study/rows.h"

namespace remodel {

class StudyStore {
 public:
  // A new study, whole in its place or not there at all. The directory must be there.
  static void create(const std::filesystem::path& directory, const StudyOptions& options);
  // Whether the directory holds a study.
  static bool exists(const std::filesystem::path& directory);
  // Throws Error (format) for anything but a study of this version.
  explicit StudyStore(const std::filesystem::path& directory);

  const StudyOptions& options() const { return options_; }
  // Takes what the study is extended by.
  void extend(const StudyOptions& options);

  std::set<JobKey> finished() const;
  StudyPath path(const JobKey& key) const;
  FreshRows fresh(const JobKey& key) const;
  // The rows of a finished job, in one transaction.
  void write(const JobKey& key, const StudyRows& rows);
  // Adds up what is finished.
  void add_totals(StudyResult& result) const;

 private:
  void write_path(const JobKey& key, const PathRows& rows);
  void write_fresh(const JobKey& key, const FreshRows& rows);
  void write_replay(const JobKey& key, const ReplayRows& rows);

  Sqlite database_;
  StudyOptions options_;
};

// A scenario's path from its column. Throws Error (format) naming source.
StudyPath read_study_path(std::string_view blob, const std::string& source);

}  // namespace remodel
