// The picture in docs/reference/dependencies.md is of the code: the rooms, and an arrow where one
// includes another, but for those that follow from other arrows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "tests/support/places.h"
#include "tests/unit/base/source_rooms.h"

namespace trailcast {
namespace {

using testing::HasSubstr;
using Arrows = std::map<std::string, std::set<std::string>>;

Arrows ArrowsOf(const std::vector<Include>& includes) {
  Arrows arrows;
  for (const Include& include : includes) {
    const bool ours = include.quoted && include.header.find('/') != std::string::npos &&
                      !include.header.starts_with("idl/");
    const std::string room = ours ? RoomOf(include.header) : include.room;
    if (room != include.room) arrows[include.room].insert(room);
  }
  return arrows;
}

void Reach(const Arrows& arrows, const std::string& room, std::set<std::string>& reached) {
  const auto from = arrows.find(room);
  if (from == arrows.end() || !reached.insert(room).second) return;
  for (const std::string& next : from->second) {
    Reach(arrows, next, reached);
    reached.insert(next);
  }
}

bool FollowsFromOthers(const Arrows& arrows, const std::string& from, const std::string& to) {
  for (const std::string& between : arrows.at(from)) {
    std::set<std::string> reached;
    if (between != to) Reach(arrows, between, reached);
    if (reached.contains(to)) return true;
  }
  return false;
}

std::string NodeOf(const std::string& room) {
  std::string id = room;
  std::replace(id.begin(), id.end(), '/', '_');
  return id;
}

std::string Picture(const Arrows& arrows) {
  std::set<std::string> rooms;
  std::ostringstream lines;
  for (const auto& [from, all] : arrows) {
    rooms.insert(from);
    for (const std::string& to : all) {
      rooms.insert(to);
      if (FollowsFromOthers(arrows, from, to)) continue;
      lines << "  " << NodeOf(from) << " --> " << NodeOf(to) << "\n";
    }
  }
  std::ostringstream out;
  out << "```mermaid\ngraph TD\n";
  for (const std::string& room : rooms) out << "  " << NodeOf(room) << "[\"" << room << "\"]\n";
  out << lines.str() << "```\n";
  return out.str();
}

TEST(Architecture, ThePictureInTheDocumentsIsOfTheCode) {
  const std::filesystem::path page =
      std::filesystem::path(SourceDir()) / "docs" / "reference" / "dependencies.md";
  std::ostringstream text;
  text << std::ifstream(page).rdbuf();
  const std::string picture = Picture(ArrowsOf(FindIncludes(ReadSources())));
  EXPECT_NE(text.str().find(picture), std::string::npos)
      << page.string() << " shows another picture than this, which is of the code:\n"
      << picture;
}

TEST(Architecture, AnArrowThatFollowsFromOthersIsLeftOut) {
  const Arrows arrows{{"a", {"b", "c", "d"}}, {"b", {"c"}}};
  EXPECT_THAT(Picture(arrows), HasSubstr("  a --> b\n  a --> d\n  b --> c\n```\n"));
}

}  // namespace
}  // namespace trailcast
