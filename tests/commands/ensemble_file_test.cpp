// Files of ensembles and `jourdain merge`: what is written, what of it is refused. Ensembles by hand, so that nothing
// is compiled; tests/commands/ensemble_shards_test.cpp has those that are computed.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "commands/content_hash.hpp"
#include "commands/ensemble_file.hpp"
#include "commands/ensemble_file_layout.hpp"
#include "commands/run_jourdain.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

using commands::EnsembleResult;
using commands::read_ensemble_file;
using commands::Shard;
using commands::write_ensemble_file;

constexpr std::uint64_t kStates = 100;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// What a state of the ensemble below draws, and where it ends.
double number_of(std::size_t column, std::uint64_t state) {
  return 1.5 + std::sin(3 * static_cast<double>(column) + 2.7 * static_cast<double>(state));
}

EnsembleResult part_of_whole(std::uint64_t part, std::uint64_t parts) {
  EnsembleResult result;
  result.facts = {"Jourdain",
                  "c++ 1",
                  "00",
                  "cart",
                  "cart.toml",
                  "11",
                  "rk4",
                  "double",
                  0.01,
                  50,
                  7,
                  kStates,
                  0.1,
                  {{"mass", 2}, {"stiffness", 30}},
                  {{"push", 1.5}},
                  {{"mass", "normal(5%)"}}};
  result.shard = commands::shard_of(kStates, part, parts);
  result.columns = {{"mass", "kg", true}, {"slide", "m", false}, {"a/b%.", "", false}, {".", "1", false}};
  result.trusted.assign(result.shard.size(), 1);
  result.values = [shard = result.shard](std::size_t column) {
    std::vector<double> values;
    for (std::uint64_t k = shard.begin; k < shard.end; ++k) values.push_back(number_of(column, k));
    return values;
  };
  const std::uint64_t judged = commands::judged_count(result.shard);
  result.halved.trusted.assign(judged, 1);
  for (std::size_t column = 1; column < result.columns.size(); ++column) {
    result.halved.columns.emplace_back();
    for (std::uint64_t k = 0; k < judged; ++k)
      result.halved.columns.back().push_back(number_of(column, result.shard.begin + k) + 1e-6);
  }
  return result;
}

/// Its values, but one of a column.
void set_value(EnsembleResult& result, std::size_t of_column, std::size_t k, double value) {
  result.values = [=, before = result.values](std::size_t column) {
    std::vector<double> values = before(column);
    if (column == of_column) values[k] = value;
    return values;
  };
}

class EnsembleFile : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }
  std::string write(const std::string& name, const EnsembleResult& result) const {
    write_ensemble_file(path(name), result);
    return path(name);
  }
  /// Paths of all shards.
  std::vector<std::string> write_shards(std::uint64_t parts) const {
    std::vector<std::string> paths;
    for (std::uint64_t part = 1; part <= parts; ++part)
      paths.push_back(write(fmt::format("{}.h5", part), part_of_whole(part, parts)));
    return paths;
  }
  support::ProcessResult merge(const std::vector<std::string>& shards) const {
    std::vector<std::string> words = {"merge", path("merged.h5")};
    words.insert(words.end(), shards.begin(), shards.end());
    return jourdain(words);
  }
  /// Nothing is written.
  void expect_refused(const std::vector<std::string>& shards, const std::string& part) const {
    expect(merge(shards), 1, part);
    EXPECT_FALSE(std::filesystem::exists(path("merged.h5"))) << part;
  }
  std::string problem_of(const std::string& bytes) const {
    std::filesystem::remove(path("changed.h5"));  // some disks wait where a file takes another's place
    support::write_file(path("changed.h5"), bytes);
    std::string problem;
    const bool is_read = read_ensemble_file(path("changed.h5"), problem).has_value();
    EXPECT_EQ(is_read, problem.empty());
    return problem;
  }

  support::TemporaryFolder folder_;
};

TEST_F(EnsembleFile, HoldsWhatWasWritten) {
  EnsembleResult result = part_of_whole(2, 3);
  result.trusted[1] = 0;
  set_value(result, 1, 1, kNaN);
  set_value(result, 2, 1, -std::numeric_limits<double>::infinity());
  std::string problem;
  const auto read = read_ensemble_file(write("one.h5", result), problem);
  ASSERT_TRUE(read.has_value()) << problem;
  EXPECT_EQ(commands::difference(*read, result), "");
  EXPECT_EQ(read->shard.text(), "2/3");
  EXPECT_EQ(read->shard.begin, 34u);
  EXPECT_EQ(read->trusted, result.trusted);
  EXPECT_EQ(read->halved.columns, result.halved.columns);
  EXPECT_TRUE(std::isnan(read->values(1)[1]));
  for (std::size_t column : {0, 2, 3}) EXPECT_EQ(read->values(column), result.values(column));
  EXPECT_EQ(support::read_file(write("two.h5", *read)), support::read_file(path("one.h5")));
}

TEST_F(EnsembleFile, OfAllShardsIsThatOfTheWholeByteForByte) {
  const std::string whole = support::read_file(write("whole.h5", part_of_whole(1, 1)));
  for (const std::uint64_t parts : {1, 2, 3, 7, 100}) {
    std::vector<std::string> paths = write_shards(parts);
    for (std::size_t i = 0; i < paths.size(); i += 2) std::swap(paths[i], paths[paths.size() - 1 - i]);
    expect(merge(paths), 0, "half the step moves the first 32 ends");
    EXPECT_EQ(support::read_file(path("merged.h5")), whole) << parts;
  }
  write("first.h5", part_of_whole(1, 2));
  write("third.h5", part_of_whole(3, 4));
  write("fourth.h5", part_of_whole(4, 4));
  expect(merge({path("fourth.h5"), path("first.h5"), path("third.h5")}), 0, "cart: 100 states, 50 steps");
  EXPECT_EQ(support::read_file(path("merged.h5")), whole);
  expect(jourdain({"merge", path("again.h5"), path("merged.h5")}), 0, "wrote");
  EXPECT_EQ(support::read_file(path("again.h5")), whole);
}

TEST_F(EnsembleFile, NamesTheStatesThatAreMissing) {
  std::vector<std::string> paths = write_shards(16);
  paths.erase(paths.begin() + 15);
  paths.erase(paths.begin() + 6, paths.begin() + 8);
  expect_refused(paths,
                 "error: states 40 to 51, 94 to 99 of 100 are missing; run again: --shard 7/16, --shard "
                 "8/16, --shard 16/16\n");
  expect_refused({write("last.h5", part_of_whole(100, 100))}, "--shard 19/100, --shard 20/100 and 79 more\n");
  expect_refused({write("half.h5", part_of_whole(1, 2)), write("quarter.h5", part_of_whole(4, 4))},
                 "error: states 50 to 74 of 100 are missing\n");
}

TEST_F(EnsembleFile, NamesTheStatesThatSeveralHold) {
  const std::vector<std::string> paths = write_shards(4);
  expect_refused({paths[0], paths[1], paths[2], paths[3], paths[1]},
                 fmt::format("error: {0} and {0} both have states 25 to 49\n", paths[1]));
  expect_refused({paths[0], write("half.h5", part_of_whole(1, 2)), paths[2], paths[3]},
                 "both have states 0 to 24");
  expect_refused({write("whole.h5", part_of_whole(1, 1)), paths[2]}, "both have states 50 to 74");
  expect_refused({paths[0], write("all.h5", part_of_whole(1, 1)), paths[3]}, "both have states 75 to 99");
}

TEST_F(EnsembleFile, BelongsToOthersOfTheSameEnsembleAlone) {
  const std::string first = write("first.h5", part_of_whole(1, 2));
  const auto expect_other = [&](const std::function<void(EnsembleResult&)>& change, const std::string& what) {
    EnsembleResult other = part_of_whole(2, 2);
    change(other);
    expect_refused({first, write("other.h5", other)},
                   fmt::format("error: {} does not belong to {}: {}\n", path("other.h5"), first, what));
  };
  using R = EnsembleResult;
  expect_other([](R& r) { r.facts.model = "car"; }, "model is car, not cart");
  expect_other([](R& r) { r.facts.source = "car.toml"; }, "source is car.toml, not cart.toml");
  expect_other([](R& r) { r.facts.source_sha256 = "12"; }, "source_sha256 is 12, not 11");
  expect_other([](R& r) { r.facts.program_sha256 = "01"; },
               "program_sha256 is 01, not 00: other options, or another model");
  expect_other([](R& r) { r.facts.generator = "Jourdain 2"; }, "generator is Jourdain 2, not Jourdain");
  expect_other([](R& r) { r.facts.compiler = "c++ 2"; }, "compiler is c++ 2, not c++ 1");
  expect_other([](R& r) { r.facts.method = "euler"; }, "method is euler, not rk4");
  expect_other([](R& r) { r.facts.real = "float"; }, "real is float, not double");
  expect_other([](R& r) { r.facts.step = 0.02; }, "step is 0.02, not 0.01");
  expect_other([](R& r) { r.facts.steps = 51; }, "steps is 51, not 50");
  expect_other([](R& r) { r.facts.seed = 8; }, "seed is 8, not 7");
  expect_other([](R& r) { r.facts.accuracy = 0.2; }, "accuracy is 0.2, not 0.1");
  expect_other(
      [](R& r) {
        r.facts.states = 101;
        r.shard = {2, 2, 51, 101};
      },
      "states is 101, not 100");
  expect_other([](R& r) { r.facts.parameters[1].second = 31; },
               "of its parameters number 2 is stiffness = 31, not stiffness = 30");
  expect_other([](R& r) { r.facts.parameters.pop_back(); },
               "of its parameters number 2 is none, not stiffness = 30");
  expect_other([](R& r) { r.facts.inputs[0].second = 0; },
               "of its inputs number 1 is push = 0, not push = 1.5");
  expect_other([](R& r) { r.facts.spreads[0].second = "normal(6%)"; },
               "of its spreads number 1 is mass = normal(6%), not mass = normal(5%)");
  expect_other([](R& r) { r.columns[1].unit = "cm"; }, "its columns are other ones");
  expect_other([](R& r) { r.columns[1].name = "glide"; }, "its columns are other ones");
}

TEST_F(EnsembleFile, IsRefusedWhereABitIsAnotherOrBytesAreMissing) {
  const std::string bytes = support::read_file(write("one.h5", part_of_whole(1, 1)));
  for (std::size_t i = 0; i < bytes.size(); i += 37) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ (1 << i % 8));
    ASSERT_NE(problem_of(changed), "") << "byte " << i;
  }
  for (std::size_t size = 0; size < bytes.size(); size += size < 600 ? 41 : 501)
    ASSERT_NE(problem_of(bytes.substr(0, size)), "") << size << " bytes";
  EXPECT_EQ(problem_of(bytes + "x"), "it is damaged: not the bytes that were written");
  EXPECT_EQ(problem_of(bytes.substr(512)), "it is no file that 'jourdain ensemble' wrote");
  EXPECT_EQ(problem_of(bytes), "");
}

TEST_F(EnsembleFile, IsRefusedWhereItIsNone) {
  support::write_file(path("rows.h5"), "state,slide\n0,1\n");
  support::write_file(path("empty.h5"), "");
  const std::string body = "no HDF5, but with its hash";
  support::write_file(path("sealed.h5"), commands::head_of(commands::sha256_of(body)) + body);
  expect_refused({path("rows.h5"), path("empty.h5")},
                 fmt::format("error: {}: it is no file that 'jourdain ensemble' wrote\n", path("rows.h5")));
  expect_refused({path("rows.h5"), path("empty.h5")}, path("empty.h5"));
  expect_refused({path("sealed.h5")}, "sealed.h5: it is no HDF5\n");
  expect(merge({path("missing.h5")}), 3, "missing.h5");
  expect(merge({folder_.path()}), 3, folder_.path());
  const std::string whole = write("whole.h5", part_of_whole(1, 1));
  expect(jourdain({"merge", path("all.csv"), whole}), 2, "the file to write comes first and ends in .h5");
  expect(jourdain({"merge", whole, whole}), 2, "is a shard, and would be overwritten");
  const std::string first = write("first.h5", part_of_whole(1, 3)), bytes = support::read_file(first);
  expect(
      jourdain(
          {"merge", first, write("second.h5", part_of_whole(2, 3)), write("third.h5", part_of_whole(3, 3))}),
      2,
      "first.h5: is a shard, states 0 to 33 of 100, and would be overwritten; the file to write comes first");
  EXPECT_EQ(support::read_file(first), bytes);
  expect(jourdain({"merge", whole}), 2, "SHARDS is required");
}

TEST_F(EnsembleFile, IsRefusedWhereItHoldsWhatCannotBe) {
  const auto expect_problem = [&](const std::function<void(EnsembleResult&)>& change,
                                  const std::string& what) {
    EnsembleResult result = part_of_whole(1, 1);
    change(result);
    std::string problem;
    EXPECT_FALSE(read_ensemble_file(write("wrong.h5", result), problem).has_value()) << what;
    EXPECT_EQ(problem, what);
  };
  using R = EnsembleResult;
  expect_problem([](R& r) { r.trusted[3] = 2; }, "'trusted' is not 0 or 1 for each state");
  expect_problem([](R& r) { r.trusted.pop_back(); }, "'trusted' is not 0 or 1 for each state");
  expect_problem([](R& r) { set_value(r, 1, 3, kNaN); }, "column 'slide' is not finite where it is trusted");
  expect_problem([](R& r) { r.halved.columns[0][3] = kNaN; },
                 "column 'slide' is not finite where it is trusted");
  expect_problem([](R& r) { r.halved.columns[0].pop_back(); }, "column 'slide' has no double for each state");
  expect_problem([](R& r) { r.values = [](std::size_t) { return std::vector<double>(99); }; },
                 "column 'mass' has no double for each state");
  expect_problem([](R& r) { r.shard = {1, 2, 0, 100}; }, "states 0 to 100 are no shard 1/2");
  expect_problem([](R& r) { r.shard = {0, 1, 0, 100}; }, "states 0 to 100 are no shard 0/1");
  expect_problem([](R& r) { r.facts.states = 0; }, "it is of 0 states, not of 1 to 100000000");
  expect_problem([](R& r) { r.facts.step = -1; }, "its step or its accuracy is not positive");
  expect_problem([](R& r) { r.facts.step = kNaN; }, "'step' is not finite");
  expect_problem([](R& r) { r.facts.steps = 0; }, "its step or its accuracy is not positive");
  expect_problem([](R& r) { r.facts.accuracy = 0; }, "its step or its accuracy is not positive");
  expect_problem([](R& r) { r.facts.real = "half"; }, "its number type is not known");
  expect_problem([](R& r) { r.facts.model = "cart\x1b[2J"; }, "'model' cannot be printed");
  expect_problem([](R& r) { r.facts.parameters[0].second = kNaN; }, "'mass' is not finite");
  expect_problem([](R& r) { r.facts.spreads.clear(); }, "its drawn columns are not those of its spreads");
  expect_problem([](R& r) { r.columns[1].unit = "m\nm"; }, "'slide' cannot be printed");
}

TEST_F(EnsembleFile, IsReadByPython) {
  EnsembleResult result = part_of_whole(2, 2);
  result.trusted[3] = 0;
  write("part.h5", result);
  const std::string script = R"py(
import h5py, math
with h5py.File("part.h5", "r") as file:
    assert list(file.attrs) == ["format", "format_version", "generator", "compiler", "program_sha256", "model", "source",
        "source_sha256", "method", "real", "step", "steps", "seed", "states", "accuracy", "shard", "begin", "end"]
    texts = {name: value.decode() for name, value in file.attrs.items() if isinstance(value, bytes)}
    assert (texts["model"], texts["source"], texts["shard"]) == ("cart", "cart.toml", "2/2")
    numbers = [file.attrs[name] for name in ("step", "steps", "seed", "states", "accuracy", "begin", "end")]
    assert numbers == [0.01, 50, 7, 100, 0.1, 50, 100], numbers
    assert list(file["parameters"].attrs.items()) == [("mass", 2), ("stiffness", 30)]
    assert dict(file["inputs"].attrs) == {"push": 1.5} and dict(file["spreads"].attrs) == {"mass": b"normal(5%)"
}
    rows, half = file["rows"], file["half_step"]
    assert list(rows) == ["state", "mass", "slide", "a%2Fb%25.", "%2E", "trusted"]
    assert list(half) == ["state", "slide", "a%2Fb%25.", "%2E", "trusted"]
    assert [(column.attrs["unit"], column.attrs["kind"]) for column in list(rows.values())[1:5]] == [
        (b"kg", b"drawn"), (b"m", b"end"), (b"", b"end"), (b"1", b"end")]
    assert rows["state"].dtype == "<u8" and rows["slide"].dtype == "<f8" and rows["trusted"].dtype == "u1"
    assert rows["slide"].chunks is None and rows["slide"].compression is None
    assert list(rows["state"]) == list(range(50, 100)) and list(half["state"]) == list(range(50, 82))
    assert [k for k in range(50) if not rows["trusted"][k]] == [3] and half["trusted"].shape == (32,)
    for name, number in (("mass", 0), ("slide", 1), ("%2E", 3)):
        for k in range(50):
            assert math.isclose(rows[name][k], 1.5 + math.sin(3 * number + 2.7 * (50 + k)), rel_tol=1e-12)
)py";
  const auto python =
      support::run_process({"env", "-C", folder_.path(), "/usr/bin/python3", "-W", "error", "-c", script});
  EXPECT_EQ(python.status, 0) << python.output;
}

/// Whatever a file with the right hash holds: nothing worse than a refusal.
TEST_F(EnsembleFile, WithAnotherBitAndItsHashIsReadOrRefused) {
  const std::string bytes = support::read_file(write("one.h5", part_of_whole(1, 1)));
  int refused = 0;
  for (std::size_t i = commands::kHead; i < bytes.size(); i += 17) {
    std::string body = bytes.substr(commands::kHead);
    body[i - commands::kHead] = static_cast<char>(body[i - commands::kHead] ^ (1 << i % 8));
    refused += problem_of(commands::head_of(commands::sha256_of(body)) + body).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 200);
}

TEST_F(EnsembleFile, MergedHasTheVerdictOfTheWholeAndThoseOfItsShards) {
  EnsembleResult second = part_of_whole(2, 2);
  second.halved.columns[0][2] += 1;
  const std::string first = write("1.h5", part_of_whole(1, 2));
  const support::ProcessResult result = merge({first, write("2.h5", second)});
  expect(result, 1,
         fmt::format("error: {}: half the step moves ends of states 50 to 81 by at most 1.4 of a deviation "
                     "(slide); allowed are 0.1\n",
                     path("2.h5")));
  EXPECT_EQ(result.output.find("the step is too long"), std::string::npos) << result.output;
  EXPECT_EQ(support::read_file(path("merged.h5")),
            support::read_file(write("whole.h5", part_of_whole(1, 1))));

  second = part_of_whole(2, 2);
  second.trusted[30] = 0;
  set_value(second, 1, 30, kNaN);
  expect(merge({first, write("2.h5", second)}), 1,
         fmt::format("error: 1 of 100 states are not to be trusted: a number is not finite, loops could not "
                     "be closed, or how they are closed is not proven for their parameters\n"
                     "  state 80: mass = {:g}\n",
                     number_of(0, 80)));
  EnsembleResult shaky = part_of_whole(1, 2);
  shaky.halved.trusted[4] = 0;
  expect(merge({write("1.h5", shaky), write("2.h5", part_of_whole(2, 2))}), 1, "the step is too long");
}

TEST_F(EnsembleFile, IsDrawn) {
  EnsembleResult result = part_of_whole(1, 1);
  result.trusted[0] = 0;
  result.values = [](std::size_t column) {
    constexpr double kGreatest = std::numeric_limits<double>::max();
    std::vector<double> values(kStates, column == 0 ? 2 : column == 1 ? 1e-310 : 3);
    for (std::size_t k = 0; k < kStates; k += 2) values[k] += column == 1 ? 1e-310 : column == 3 ? 1e-9 : 0;
    if (column == 2) values[3] = kGreatest, values[4] = -kGreatest;
    values[0] = kNaN;
    return values;
  };
  const std::string file = write("whole.h5", result);
  const auto draw = [&](const std::string& picture) {
    return jourdain({"merge", path("merged.h5"), file, "--plot", path(picture)});
  };
  expect(draw("plot.svg"), 1, "merged.h5, " + path("plot.svg"));
  tinyxml2::XMLDocument picture;
  ASSERT_EQ(picture.LoadFile(path("plot.svg").c_str()), tinyxml2::XML_SUCCESS);
  const std::string text = support::read_file(path("plot.svg"));
  for (const char* words : {"cart: 100 states; lines at 5 %, the median and 95 %", ">mass, kg<", ">slide, m<",
                            ">a/b%.<", ">. less 3, 1<"})
    EXPECT_NE(text.find(words), std::string::npos) << words;
  expect(draw("plot.png"), 2, "plot.png: a file that ends in .svg is expected");
  result.trusted.assign(kStates, 0);
  write("whole.h5", result);
  std::filesystem::remove(path("plot.svg"));
  expect(draw("plot.svg"), 1, "note: no plot: no state is to be trusted");
  EXPECT_FALSE(std::filesystem::exists(path("plot.svg")));
}

TEST_F(EnsembleFile, IsNotLeftHalfWritten) {
  const std::vector<std::string> paths = write_shards(2);
  expect(jourdain({"merge", path("missing/merged.h5"), paths[0], paths[1]}), 3, "cannot be written");
  std::filesystem::create_directory(path("folder.h5"));
  expect(jourdain({"merge", path("folder.h5"), paths[0], paths[1]}), 3, "it is a folder");
  const auto count = std::distance(std::filesystem::directory_iterator(folder_.path()), {});
  EXPECT_EQ(count, 3) << "temporary files stay";
  const auto limited =
      support::run_process({"sh", "-c",
                            fmt::format("ulimit -f 8; trap '' XFSZ; '{}' merge '{}' '{}' '{}'",
                                        JOURDAIN_BINARY, path("merged.h5"), paths[0], paths[1])});
  EXPECT_EQ(limited.status, 3) << limited.output;
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), count);
}

}  // namespace
}  // namespace jourdain::tests
