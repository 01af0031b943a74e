// Files and command lines that no one has thought of, by the thousand: each must end with what was asked for, or with a
// diagnostic.
//   fuzz [--cases N] [--seed S] [--jobs J] [--first I] [--only I]
// What a case is follows from the seed and its number, not from jobs or time. --first leaves out the cases before;
// --only shows one.
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>

#include "fuzz/tally.hpp"
#include "support/files.hpp"

using namespace jourdain::tests;
namespace support = jourdain::support;

namespace {

struct Options {
  std::uint64_t cases = 1000, seed = 1, first = 0, jobs = std::max(1u, std::thread::hardware_concurrency());
  bool only = false;
};

/// Not support::TemporaryFolder: a child that is told to end would remove it.
class WorkFolder {
 public:
  WorkFolder() : path_((std::filesystem::temp_directory_path() / "fuzz-XXXXXX").string()) {
    if (!mkdtemp(path_.data())) throw std::runtime_error("cannot make " + path_);
  }
  ~WorkFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

[[noreturn]] void refuse(const std::string& message) {
  fmt::print(stderr, "fuzz: {}\nusage: fuzz [--cases N] [--seed S] [--jobs J] [--first I] [--only I]\n",
             message);
  std::exit(2);
}

std::uint64_t number(const char* text) {
  char* end = nullptr;
  const std::uint64_t value = std::strtoull(text, &end, 10);
  if (end == text || *end != 0 || *text == '-') refuse(fmt::format("'{}' is no number", text));
  return value;
}

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (i + 1 == argc) refuse(fmt::format("{} without a number", name));
    const std::uint64_t value = number(argv[i + 1]);
    if (name == "--cases")
      options.cases = value;
    else if (name == "--seed")
      options.seed = value;
    else if (name == "--jobs")
      options.jobs = std::clamp<std::uint64_t>(value, 1, 64);
    else if (name == "--first" || name == "--only")
      options.first = value, options.only = name == "--only";
    else
      refuse(fmt::format("no option '{}'", name));
  }
  return options;
}

Record record_of(const Case& tried, const Trial& trial, std::uint64_t index) {
  Record record{index,         tried.kind,     trial.verdict.outcome, trial.read,
                trial.emitted, trial.compiled, trial.seconds,         {}};
  std::strncpy(record.why.data(), trial.verdict.why.c_str(), record.why.size() - 1);
  return record;
}

/// Takes the next case until there is none, in a process of its own.
[[noreturn]] void work(const Options& options, std::atomic<std::uint64_t>& next, int pipe,
                       const std::string& folder) {
  for (std::uint64_t index; (index = next++) < options.cases;) {
    const Case tried = make_case(options.seed, index);
    const Record record = record_of(tried, try_case(tried, index, folder), index);
    static_assert(sizeof(Record) <= 512);  // POSIX: what is no longer is written at once
    if (write(pipe, &record, sizeof record) != sizeof record) _exit(1);
  }
  _exit(0);
}

FuzzTally run_all(const Options& options, const std::string& folder) {
  void* shared = mmap(nullptr, sizeof(std::atomic<std::uint64_t>), PROT_READ | PROT_WRITE,
                      MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto* next = new (shared) std::atomic<std::uint64_t>(options.first);
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("cannot make a pipe");
  for (std::uint64_t job = 0; job < options.jobs; ++job)
    if (fork() == 0) work(options, *next, ends[1], fmt::format("{}/{}", folder, job));
  close(ends[1]);
  FuzzTally tally;
  std::uint64_t done = options.first;
  for (Record record; read(ends[0], &record, sizeof record) == sizeof record;) {
    tally.add(record);
    if (is_failure(record.outcome))
      fmt::print(stderr, "case {} {}: {}: {}\n", record.index, kind_name(record.kind),
                 outcome_name(record.outcome), record.why.data());
    if (++done % 10'000 == 0)
      fmt::print(stderr, "{} of {} cases, {} failures\n", done, options.cases, tally.failures());
  }
  for (int status = 0; wait(&status) > 0;)
    if (status != 0) throw std::runtime_error("a worker of the fuzzer has ended");
  if (done != options.cases) throw std::runtime_error("cases are missing");
  return tally;
}

/// The first case of each class, made small, below build/fuzz.
void save(const Options& options, const FuzzTally& tally, const std::string& folder) {
  const std::filesystem::path kept = std::filesystem::path(JOURDAIN_SOURCE_DIR) / "build" / "fuzz";
  std::size_t left = 40;
  for (const auto& [key, found] : tally.classes()) {
    if (left-- == 0) break;
    Case tried = make_case(options.seed, found.first);
    const bool quick = key.first != Outcome::kTooSlow && key.first != Outcome::kTooLarge;
    if (quick) tried = minimised(tried, {key.first, key.second}, found.first, folder);
    const std::filesystem::path here = kept / fmt::format("{}_{}", options.seed, found.first);
    std::filesystem::create_directories(here);
    for (const support::FileText& file : tried.files)
      support::write_file((here / file.name).string(), file.text);
    support::write_file((here / "said.txt").string(), try_case(tried, found.first, folder).shown);
    fmt::print("{}: {}: build/fuzz/{}\n", outcome_name(key.first), key.second, here.filename().string());
  }
}

int show(const Options& options, const std::string& folder) {
  const Case tried = make_case(options.seed, options.first);
  const Trial trial = try_case(tried, options.first, folder);
  fmt::print("{}: {}\n{}\n{}\n{}: {}\n", kind_name(tried.kind), tried.origin, tried.files[0].text,
             trial.shown, outcome_name(trial.verdict.outcome), trial.verdict.why);
  return is_failure(trial.verdict.outcome) ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = read_options(argc, argv);
  const WorkFolder folder;
  if (options.only) return show(options, folder.path() + "/only");
  const FuzzTally tally = run_all(options, folder.path());
  fmt::print("{}", tally.text());
  save(options, tally, folder.path() + "/small");
  const std::string too_few = tally.too_few();
  if (!too_few.empty()) fmt::print("{}\n", too_few);
  return tally.failures() > 0 || !too_few.empty() ? 1 : 0;
}
