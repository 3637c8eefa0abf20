// The rules of services/README.md that a compiler does not enforce: who may include whom, which
// room each third-party library lives in, and that what is meant to be pure reads no clock.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/support/places.h"
#include "tests/unit/base/source_rooms.h"

namespace trailcast {
namespace {

namespace fs = std::filesystem;
using Rooms = std::set<std::string>;
using testing::IsEmpty;

// A room may include itself and the rooms that are listed here for it. A room is a folder of
// services/, services/lab/, agent/ or route_server/, which is one itself as well.
const std::map<std::string, Rooms> kMayInclude{
    {"services/base", {}},
    {"services/motion", {"services/base"}},
    {"services/odometry", {"services/base", "services/motion"}},
    {"services/image", {"services/base"}},
    {"services/bag", {"services/base", "services/motion", "services/image"}},
    {"services/route", {"services/base", "services/motion"}},
    {"services/vision",
     {"services/base", "services/motion", "services/image", "services/route", "services/view"}},
    {"services/teach", {"services/base", "services/motion", "services/route", "services/view"}},
    {"services/replay", {"services/base", "services/motion", "services/route"}},
    {"services/view", {"services/base", "services/route"}},
    {"services/belief", {"services/base"}},
    {"services/junctions", {"services/base", "services/route", "services/view"}},
    {"services/refresh", {"services/base", "services/route"}},
    {"services/mission", {"services/base", "services/route"}},
    {"services/photos", {"services/base", "services/image", "services/route"}},
    {"services/schedule", {"services/base", "services/mission"}},
    {"services/network", {"services/base"}},
    {"services/store", {"services/base", "services/route"}},
    {"services/records",
     {"services/base", "services/route", "services/mission", "services/network", "services/store"}},
    {"services/exchange",
     {"services/base", "services/route", "services/mission", "services/store"}},
    {"services/archive", {"services/base", "services/route"}},
    {"services/catalog",
     {"services/base", "services/route", "services/view", "services/store", "services/exchange"}},
    {"services/security", {"services/base", "services/route", "services/exchange"}},
    {"services/dds",
     {"services/base", "services/motion", "services/image", "services/route", "services/exchange",
      "services/security"}},
    {"services/program",
     {"services/base", "services/route", "services/exchange", "services/security", "services/dds"}},
    {"services/fleet",
     {"services/base", "services/image", "services/route", "services/view", "services/vision",
      "services/mission", "services/network", "services/photos", "services/schedule",
      "services/store", "services/exchange", "services/archive", "services/program"}},
    {"services/http", {"services/base"}},
    {"services/users", {"services/base"}},
    {"services/webhooks", {"services/base", "services/http", "services/program"}},
    {"services/console",
     {"services/archive", "services/base", "services/exchange", "services/fleet", "services/http",
      "services/image", "services/mission", "services/network", "services/photos",
      "services/program", "services/route", "services/schedule", "services/users", "services/view",
      "services/replay", "services/explain", "services/webhooks", "agent/diagnosis"}},
    {"services/vda5050",
     {"services/base", "services/exchange", "services/fleet", "services/mission",
      "services/network", "services/program", "services/route"}},
    {"services/plot", {"services/base", "services/image"}},
    {"agent/session",
     {"services/base", "services/motion", "services/image", "services/route", "services/view",
      "services/vision", "services/teach", "services/replay", "services/belief",
      "services/refresh"}},
    {"agent/diagnosis",
     {"services/base", "services/motion", "services/image", "services/bag", "services/route",
      "services/vision", "services/replay", "agent/session"}},
    {"agent/device",
     {"services/base", "services/motion", "services/odometry", "services/image", "services/route",
      "services/view", "services/vision", "services/teach", "services/bag", "services/dds",
      "services/program", "agent/session"}},
    {"agent/link",
     {"services/base", "services/route", "services/mission", "services/photos", "services/store",
      "services/exchange", "services/program", "agent/session"}},
    {"agent/photos",
     {"services/base", "services/image", "services/route", "services/mission", "services/photos"}},
    {"agent/camera_view",
     {"services/base", "services/image", "services/exchange", "agent/diagnosis", "agent/device",
      "agent/link"}},
    {"agent/teach",
     {"services/base", "services/motion", "services/route", "services/vision", "services/mission",
      "services/store", "services/exchange", "agent/session", "agent/diagnosis", "agent/device",
      "agent/link", "agent/camera_view"}},
    {"agent/follow",
     {"services/base", "services/motion", "services/route", "services/refresh", "agent/session",
      "agent/diagnosis", "agent/device", "agent/link", "agent/camera_view", "agent/photos"}},
    {"agent/fetch", {"services/base", "agent/diagnosis", "agent/link"}},
    {"agent/duty",
     {"services/base", "services/motion", "services/route", "services/vision", "services/view",
      "services/refresh", "services/mission", "services/photos", "services/store",
      "services/exchange", "services/program", "agent/diagnosis", "agent/device", "agent/link",
      "agent/camera_view", "agent/photos", "agent/teach", "agent/follow"}},
    {"agent/cli",
     {"services/base", "services/photos", "services/program", "agent/session", "agent/device",
      "agent/camera_view", "agent/teach", "agent/follow", "agent/fetch", "agent/duty"}},
    {"route_server/routes",
     {"services/base", "services/route", "services/network", "services/store", "services/records",
      "services/exchange", "services/catalog", "services/junctions", "services/refresh"}},
    {"route_server/fleet",
     {"services/base", "services/mission", "services/photos", "services/route", "services/schedule",
      "services/records", "services/exchange"}},
    {"route_server/junctions",
     {"services/base", "services/route", "services/view", "services/junctions", "services/store",
      "services/catalog", "route_server/routes"}},
    {"route_server/network",
     {"services/base", "services/route", "services/mission", "services/network", "services/store",
      "services/records", "services/exchange", "route_server/routes", "route_server/fleet",
      "route_server/junctions"}},
    {"route_server/status",
     {"services/base", "services/route", "services/exchange", "services/http"}},
    {"route_server",
     {"services/base", "services/route", "services/mission", "services/photos", "services/schedule",
      "services/store", "services/exchange", "services/catalog", "services/program",
      "route_server/routes", "route_server/fleet", "route_server/network", "route_server/junctions",
      "route_server/status"}},
    {"services/explain", {"services/base", "services/image", "services/plot", "agent/diagnosis"}},
    {"services/lab/sim", {"services/base", "services/motion", "services/image"}},
    {"services/lab/simulated",
     {"services/base", "services/motion", "services/image", "services/dds", "services/program",
      "services/lab/sim", "agent/device", "agent/diagnosis"}},
    {"services/lab/trial",
     {"services/base", "services/motion", "services/image", "services/route", "services/store",
      "services/exchange", "services/plot", "services/refresh", "services/vision",
      "services/lab/sim", "services/lab/simulated", "agent/session", "agent/diagnosis",
      "agent/device"}},
    {"services/lab/demo",
     {"services/base", "services/image", "services/exchange", "services/fleet", "services/mission",
      "services/network", "services/program", "services/plot", "services/lab/sim",
      "services/lab/trial"}},
    {"services/tool", {"services/base",      "services/fleet",         "services/image",
                       "services/photos",    "services/route",         "services/view",
                       "services/mission",   "services/network",       "services/vision",
                       "services/store",     "services/schedule",      "services/exchange",
                       "services/archive",   "services/catalog",       "services/security",
                       "services/program",   "services/plot",          "services/explain",
                       "services/junctions", "services/lab/sim",       "services/lab/trial",
                       "services/lab/demo",  "services/lab/simulated", "services/odometry",
                       "agent/session",      "agent/diagnosis",        "agent/device"}},
};

// The rooms where each third-party library may be used, by the beginning of its headers' names; "*"
// is everywhere.
struct Library {
  std::string prefix;
  Rooms homes;
};
const std::vector<Library> kLibraries{
    {"opencv2/", {"services/image", "services/lab/trial", "services/photos", "services/vision"}},
    {"jpeglib.h", {"services/image"}},
    {"google/protobuf/", {"services/route"}},
    {"idl/route.pb.h", {"services/route"}},
    {"idl/run_log_description.h", {"agent/diagnosis"}},
    {"dds/", {"services/dds"}},
    {"SQLiteCpp/", {"services/bag", "services/records", "services/store"}},
    {"sqlite3.h", {"services/bag", "services/records", "services/store"}},
    {"lz4frame.h", {"services/bag"}},
    {"zstd.h", {"services/bag"}},
    {"pqxx/", {"services/store"}},
    {"embree3/", {"services/lab/sim"}},
    {"assimp/", {"services/lab/sim"}},
    {"openssl/",
     {"services/http", "services/route", "services/security", "services/users",
      "services/webhooks"}},
    {"tl/", {"services/base"}},
    {"CLI/",
     {"services/console", "services/program", "services/tool", "services/vda5050",
      "services/lab/simulated", "agent/cli", "agent/device", "route_server"}},
    {"cctz/", {"services/schedule"}},
    {"mosquitto.h", {"services/vda5050"}},
    {"httplib.h", {"services/http"}},
    {"nlohmann/",
     {"services/console", "services/fleet", "services/program", "services/tool", "services/vda5050",
      "services/webhooks"}},
    {"spdlog/",
     {"services/console", "services/program", "services/vda5050", "services/lab/simulated",
      "agent/cli", "agent/device", "agent/duty", "agent/fetch", "agent/follow", "agent/link",
      "agent/teach", "route_server", "route_server/routes"}},
    {"Eigen/", {"*"}},
    {"fmt/", {"*"}},
    {"cairo/", {"services/plot"}},
};
// Headers of the system itself; anything else in angle brackets with a slash or a ".h" must be a
// library of the list above.
const std::set<std::string> kSystemHeaders{
    "dirent.h",      "dlfcn.h",        "errno.h",         "fcntl.h",      "ifaddrs.h",
    "malloc.h",      "netdb.h",        "poll.h",          "pthread.h",    "pwd.h",
    "sched.h",       "signal.h",       "spawn.h",         "termios.h",    "time.h",
    "unistd.h",      "arpa/inet.h",    "linux/sockios.h", "net/if.h",     "netinet/in.h",
    "sys/epoll.h",   "sys/eventfd.h",  "sys/file.h",      "sys/ioctl.h",  "sys/mman.h",
    "sys/prctl.h",   "sys/resource.h", "sys/signalfd.h",  "sys/socket.h", "sys/stat.h",
    "sys/statvfs.h", "sys/time.h",     "sys/timerfd.h",   "sys/timex.h",  "sys/types.h",
    "sys/un.h",      "sys/utsname.h",  "sys/wait.h"};

// Whether it is among the sources of a room that the file at `where` is not in.
bool IsPrivateElsewhere(const std::string& header, const std::string& where) {
  const std::size_t sources = header.find("/src/");
  if (sources == std::string::npos) return false;
  const std::string room = header.substr(0, sources);
  const std::string folder = fs::path(where).parent_path().string();
  return folder != room && !(folder + "/").starts_with(room + "/src/");
}

// Empty if the include is allowed, else what is wrong with it.
std::string FaultOf(const Include& include) {
  const std::string& header = include.header;
  for (const Library& library : kLibraries) {
    if (!header.starts_with(library.prefix)) continue;
    const bool home = library.homes.contains("*") || library.homes.contains(include.room);
    return home ? "" : "belongs in " + testing::PrintToString(library.homes);
  }
  if (header.starts_with("tests/")) return "belongs in tests/";
  if (include.quoted) {
    // A header that idlc generates from idl/*.idl has the bare name of its file.
    if (header.find('/') == std::string::npos) {
      return include.room == "services/dds" ? "" : "is given by no path from the root";
    }
    if (IsPrivateElsewhere(header, include.where)) return "is not offered to others";
    const std::string room = RoomOf(header);
    if (room == include.room) return "";
    if (!kMayInclude.contains(include.room)) return "is in a room this test has no rule for";
    return kMayInclude.at(include.room).contains(room) ? "" : "goes against the order of rooms";
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

TEST(Layering, EveryIncludeFollowsTheOrderOfRoomsAndKeepsLibrariesInTheirs) {
  const std::vector<Include> includes = FindIncludes(ReadSources());
  EXPECT_GT(includes.size(), 50U) << "read from " << SourceDir();
  EXPECT_THAT(Faults(includes), IsEmpty());
}

TEST(Layering, EveryRoomHasARule) {
  const fs::path root(SourceDir());
  for (const char* top : {"services", "services/lab", "agent", "route_server"}) {
    for (const auto& entry : fs::directory_iterator(root / top)) {
      const std::string room = entry.path().lexically_relative(root).string();
      if (!entry.is_directory() || room == "services/lab") continue;
      EXPECT_TRUE(kMayInclude.contains(room)) << room;
    }
  }
}

// All rooms that a room may include by any way.
Rooms ReachedFrom(const std::string& room) {
  Rooms reached;
  std::vector<std::string> open{room};
  while (!open.empty()) {
    const Rooms& allowed = kMayInclude.at(open.back());
    open.pop_back();
    for (const std::string& next : allowed) {
      if (reached.insert(next).second) open.push_back(next);
    }
  }
  return reached;
}

TEST(Layering, RulesLeadNoRoomBackToItself) {
  for (const auto& [room, allowed] : kMayInclude) {
    EXPECT_FALSE(ReachedFrom(room).contains(room)) << room;
  }
}

TEST(Layering, NothingOfTheLaboratoryRunsOnARobotOrAServer) {
  const auto is_of_the_laboratory = [](const std::string& room) {
    return room.starts_with("services/lab/");
  };
  for (const auto& [room, allowed] : kMayInclude) {
    if (!room.starts_with("agent/") && !room.starts_with("route_server")) continue;
    EXPECT_EQ(std::ranges::count_if(ReachedFrom(room), is_of_the_laboratory), 0) << room;
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

TEST(Layering, VisionTeachingReplayAndSessionsReadNoClock) {
  const Rooms pure{"services/motion", "services/odometry", "services/vision", "services/teach",
                   "services/replay", "services/belief",   "agent/session"};
  std::vector<std::string> readers;
  for (const SourceLine& line : ReadSources()) {
    if (pure.contains(line.room) && ReadsAClock(line.text)) readers.push_back(line.where);
  }
  EXPECT_THAT(readers, IsEmpty());
}

// The test's own teeth.
TEST(Layering, FaultsAreFound) {
  const auto fault = [](const std::string& room, const std::string& line) {
    const auto includes = FindIncludes({{room, room + "/src/file.cc:1", line}});
    EXPECT_EQ(includes.size(), 1U) << line;
    return includes.empty() ? "not an include" : FaultOf(includes[0]);
  };
  EXPECT_EQ(fault("services/replay", "#include \"services/motion/motion.h\""), "");
  EXPECT_EQ(fault("services/vision", "#include <opencv2/core.hpp>"), "");
  EXPECT_EQ(fault("services/lab/trial", "#include \"services/lab/sim/core/world.h\""), "");
  EXPECT_EQ(fault("services/dds", "#include \"services/dds/src/wire.h\""), "");
  EXPECT_EQ(fault("services/dds", "#include \"trailcast.h\"  // generated"), "");
  EXPECT_EQ(fault("services/base", "#include <vector>"), "");
  EXPECT_EQ(fault("agent/cli", "#include <sys/wait.h>"), "");
  EXPECT_NE(fault("services/replay", "#include \"services/lab/sim/core/world.h\""), "");
  EXPECT_NE(fault("agent/device", "#include \"services/lab/sim/core/world.h\""), "");
  EXPECT_NE(fault("services/session", "#include \"services/lab/trial/trial.h\""), "");
  EXPECT_NE(fault("services/program", "#include \"services/dds/src/wire.h\""), "");
  EXPECT_NE(fault("services/lab/trial/judge", "#include \"services/lab/trial/src/trial_log.h\""),
            "");
  EXPECT_NE(fault("services/base", "#include \"services/route/route.h\""), "");
  EXPECT_NE(fault("services/exchange", "#include \"services/dds/dds_exchange.h\""), "");
  EXPECT_NE(fault("services/teach", "  #  include <opencv2/core.hpp>"), "");
  EXPECT_NE(fault("agent/duty", "#include <dds/dds.h>"), "");
  EXPECT_NE(fault("services/exchange", "#include \"idl/route.pb.h\""), "");
  EXPECT_NE(fault("services/store", "#include <boost/asio.hpp>"), "");
  EXPECT_NE(fault("services/vision", "#include \"frame.h\""), "");
  EXPECT_NE(fault("agent/duty", "#include \"route_server/keeper.h\""), "");
  EXPECT_NE(fault("services/vision", "#include \"tests/support/temp_dir.h\""), "");
  EXPECT_TRUE(ReadsAClock("const auto t = Clock::now();"));
  EXPECT_TRUE(ReadsAClock("std::chrono::steady_clock::time_point start;"));
  EXPECT_FALSE(ReadsAClock("const bool known = IsKnown(now);"));
}

}  // namespace
}  // namespace trailcast
