// The rules of services/README.md that a compiler does not enforce: who may include whom, which
// folder each third-party library lives in, and that what is meant to be pure reads no clock.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace trailcast {
namespace {

namespace fs = std::filesystem;
using Folders = std::set<std::string>;
using testing::IsEmpty;

// What each folder of services/ may include besides itself: base -> motion, route, image, belief ->
// view -> vision, teach, replay, store -> exchange, archive, catalog, security -> dds, sim ->
// agent, route_server.
const std::map<std::string, Folders> kMayInclude{
    {"base", {}},
    {"motion", {"base"}},
    {"image", {"base"}},
    {"route", {"base", "motion"}},
    {"vision", {"base", "motion", "image", "route", "view"}},
    {"teach", {"base", "motion", "route", "view"}},
    {"replay", {"base", "motion", "route"}},
    {"view", {"base", "route"}},
    {"belief", {"base"}},
    {"store", {"base", "route"}},
    {"exchange", {"base", "route", "store"}},
    {"archive", {"base", "route", "exchange"}},
    {"catalog", {"base", "route", "view", "store", "exchange"}},
    {"security", {"base", "route", "exchange"}},
    {"dds", {"base", "motion", "image", "route", "exchange", "security"}},
    {"sim", {"base", "motion", "image"}},
    {"trial", {"base", "image"}},
};

// Where each third-party library may be used, by the beginning of its headers' names. "services/x"
// is one folder, "agent" a whole program, "*" everywhere.
struct Library {
  std::string prefix;
  Folders homes;
};
const std::vector<Library> kLibraries{
    {"opencv2/", {"services/image", "services/trial", "services/vision"}},
    {"google/protobuf/", {"services/route"}},
    {"idl/route.pb.h", {"services/route"}},
    {"dds/", {"services/dds"}},
    {"SQLiteCpp/", {"services/store"}},
    {"sqlite3.h", {"services/store"}},
    {"pqxx/", {"services/store"}},
    {"embree3/", {"services/sim"}},
    {"assimp/", {"services/sim"}},
    {"openssl/", {"services/route", "services/security"}},
    {"tl/", {"services/base"}},
    {"CLI/", {"agent", "route_server"}},
    {"httplib.h", {"route_server"}},
    {"spdlog/", {"agent", "route_server"}},
    {"Eigen/", {"*"}},
    {"fmt/", {"*"}},
};
// Headers of the system itself; anything else in angle brackets with a slash or a ".h" must be a
// library of the list above.
const std::set<std::string> kSystemHeaders{
    "dirent.h",       "dlfcn.h",        "errno.h",      "fcntl.h",      "ifaddrs.h",
    "malloc.h",       "netdb.h",        "poll.h",       "pthread.h",    "pwd.h",
    "sched.h",        "signal.h",       "spawn.h",      "termios.h",    "time.h",
    "unistd.h",       "arpa/inet.h",    "net/if.h",     "netinet/in.h", "sys/epoll.h",
    "sys/eventfd.h",  "sys/file.h",     "sys/ioctl.h",  "sys/mman.h",   "sys/prctl.h",
    "sys/resource.h", "sys/signalfd.h", "sys/socket.h", "sys/stat.h",   "sys/statvfs.h",
    "sys/time.h",     "sys/timerfd.h",  "sys/timex.h",  "sys/types.h",  "sys/un.h",
    "sys/utsname.h",  "sys/wait.h"};

struct Include {
  std::string folder;  // "services/vision", "agent", "route_server"
  std::string where;   // file:line
  std::string header;
  bool quoted = false;
};

struct SourceLine {
  std::string folder;
  std::string where;
  std::string text;
};

std::vector<SourceLine> ReadSources() {
  const fs::path root(TRAILCAST_SOURCE_DIR);
  std::vector<SourceLine> lines;
  for (const char* top : {"services", "agent", "route_server"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cc" && extension != ".c") continue;
      const fs::path path = entry.path().lexically_relative(root);
      auto part = path.begin();
      std::string folder = *part++;
      if (folder == "services") folder.append("/").append(part->string());
      std::ifstream in(entry.path());
      std::string text;
      for (int number = 1; std::getline(in, text); ++number) {
        lines.push_back({folder, path.string() + ":" + std::to_string(number), text});
      }
    }
  }
  return lines;
}

std::vector<Include> FindIncludes(const std::vector<SourceLine>& lines) {
  const auto after = [](const std::string& text, std::string_view word) -> std::string {
    const std::size_t start = text.find_first_not_of(" \t");
    if (start == std::string::npos || !text.substr(start).starts_with(word)) return "";
    return text.substr(start + word.size());
  };
  std::vector<Include> includes;
  for (const SourceLine& line : lines) {
    const std::string rest = after(after(line.text, "#"), "include");
    const std::size_t open = rest.find_first_of("<\"");
    if (open == std::string::npos) continue;
    const bool quoted = rest[open] == '"';
    const std::size_t close = rest.find(quoted ? '"' : '>', open + 1);
    includes.push_back({line.folder, line.where, rest.substr(open + 1, close - open - 1), quoted});
  }
  return includes;
}

// Empty if the include is allowed, else what is wrong with it.
std::string FaultOf(const Include& include) {
  const std::string& header = include.header;
  for (const Library& library : kLibraries) {
    if (!header.starts_with(library.prefix)) continue;
    const bool home = library.homes.contains("*") || library.homes.contains(include.folder);
    return home ? "" : "belongs in " + testing::PrintToString(library.homes);
  }
  if (header.starts_with("tests/")) return "belongs in tests/";
  if (header.starts_with("services/")) {
    if (!include.folder.starts_with("services/")) return "";
    const std::string from = include.folder.substr(9);
    const std::string to = header.substr(9, header.find('/', 9) - 9);
    if (from == to) return "";
    if (!kMayInclude.contains(from)) return "is in a folder this test has no rule for";
    return kMayInclude.at(from).contains(to) ? "" : "goes against the order of services/";
  }
  if (include.quoted) {
    if (header.starts_with(include.folder + "/")) return "";  // agent/ and route_server/ themselves
    if (header.starts_with("agent/cli/")) {                   // what all programs share
      return include.folder == "route_server" ? "" : "is for programs only";
    }
    // What idlc generates from idl/*.idl bears the bare name of its file.
    return include.folder == "services/dds" ? "" : "is given by no path from the root";
  }
  const bool library_like = header.find('/') != std::string::npos || header.ends_with(".h");
  if (!library_like || kSystemHeaders.contains(header)) return "";
  return "is of a library that has no folder yet";
}

std::vector<std::string> Faults(const std::vector<Include>& includes) {
  std::vector<std::string> faults;
  for (const Include& include : includes) {
    const std::string fault = FaultOf(include);
    if (!fault.empty()) faults.push_back(include.where + ": " + include.header + " " + fault);
  }
  return faults;
}

TEST(Layering, EveryIncludeFollowsTheOrderOfFoldersAndKeepsLibrariesInTheirs) {
  const std::vector<Include> includes = FindIncludes(ReadSources());
  EXPECT_GT(includes.size(), 50U) << "read from " << TRAILCAST_SOURCE_DIR;
  EXPECT_THAT(Faults(includes), IsEmpty());
}

TEST(Layering, EveryFolderOfServicesHasARule) {
  for (const auto& entry : fs::directory_iterator(fs::path(TRAILCAST_SOURCE_DIR) / "services")) {
    if (entry.is_directory()) {
      EXPECT_TRUE(kMayInclude.contains(entry.path().filename())) << entry.path();
    }
  }
}

TEST(Layering, RulesLeadNoFolderBackToItself) {
  // Each folder may include only folders that may not, by any way, include it.
  for (const auto& [folder, allowed] : kMayInclude) {
    Folders reached;
    std::vector<std::string> open(allowed.begin(), allowed.end());
    while (!open.empty()) {
      const std::string next = open.back();
      open.pop_back();
      if (!reached.insert(next).second) continue;
      open.insert(open.end(), kMayInclude.at(next).begin(), kMayInclude.at(next).end());
    }
    EXPECT_FALSE(reached.contains(folder)) << folder;
  }
}

// Time comes in with the data, stamped at the sensor: the same recording gives the same result.
bool ReadsAClock(const std::string& line) {
  static const std::vector<std::string> kClocks{"steady_clock",          "system_clock",
                                                "high_resolution_clock", "::now(",
                                                "clock_gettime",         "gettimeofday"};
  return std::any_of(kClocks.begin(), kClocks.end(),
                     [&](const std::string& clock) { return line.find(clock) != line.npos; });
}

TEST(Layering, VisionTeachingAndReplayReadNoClock) {
  const Folders pure{"services/motion", "services/vision", "services/teach", "services/replay"};
  std::vector<std::string> readers;
  for (const SourceLine& line : ReadSources()) {
    if (pure.contains(line.folder) && ReadsAClock(line.text)) readers.push_back(line.where);
  }
  EXPECT_THAT(readers, IsEmpty());
}

// The test's own teeth.
TEST(Layering, FaultsAreFound) {
  const auto fault = [](const std::string& folder, const std::string& line) {
    const auto includes = FindIncludes({{folder, "file.cc:1", line}});
    EXPECT_EQ(includes.size(), 1U) << line;
    return includes.empty() ? "not an include" : FaultOf(includes[0]);
  };
  EXPECT_EQ(fault("services/replay", "#include \"services/motion/motion.h\""), "");
  EXPECT_EQ(fault("services/vision", "#include <opencv2/core.hpp>"), "");
  EXPECT_EQ(fault("agent", "#include \"services/sim/world.h\""), "");
  EXPECT_EQ(fault("services/dds", "#include \"trailcast.h\"  // generated"), "");
  EXPECT_EQ(fault("services/base", "#include <vector>"), "");
  EXPECT_EQ(fault("agent", "#include <sys/wait.h>"), "");
  EXPECT_NE(fault("services/replay", "#include \"services/sim/world.h\""), "");
  EXPECT_NE(fault("services/base", "#include \"services/route/route.h\""), "");
  EXPECT_NE(fault("services/exchange", "#include \"services/dds/dds_exchange.h\""), "");
  EXPECT_NE(fault("services/teach", "  #  include <opencv2/core.hpp>"), "");
  EXPECT_NE(fault("agent", "#include <dds/dds.h>"), "");
  EXPECT_NE(fault("services/exchange", "#include \"idl/route.pb.h\""), "");
  EXPECT_NE(fault("services/store", "#include <boost/asio.hpp>"), "");
  EXPECT_NE(fault("services/vision", "#include \"frame.h\""), "");
  EXPECT_NE(fault("agent", "#include \"route_server/keeper.h\""), "");
  EXPECT_NE(fault("services/vision", "#include \"tests/support/temp_dir.h\""), "");
  EXPECT_TRUE(ReadsAClock("const auto t = Clock::now();"));
  EXPECT_TRUE(ReadsAClock("std::chrono::steady_clock::time_point start;"));
  EXPECT_FALSE(ReadsAClock("const bool known = IsKnown(now);"));
}

}  // namespace
}  // namespace trailcast
