#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/places.h"

// This reads the repository's documents as Markdown, as far as tests need it.
namespace trailcast::test {

enum class LineKind { kBlank, kHeading, kTable, kCode, kItem, kProse };

struct DocumentLine {
  int number = 0;  // from 1
  LineKind kind = LineKind::kProse;
  std::string text;  // as in the document; code is without its indentation
};

struct Document {
  std::filesystem::path path;  // from the root
  std::vector<DocumentLine> lines;

  [[nodiscard]] std::string Where(int number) const {
    return path.string() + ":" + std::to_string(number);
  }
};

inline bool BeginsAnItem(const std::string& text) {
  const std::size_t mark = text.find_first_not_of(' ');
  if (mark == std::string::npos) return false;
  if (text.compare(mark, 2, "- ") == 0 || text.compare(mark, 2, "* ") == 0) return true;
  const std::size_t end = text.find_first_not_of("0123456789", mark);
  return end != mark && end != std::string::npos && text.compare(end, 2, ". ") == 0;
}

// Fenced blocks are code, and so are lines that are indented by four, unless they continue a list's
// item.
inline Document ReadDocument(const std::filesystem::path& path, std::istream& in) {
  Document document{path, {}};
  bool fenced = false;
  bool in_item = false;
  LineKind before = LineKind::kBlank;
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    LineKind kind = LineKind::kProse;
    if (text.starts_with("```")) {
      fenced = !fenced;
      kind = LineKind::kBlank;
    } else if (fenced) {
      kind = LineKind::kCode;
    } else if (text.find_first_not_of(' ') == std::string::npos) {
      kind = LineKind::kBlank;
    } else if (BeginsAnItem(text) && !(text.starts_with("    ") && !in_item)) {
      kind = LineKind::kItem;
      in_item = true;
    } else if (text.starts_with("    ") && before != LineKind::kProse &&
               before != LineKind::kItem) {
      kind = LineKind::kCode;
      text.erase(0, text.find_first_not_of(' '));
    } else if (text.starts_with('#')) {
      kind = LineKind::kHeading;
    } else if (text.starts_with('|')) {
      kind = LineKind::kTable;
    }
    if (kind != LineKind::kBlank && kind != LineKind::kItem && !text.starts_with(' ')) {
      in_item = false;
    }
    document.lines.push_back({number, kind, text});
    before = kind;
  }
  return document;
}

inline std::vector<Document> ReadDocuments() {
  namespace fs = std::filesystem;
  const fs::path root(SourceDir());
  std::vector<Document> documents;
  for (auto entry = fs::recursive_directory_iterator(root);
       entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() && (name.starts_with('.') || name == "build")) {
      entry.disable_recursion_pending();
    } else if (entry->path().extension() == ".md") {
      std::ifstream in(entry->path());
      documents.push_back(ReadDocument(fs::relative(entry->path(), root), in));
    }
  }
  std::sort(documents.begin(), documents.end(),
            [](const Document& a, const Document& b) { return a.path < b.path; });
  return documents;
}

// Returns `text` without what is between backticks.
inline std::string WithoutCode(const std::string& text) {
  std::string without;
  bool code = false;
  for (const char c : text) {
    if (c == '`') code = !code;
    if (!code || c == '`') without += c;
  }
  return without;
}

}  // namespace trailcast::test
