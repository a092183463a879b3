// Scenario and arm files that are broken in many ways, through everything that reads them up to the first cycle: accepted, or
// refused with one line. None ends the reader, none keeps it for long.
#include <gtest/gtest.h>
#include <sys/time.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>

#include "reed/config/schema/arm_file.h"
#include "reed/tests/endurance/how_long.h"
#include "reed/tests/endurance/text_mutants.h"
#include "reed/tests/firmware/sil_rig.h"

namespace reed {
namespace {

namespace fs = std::filesystem;

constexpr int kLongest_s = 300;  // of this process's time, for one file

std::string Text(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// A text as its kind of file; what was not read within the time ends the test.
class Written {
 public:
  Written(const fs::path& folder, const std::string& text) : path_(folder / "mutant.toml") {
    std::ofstream(path_, std::ios::binary) << text;
    SetLimit(kLongest_s);
  }
  Written(const Written&) = delete;
  Written& operator=(const Written&) = delete;
  ~Written() { SetLimit(0); }
  std::string path() const { return path_.string(); }

 private:
  static void SetLimit(int seconds) {
    const itimerval limit{{0, 0}, {seconds, 0}};
    setitimer(ITIMER_PROF, &limit, nullptr);
  }
  fs::path path_;
};

/// What a program that reads it would say; "" when it would start.
std::string Problem(const std::string& scenario, const LoadOptions& options) {
  try {
    const Scenario read = LoadScenario(scenario, options);
    EXPECT_FALSE(EffectiveToml(read).empty());
    if (read.arm.dof() != 5) return "";  // this test has no controller for them
    test::SilRig rig(read);
    for (int k = 0; k < 5; ++k) rig.Run();
    return "";
  } catch (const std::bad_alloc&) {
    ADD_FAILURE() << "asks for more memory than there is";
    return "out of memory";
  } catch (const std::exception& error) {
    return *error.what() == '\0' ? "no words" : error.what();
  }
}

class ConfigFuzz : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kSeed = 14;

  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("reed-config-fuzz-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(folder_);
  }

  /// Shared among the files of a kind.
  static std::vector<fs::path> Sources(const std::string& kind) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(
             fs::path(FindConfig("scenarios", "press_known")).parent_path().parent_path() / kind))
      if (entry.path().extension() == ".toml") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }

  /// One with as many joints.
  static std::string ScenarioOf(const std::string& arm) {
    return arm == "p2" ? "joints2" : arm == "a6" ? "joints6" : arm == "a7" ? "joints7" : "free_motion";
  }

  void Run(const std::string& kind, long count) {
    const std::vector<fs::path> sources = Sources(kind);
    std::vector<std::string> texts;
    for (const fs::path& path : sources) texts.push_back(Text(path));
    long accepted = 0;
    for (long number = 0; number < count; ++number) {
      const std::size_t which = static_cast<std::size_t>(number) % texts.size();
      const Written file(folder_,
                         test::TextMutant(kSeed, static_cast<std::uint64_t>(number)).Of(texts[which]));
      const std::string problem = kind == "arms"
                                      ? Problem(ScenarioOf(sources[which].stem()), {file.path(), {}})
                                      : Problem(file.path(), {});
      accepted += problem.empty() ? 1 : 0;
      ASSERT_EQ(problem.find('\n'), std::string::npos) << problem << "\n" << About(number, sources[which]);
      ASSERT_LT(problem.size(), 2000U) << problem << "\n" << About(number, sources[which]);
      ASSERT_FALSE(HasFailure()) << About(number, sources[which]);
    }
    EXPECT_GT(accepted, count / 50) << "mutants that are all refused at once test little";
    EXPECT_LT(accepted, count - count / 3);
  }

  std::string About(long number, const fs::path& source) const {
    return "mutant " + std::to_string(number) + " of " + source.string() + ", kept in " + folder_.string();
  }

  fs::path folder_;
};

TEST_F(ConfigFuzz, Scenarios) { Run("scenarios", test::HowMany(300, 10'000)); }
TEST_F(ConfigFuzz, Arms) { Run("arms", test::HowMany(150, 10'000)); }

}  // namespace
}  // namespace reed
