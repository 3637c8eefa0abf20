// The documents lead where they say, and are written in sentences and in the field's words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/documents.h"
#include "tests/unit/base/prose.h"
#include "tests/unit/base/source_rooms.h"

namespace trailcast {
namespace {

namespace fs = std::filesystem;
using test::Document;
using test::DocumentLine;
using test::IsLetter;
using test::LineKind;
using test::Lower;
using testing::ElementsAre;
using testing::IsEmpty;

Document Read(const std::string& text) {
  std::istringstream in(text);
  return test::ReadDocument("page.md", in);
}

// Returns what follows '#' in a link to a heading, as the usual hosts make it.
std::string AnchorOf(const std::string& heading) {
  std::string anchor;
  for (const char c : heading.substr(heading.find_first_not_of("# "))) {
    if (c == ' ') anchor += '-';
    if (IsLetter(c) || c == '-' || c == '_') anchor += Lower(c);
  }
  return anchor;
}

std::set<std::string> AnchorsOf(const Document& document) {
  std::set<std::string> anchors;
  std::map<std::string, int> seen;
  for (const DocumentLine& line : document.lines) {
    if (line.kind != LineKind::kHeading) continue;
    const std::string anchor = AnchorOf(line.text);
    const int before = seen[anchor]++;
    anchors.insert(before == 0 ? anchor : anchor + "-" + std::to_string(before));
  }
  return anchors;
}

struct Link {
  std::string where;
  std::string to;
};

// Only a link's words may be broken over two lines.
std::vector<Link> LinksOf(const Document& document) {
  std::vector<Link> links;
  for (const DocumentLine& line : document.lines) {
    if (line.kind == LineKind::kCode || line.kind == LineKind::kBlank) continue;
    const std::string text = test::WithoutCode(line.text);
    for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
      const std::string to = text.substr(at + 2, text.find(')', at) - at - 2);
      if (!to.starts_with("http")) links.push_back({document.Where(line.number), to});
    }
  }
  return links;
}

std::vector<std::string> DeadLinks(const std::vector<Document>& documents) {
  std::map<std::string, std::set<std::string>> anchors;
  for (const Document& document : documents) anchors[document.path.string()] = AnchorsOf(document);
  std::vector<std::string> dead;
  for (const Document& document : documents) {
    for (const Link& link : LinksOf(document)) {
      const std::string file = link.to.substr(0, link.to.find('#'));
      const fs::path to =
          file.empty() ? document.path : (document.path.parent_path() / file).lexically_normal();
      const std::size_t hash = link.to.find('#');
      const bool there = file.empty() || fs::exists(fs::path(SourceDir()) / to);
      const bool heading =
          hash == std::string::npos || anchors[to.string()].contains(link.to.substr(hash + 1));
      if (!there || !heading) dead.push_back(link.where + ": " + link.to);
    }
  }
  return dead;
}

// Returns the tests there are: "Suite.Name" each.
std::set<std::string> Tests() {
  const std::regex begins(R"(^TEST(?:_F|_P)?\(([A-Za-z0-9_]+), ?([A-Za-z0-9_]+)\))");
  std::set<std::string> tests;
  for (const SourceLine& line : ReadSources({"tests"})) {
    std::smatch test;
    if (line.text.starts_with("TEST") && std::regex_search(line.text, test, begins)) {
      tests.insert(test[1].str() + "." + test[2].str());
    }
  }
  return tests;
}

// Returns the tests that a page's tables name in their last columns and that are not among `tests`:
// `Suite`, `Suite.Name` or `Suite.Beginning...` each, beside commands with blanks.
std::vector<std::string> AbsentTests(const Document& page, const std::set<std::string>& tests) {
  std::vector<std::string> absent;
  for (const DocumentLine& line : page.lines) {
    if (line.kind != LineKind::kTable || line.text.size() < 2) continue;
    std::istringstream cell(line.text.substr(line.text.rfind('|', line.text.size() - 2) + 1));
    std::string name;
    for (bool is_code = false; std::getline(cell, name, '`'); is_code = !is_code) {
      if (!is_code || name.find_first_of(" _") != std::string::npos) continue;
      const bool is_whole = name.find('.') != std::string::npos && !name.ends_with("...");
      if (name.ends_with("...")) name.resize(name.size() - 3);
      if (name.find('.') == std::string::npos) name += '.';
      const auto at = tests.lower_bound(name);
      const bool is_there = at != tests.end() && (is_whole ? *at == name : at->starts_with(name));
      if (!is_there) absent.push_back(page.Where(line.number) + ": " + name);
    }
  }
  return absent;
}

std::vector<std::string> UnplainIn(const Document& document) {
  return test::UnplainProse(document, test::kDocumentOpenings);
}

TEST(Documents, EveryLinkLeadsToAFileAndAHeading) {
  EXPECT_THAT(DeadLinks(test::ReadDocuments()), IsEmpty());
}

TEST(Documents, ALinkToNothingIsFound) {
  EXPECT_THAT(DeadLinks({Read("# One\n[a](#one) [b](#two) `[c](d)`\n\n    [e](f)\n[g](no.md)\n")}),
              ElementsAre("page.md:2: #two", "page.md:5: no.md"));
}

TEST(Documents, ThePromisesToTheFieldAreHeldByTestsThatExist) {
  int pages = 0;
  for (const Document& document : test::ReadDocuments()) {
    if (document.path != "docs/explanation/field.md") continue;
    ++pages;
    EXPECT_THAT(AbsentTests(document, Tests()), IsEmpty());
  }
  EXPECT_EQ(pages, 1);
}

TEST(Documents, ATestThatDoesNotExistIsFound) {
  const std::set<std::string> tests{"One.Is", "Two.IsLong"};
  EXPECT_THAT(AbsentTests(Read("| x | test |\n| --- | --- |\n"
                               "| `No.Test` | `One`, `Two.Is...`, `Two.IsLong`, `./run attack` |\n"
                               "| x | `Tw`, `Two.Is`, `One.Was...` |\n"),
                          tests),
              ElementsAre("page.md:4: Tw.", "page.md:4: Two.Is", "page.md:4: One.Was"));
}

TEST(Documents, AreWrittenInSentencesAndInTheFieldsWords) {
  for (const Document& document : test::ReadDocuments()) {
    EXPECT_THAT(UnplainIn(document), IsEmpty());
  }
}

TEST(Documents, AFragmentAndAPrivateWordAreFound) {
  EXPECT_THAT(
      UnplainIn(Read("A robot drives. Of two\none waits.\n\n- Who waits `glance`\n\n    Of\n")),
      testing::SizeIs(2));
  EXPECT_THAT(UnplainIn(Read("A robot is on\nduty.\n")), testing::SizeIs(1));
  EXPECT_THAT(UnplainIn(Read("# Who may\n| Of all | on duty |\nA robot of two waits.\n")),
              IsEmpty());
}

}  // namespace
}  // namespace trailcast
