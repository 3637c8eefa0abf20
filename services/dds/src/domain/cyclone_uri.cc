#include "services/dds/src/domain/cyclone_uri.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>

namespace trailcast::dds {

std::string CycloneUri() {
  // Nothing writes to the environment.
  const char* uri = std::getenv("CYCLONEDDS_URI");  // NOLINT(concurrency-mt-unsafe)
  return uri == nullptr ? "" : uri;
}

std::string UriXml(const std::string& uri) {
  std::string xml;
  for (std::size_t from = 0; from < uri.size();) {
    if (uri[from] == '<') return xml + uri.substr(from);
    const std::size_t comma = std::min(uri.find(',', from), uri.size());
    std::string file = uri.substr(from, comma - from);
    if (file.starts_with("file://")) file.erase(0, 7);
    std::ifstream in(file);
    xml.append(std::istreambuf_iterator<char>(in), {});
    from = comma + 1;
  }
  return xml;
}

bool ChoosesInterfaces(const std::string& xml) {
  static const std::regex kChoice("<NetworkInterface(Address)?[\\s>]", std::regex::icase);
  return std::regex_search(xml, kChoice);
}

bool ChoosesInterface(const std::string& xml, const std::string& name) {
  static const std::regex kName("<NetworkInterface\\s[^>]*name\\s*=\\s*[\"']([^\"']*)[\"']",
                                std::regex::icase);
  const std::sregex_iterator end;
  return std::any_of(std::sregex_iterator(xml.begin(), xml.end(), kName), end,
                     [&](const std::smatch& match) { return match[1] == name; });
}

}  // namespace trailcast::dds
