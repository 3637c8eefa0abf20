// Comments in code are written in sentences and in the field's words, as documents are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/documents.h"
#include "tests/unit/base/prose.h"
#include "tests/unit/base/source_rooms.h"

namespace trailcast {
namespace {

using test::Document;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

// Where the comment of a line begins, behind its slashes: at its beginning, or two blanks after the
// code. A string may hold slashes, too.
std::size_t CommentAt(std::string_view line) {
  const std::size_t first = line.find_first_not_of(' ');
  if (first == std::string_view::npos) return first;
  if (line.substr(first).starts_with("//")) return first + 2;
  const std::size_t after = line.find("  // ");
  if (after == std::string_view::npos) return after;
  const auto quotes = std::count(line.begin(), line.begin() + static_cast<long>(after), '"');
  return quotes % 2 == 0 ? after + 4 : std::string_view::npos;
}

// The comments of one file as a document of as many lines. Each comment is an item of a list, so
// that one behind code and one below it stay apart.
Document CommentsIn(const std::string& path, const std::vector<std::string>& lines) {
  std::string text;
  std::size_t before = std::string::npos;
  for (const std::string& line : lines) {
    const std::size_t at = CommentAt(line);
    if (at != std::string::npos) {
      const std::size_t begin = line.substr(at).starts_with(' ') ? at + 1 : at;
      text += (at == before ? "" : "- ") + line.substr(begin);
    }
    text += '\n';
    before = at;
  }
  std::istringstream in(text);
  return test::ReadDocument(path, in);
}

std::vector<std::string> Unplain(const Document& document) {
  return test::UnplainProse(document, test::kCommentOpenings);
}

std::vector<Document> ReadComments() {
  std::vector<Document> documents;
  std::string path;
  std::vector<std::string> lines;
  const auto end_file = [&] {
    if (!lines.empty()) documents.push_back(CommentsIn(path, std::exchange(lines, {})));
  };
  for (const SourceLine& line : ReadSources({"services", "agent", "route_server", "tests"})) {
    std::string of = line.where.substr(0, line.where.rfind(':'));
    if (of != path) end_file();
    path = std::move(of);
    lines.push_back(line.text);
  }
  end_file();
  return documents;
}

TEST(Comments, AreWrittenInSentencesAndInTheFieldsWords) {
  const std::vector<Document> files = ReadComments();
  EXPECT_GT(files.size(), 300U);
  for (const Document& file : files) EXPECT_THAT(Unplain(file), IsEmpty());
}

TEST(Comments, AFragmentAndAPrivateWordAreFound) {
  EXPECT_THAT(Unplain(CommentsIn("a.h", {"// It waits. What", "// it waits for.", "int a;",
                                         "  // As Wait has it. As it turns, it looks.",
                                         "int b;  // its next stretch"})),
              ElementsAre(StartsWith("a.h:1: 'What"), StartsWith("a.h:4: 'As Wait"),
                          StartsWith("a.h:5: 'stretch")));
  // The string below is in two parts, because the test above reads this file, too.
  EXPECT_THAT(Unplain(CommentsIn("a.h", {"// It waits, see glance_command.cc.",
                                         "call(\"  //"
                                         " Of\");"})),
              IsEmpty());
}

}  // namespace
}  // namespace trailcast
