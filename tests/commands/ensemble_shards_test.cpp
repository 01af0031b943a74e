// Shards of an ensemble as the page has them run, by tasks of a job array and by ranks of MPI: merged, the bytes of the
// whole, also after one of them was killed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "commands/run_jourdain.hpp"
#include "package/project.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

const std::string kSource = JOURDAIN_SOURCE_DIR;

/// The compiler, but what it has made of the same sources is kept in KEPT. With LINGER it waits so many seconds first.
constexpr const char* kKeepingCompiler = R"sh(#!/bin/sh -e
[ "$1" != --version ] || exec c++ --version
[ -z "$LINGER" ] || sleep "$LINGER"
for word; do
  [ "$before" != -o ] || made=$word
  before=$word
done
kept=$KEPT/$(cat "$(dirname "$made")"/*.[ch]pp | sha256sum | cut -d ' ' -f 1)
[ -e "$kept" ] || { c++ "$@" && cp "$made" "$kept.$$" && mv "$kept.$$" "$kept"; }
cp "$kept" "$made"
)sh";

/// The block of a language in the page that holds a word.
std::string page_block(const std::string& language, const std::string& word) {
  const std::string page = support::read_file(kSource + "/runtime/ensembles.md"),
                    fence = "```" + language + "\n";
  for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
    at += fence.size();
    const std::string block = page.substr(at, page.find("\n```", at) + 1 - at);
    if (block.find(word) != std::string::npos) return block;
  }
  ADD_FAILURE() << "no " << language << " with " << word;
  return "";
}

class EnsembleShards : public testing::Test {
 protected:
  EnsembleShards() {
    std::filesystem::create_directory_symlink(kSource + "/models", path("models"));
    support::write_file(path("task.sh"), page_block("sh", "SLURM_ARRAY_TASK_ID"));
    support::write_file(path("keeping"), kKeepingCompiler);
    std::filesystem::permissions(path("keeping"), std::filesystem::perms::owner_all);
  }

  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }
  std::string bytes_of(const std::string& name) const { return support::read_file(path(name)); }

  support::ProcessResult run(const std::string& script) const {
    return run_script(folder_.path(), script,
                      {"PATH=" + build_folder() + ":" + std::getenv("PATH"), "OMPI_ALLOW_RUN_AS_ROOT=1",
                       "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", "SLURM_ARRAY_TASK_COUNT=16",
                       "KEPT=" + folder_.path(), "CXX=" + compiler_});
  }
  /// Of the page's command, without the shard.
  support::ProcessResult run_whole(const std::string& options) const {
    const std::string task = bytes_of("task.sh"), command = task.substr(task.find("jourdain ensemble"));
    return run(command.substr(0, command.find(" \\\n  --shard")) + " " + options);
  }

  std::string compiler_ = "c++";
  support::TemporaryFolder folder_;
};

std::string without_last_line(const std::string& text) {
  return text.substr(0, text.rfind('\n', text.size() - 2));
}

TEST_F(EnsembleShards, OfAJobArrayAreTheWholeThoughOneWasKilled) {
  compiler_ = "./keeping";
  const support::ProcessResult whole = run_whole("--threads 1 --output whole.h5");
  expect(whole, 0, "wrote whole.h5");
  expect(run_whole("--threads 4 --output threads.h5"), 0, "wrote threads.h5");
  EXPECT_EQ(bytes_of("threads.h5"), bytes_of("whole.h5"));

  const std::string tasks = "xargs -P 4 -I {} env SLURM_ARRAY_TASK_ID={} ";
  expect(run("seq 1 16 | grep -vx 7 | " + tasks + "sh -e task.sh"), 0, "wrote falls_16.h5");
  EXPECT_NE(run("echo 7 | LINGER=2 " + tasks + "timeout -s KILL 1 sh -e task.sh").status, 0);
  EXPECT_FALSE(std::filesystem::exists(path("falls_7.h5")));
  expect(run("jourdain merge falls.h5 falls_*.h5"), 1, "are missing; run again: --shard 7/16\n");
  EXPECT_FALSE(std::filesystem::exists(path("falls.h5")));
  expect(run("echo 7 | " + tasks + "sh -e task.sh"), 0, "wrote falls_7.h5");

  const support::ProcessResult merged = run("jourdain merge falls.h5 $(ls falls_*.h5 | sort -r)");
  EXPECT_EQ(merged.status, 0);
  EXPECT_EQ(without_last_line(merged.output), without_last_line(whole.output));
  EXPECT_EQ(bytes_of("falls.h5"), bytes_of("whole.h5"));

  support::write_file(path("page.py"), page_block("python", "h5py"));
  expect(run("/usr/bin/python3 -W error page.py"), 0, "2000 states of cart_pole.toml, seed 1: ");
}

TEST_F(EnsembleShards, OfRanksAreTheWhole) {
  const support::ProcessResult merged =
      run("export OMPI_MCA_rmaps_base_oversubscribe=1\n" + page_block("sh", "mpirun"));
  expect(merged, 0, "wrote falls.h5, falls.svg");
  EXPECT_TRUE(std::filesystem::exists(path("rank_3.h5")));
  expect(run_whole("--output whole.h5"), 0, "wrote");
  EXPECT_EQ(bytes_of("falls.h5"), bytes_of("whole.h5"));
}

}  // namespace
}  // namespace jourdain::tests
