#include "study/study.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "remodel/directory_lock.h"
#include "remodel/error.h"
#include "study/options.h"
#include "study/schedule.h"
#include "study/store.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

// True for a temporary file of a process that was killed while it created a study.
bool is_temporary(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with(".study.sqlite.") && (name.ends_with(".tmp") || name.ends_with(".tmp-journal"));
}

void require_new(const fs::path& directory) {
  std::error_code problem;
  if (fs::exists(directory, problem) && !fs::is_directory(directory, problem))
    throw Error(ErrorCode::file, directory.string(), "is a file, expected a directory");
  if (!fs::exists(directory, problem)) return;
  if (StudyStore::exists(directory))
    throw Error(ErrorCode::argument, directory.string(),
                "holds a study: expected another directory, or --resume to go on with it");
  for (const fs::directory_entry& entry : fs::directory_iterator(directory))
    if (!is_temporary(entry.path()))
      throw Error(ErrorCode::file, directory.string(),
                  "is a directory with other files, expected a new, an empty or a study's directory");
}

void require_study(const fs::path& directory) {
  if (!StudyStore::exists(directory))
    throw Error(ErrorCode::file, (directory / "study.sqlite").string(),
                "not found, expected a study to be resumed");
}

void remove_temporaries(const fs::path& directory) {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory))
    if (is_temporary(entry.path())) found.push_back(entry.path());
  for (const fs::path& file : found) fs::remove(file);
}

void begin(const fs::path& directory, const StudyOptions& options, bool remove_if_refused) {
  require_new(directory);  // again, now that the lock keeps others from beginning
  remove_temporaries(directory);
  try {
    StudyStore::create(directory, options);
  } catch (...) {
    std::error_code ignored;
    if (remove_if_refused) fs::remove(directory, ignored);
    throw;
  }
}

}  // namespace

const char* name_of(StudyStopped stopped) {
  return stopped == StudyStopped::done ? "done" : "interrupted";
}

StudyOptions read_study_options(const fs::path& directory) {
  require_study(directory);
  return StudyStore(directory).options();
}

StudyResult study(const fs::path& directory, const StudyOptions& options, StudyMode mode, Crew& crew,
                  StudyObserver* observer) {
  const Stopwatch watch;
  require_good(options);
  mode == StudyMode::begin ? require_new(directory) : require_study(directory);
  const bool missing = !fs::exists(directory);
  const DirectoryLock lock(directory);
  if (mode == StudyMode::begin) begin(directory, options, missing);
  lock.sync();
  StudyStore store(directory);
  if (mode == StudyMode::resume) {
    const StudyOptions all = grown(store.options(), options, directory.string());
    require_good(all);
    store.extend(all);
  }

  StudyObserver silent;
  Schedule schedule(store, observer ? *observer : silent);
  StudyResult result;
  result.before = schedule.progress().done;
  crew.work(schedule, run_study_job);

  const StudyOptions& all = store.options();
  result.jobs = schedule.progress().jobs;
  result.done = schedule.progress().done;
  result.cells = all.airfoils.size() * all.sigmas.size() * all.pairs.size() * all.distances.size() *
                 all.strategies.size();
  store.add_totals(result);
  result.stopped = result.done == result.jobs ? StudyStopped::done : StudyStopped::interrupted;
  result.seconds = watch.seconds();
  return result;
}

}  // namespace remodel
