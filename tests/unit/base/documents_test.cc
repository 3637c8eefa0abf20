// The documents lead where they say, and are written in sentences and in the field's words.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/documents.h"

namespace trailcast {
namespace {

namespace fs = std::filesystem;
using test::Document;
using test::DocumentLine;
using test::LineKind;
using testing::ElementsAre;
using testing::IsEmpty;

bool IsLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }
char Lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

Document Read(const std::string& text) {
  std::istringstream in(text);
  return test::ReadDocument("page.md", in);
}

// What follows '#' in a link to a heading, as the usual hosts make it.
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

struct Word {
  std::string_view word;
  std::string_view say;
};
constexpr Word kPrivateWords[] = {
    {"on duty", "available, on a mission, or that it waits to be sent"},
    {"glance", "camera snapshot"},
    {"glances", "camera snapshots"},
    {"stretch", "section"},
    {"stretches", "sections"},
    {"stray", "orphan"},
    {"strays", "orphans"},
    {"receipted", "acknowledged"},
    {"eyes", "front end"},
    {"stand-in", "backup"},
};
// A sentence that begins so mostly has its subject at its end, or none. ("Of 40 robots one waits"
// has one.)
constexpr std::string_view kOpenings[] = {"Of", "Those", "Who", "Whose", "Whom", "Whoever", "Nor"};

// Those that are still to be read.
const std::set<std::string> kNotReadYet{"config/README.md", "services/console/README.md"};

// Paragraphs, and items of lists, each as one line of text without code and links' targets.
struct Paragraph {
  int number = 0;
  std::string text;
};

// `text` without code, targets of links, emphasis, and the mark of a list's item.
std::string Prose(const std::string& text) {
  std::string prose;
  bool target = false;
  for (const char c : test::WithoutCode(text)) {
    if (c == '(' && prose.ends_with(']')) target = true;
    if (!target && c != '*' && !(c == ' ' && prose.ends_with(' '))) prose += c;
    if (c == ')') target = false;
  }
  const std::size_t begin =
      prose.find_first_not_of(test::BeginsAnItem(text) ? "- 0123456789." : " ");
  return begin == std::string::npos ? "" : prose.substr(begin);
}

std::vector<Paragraph> ParagraphsOf(const Document& document) {
  std::vector<Paragraph> paragraphs;
  bool goes_on = false;
  for (const DocumentLine& line : document.lines) {
    if (line.kind == LineKind::kProse && goes_on) {
      paragraphs.back().text += " " + line.text;
    } else if (line.kind == LineKind::kProse || line.kind == LineKind::kItem) {
      paragraphs.push_back({line.number, line.text});
    }
    goes_on = line.kind == LineKind::kProse || line.kind == LineKind::kItem;
  }
  for (Paragraph& paragraph : paragraphs) paragraph.text = Prose(paragraph.text);
  return paragraphs;
}

bool IsWordAt(const std::string& text, std::size_t at, std::string_view word) {
  return text.compare(at, word.size(), word) == 0 && (at == 0 || !IsLetter(text[at - 1])) &&
         (at + word.size() == text.size() || !IsLetter(text[at + word.size()]));
}

bool BeginsASentence(const std::string& text, std::size_t at) {
  return at == 0 || (at > 1 && text[at - 1] == ' ' &&
                     std::string_view(".!?:").find(text[at - 2]) != std::string_view::npos);
}

std::vector<std::string> UnplainProse(const Document& document) {
  std::vector<std::string> found;
  for (const Paragraph& paragraph : ParagraphsOf(document)) {
    const std::string& text = paragraph.text;
    const auto tell = [&](std::size_t at, std::string_view say) {
      found.push_back(fmt::format("{}: '{}..': {}", document.Where(paragraph.number),
                                  text.substr(at, 30), say));
    };
    for (const std::string_view opening : kOpenings) {
      for (std::size_t at = text.find(opening); at != std::string::npos;
           at = text.find(opening, at + 1)) {
        const std::size_t next = at + opening.size() + 1;
        const bool counts = next < text.size() && std::isdigit(text[next]) != 0;
        if (IsWordAt(text, at, opening) && BeginsASentence(text, at) && !counts) {
          tell(at, "begin with the subject");
        }
      }
    }
    std::string lower = text;
    std::transform(lower.begin(), lower.end(), lower.begin(), Lower);
    for (const Word& private_word : kPrivateWords) {
      for (std::size_t at = lower.find(private_word.word); at != std::string::npos;
           at = lower.find(private_word.word, at + 1)) {
        if (IsWordAt(lower, at, private_word.word))
          tell(at, fmt::format("say {}", private_word.say));
      }
    }
  }
  return found;
}

TEST(Documents, EveryLinkLeadsToAFileAndAHeading) {
  EXPECT_THAT(DeadLinks(test::ReadDocuments()), IsEmpty());
}

TEST(Documents, ALinkToNothingIsFound) {
  EXPECT_THAT(DeadLinks({Read("# One\n[a](#one) [b](#two) `[c](d)`\n\n    [e](f)\n[g](no.md)\n")}),
              ElementsAre("page.md:2: #two", "page.md:5: no.md"));
}

TEST(Documents, AreWrittenInSentencesAndInTheFieldsWords) {
  for (const Document& document : test::ReadDocuments()) {
    if (kNotReadYet.contains(document.path.string())) continue;
    EXPECT_THAT(UnplainProse(document), IsEmpty());
  }
}

TEST(Documents, AFragmentAndAPrivateWordAreFound) {
  EXPECT_THAT(
      UnplainProse(Read("A robot drives. Of two\none waits.\n\n- Who waits `glance`\n\n    Of\n")),
      testing::SizeIs(2));
  EXPECT_THAT(UnplainProse(Read("A robot is on\nduty.\n")), testing::SizeIs(1));
  EXPECT_THAT(UnplainProse(Read("# Who may\n| Of all | on duty |\nA robot of two waits.\n")),
              IsEmpty());
}

}  // namespace
}  // namespace trailcast
