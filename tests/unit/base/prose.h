#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/documents.h"

// This is the linter of prose, for documents and for comments. It finds fragments of sentences, and
// words that have a better name in the field.
namespace trailcast::test {

inline bool IsLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }
inline char Lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

struct Word {
  std::string_view word;
  std::string_view say;
};
inline constexpr Word kPrivateWords[] = {
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
struct Opening {
  std::string_view word;
  bool unless_comma = false;  // a main clause may follow one: "As it turns, it looks"
};
inline constexpr Opening kDocumentOpenings[] = {{"Of"},   {"Those"},   {"Who"}, {"Whose"},
                                                {"Whom"}, {"Whoever"}, {"Nor"}};
inline constexpr Opening kCommentOpenings[] = {
    {"Of"}, {"Those"}, {"Who"}, {"Whose"}, {"Whom"}, {"Whoever"}, {"Nor"}, {"What"}, {"As", true}};

// These are paragraphs, and items of lists, each as one line of text without code and links'
// targets.
struct Paragraph {
  int number = 0;
  std::string text;
};

// Returns `text` without code, targets of links, emphasis, and the mark of a list's item.
inline std::string Prose(const std::string& text) {
  std::string prose;
  bool target = false;
  for (const char c : WithoutCode(text)) {
    if (c == '(' && prose.ends_with(']')) target = true;
    if (!target && c != '*' && !(c == ' ' && prose.ends_with(' '))) prose += c;
    if (c == ')') target = false;
  }
  const std::size_t begin = prose.find_first_not_of(BeginsAnItem(text) ? "- 0123456789." : " ");
  return begin == std::string::npos ? "" : prose.substr(begin);
}

inline std::vector<Paragraph> ParagraphsOf(const Document& document) {
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

// Names of code and of files, such as glance_command.cc, are no words.
inline bool IsWordAt(const std::string& text, std::size_t at, std::string_view word) {
  const auto ends = [&](std::size_t i) {
    return i >= text.size() || !(IsLetter(text[i]) || text[i] == '_');
  };
  return text.compare(at, word.size(), word) == 0 && (at == 0 || ends(at - 1)) &&
         ends(at + word.size());
}

inline bool BeginsASentence(std::string_view text, std::size_t at) {
  return at == 0 || (at > 1 && text[at - 1] == ' ' &&
                     std::string_view(".!?:").find(text[at - 2]) != std::string_view::npos);
}

// Returns the sentence that begins at `at`, without its full stop.
inline std::string_view SentenceAt(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end + 1 < text.size() && !(text[end + 1] == ' ' && BeginsASentence(text, end + 2))) ++end;
  return text.substr(at, end - at);
}

inline std::vector<std::string> UnplainProse(const Document& document,
                                             std::span<const Opening> openings) {
  std::vector<std::string> found;
  for (const Paragraph& paragraph : ParagraphsOf(document)) {
    const std::string& text = paragraph.text;
    const auto tell = [&](std::size_t at, std::string_view say) {
      found.push_back(fmt::format("{}: '{}..': {}", document.Where(paragraph.number),
                                  text.substr(at, 30), say));
    };
    for (const Opening& opening : openings) {
      for (std::size_t at = text.find(opening.word); at != std::string::npos;
           at = text.find(opening.word, at + 1)) {
        const std::size_t next = at + opening.word.size() + 1;
        const bool counts = next < text.size() && std::isdigit(text[next]) != 0;
        if (!IsWordAt(text, at, opening.word) || !BeginsASentence(text, at) || counts) continue;
        const bool has_comma = SentenceAt(text, at).find(',') != std::string_view::npos;
        if (!(opening.unless_comma && has_comma)) tell(at, "begin with the subject");
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

}  // namespace trailcast::test
